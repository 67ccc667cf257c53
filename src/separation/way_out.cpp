#include "separation/way_out.hpp"

#include <algorithm>

#include "separation/conforming_contact.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {

std::optional<WayOut> conformingWayOut(const WayOut& by_contacts, double joined_share, ConformingContact& bonded,
                                       double flattening_ratio, double pressure) {
  // bonded by its energy is not yet bonded by its way: tall summits keep the rest apart
  const bool comes_near = joined_share > chosen::kJoinedShare;
  if (!comes_near || !(flattening_ratio < chosen::kConformingRatio) || !(bonded.work() > 0.0)) return std::nullopt;
  // contacts with the work of bonded surfaces would hold the force in proportion
  WayOut way_out = bonded.hasOpenValleys(pressure)
                       ? bonded.fromOpenValleys(pressure)
                       : bonded.asAWhole(pressure, by_contacts.force * std::max(1.0, bonded.work() / by_contacts.work));
  bonded.takeWork(by_contacts, way_out);
  return way_out;
}

}  // namespace mems_stiction
