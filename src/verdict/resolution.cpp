#include "mems_stiction/verdict/resolution.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "numeric/constants.hpp"

namespace mems_stiction {

void ResolutionOptions::describe(OptionVisitor& visitor) {
  visitor.number(
      "resolution/min_contact_pixels", min_contact_pixels, "", Range::nonNegative(),
      "a median contact of fewer pixels of the scan sets is_resolution_limited; 0 = never");
  visitor.number("resolution/tip_radius", tip_radius, "m", Range::nonNegative(),
                 "radius of the tip that drew the scan, for is_tip_limited and tip_limit; 0 = that "
                 "of preprocessing/tip");
}

void flagResolution(double min_contact_pixels, double tip_radius, Prediction& prediction) {
  // NaN, without contact, is neither below nor above.
  prediction.is_resolution_limited = prediction.median_contact_pixels < min_contact_pixels;
  prediction.is_tip_limited = tip_radius > prediction.median_composite_radius;
}

void countBelowTip(double tip_limit, Prediction& prediction) {
  prediction.tip_limit = tip_limit;
  prediction.below_tip_count = -1;
  const std::vector<Asperity>& contacts = prediction.holdingContacts();
  if (std::isnan(tip_limit) || !prediction.listsHoldingContacts()) return;
  const double smallest_area = 0.25 * kPi * tip_limit * tip_limit;
  prediction.below_tip_count = static_cast<int>(
      std::count_if(contacts.begin(), contacts.end(),
                    [&](const Asperity& contact) { return contact.area < smallest_area; }));
}

}  // namespace mems_stiction
