#include "separation/way_out.hpp"

#include <algorithm>

#include "separation/conforming_contact.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {

std::optional<WayOut> conformingWayOut(const WayOut& by_contacts, ConformingContact& bonded, double flattening_ratio,
                                       double pressure) {
  const bool conforms = flattening_ratio < chosen::kConformingRatio && bonded.work() > 0.0;
  if (!conforms) return std::nullopt;
  if (bonded.hasOpenValleys(pressure)) return bonded.fromOpenValleys(pressure);
  // contacts with the work of bonded surfaces would hold the force in proportion
  return bonded.asAWhole(pressure, by_contacts.force * std::max(1.0, bonded.work() / by_contacts.work));
}

}  // namespace mems_stiction
