#include "deformation/modified_topography.hpp"

#include <algorithm>
#include <cmath>

#include "mems_stiction/mechanics/plasticity.hpp"

namespace mems_stiction {

DeformationShare::DeformationShare(const Material& lower, const Material& upper,
                                   double hardness_ratio_limit) {
  const double log_ratio = std::log(upper.hardness / lower.hardness);
  // compared so that exchanged bodies, at the limit itself too, get exchanged shares
  const double softer_over_harder =
      std::min(lower.hardness, upper.hardness) / std::max(lower.hardness, upper.hardness);
  if (softer_over_harder < hardness_ratio_limit) {
    lower_share_ = log_ratio > 0.0 ? 1.0 : 0.0;
  } else {
    lower_share_ =
        std::clamp(0.5 + 0.5 * log_ratio / std::abs(std::log(hardness_ratio_limit)), 0.0, 1.0);
  }
}

double DeformationShare::flow(double plasticity_index) {
  return 1.0 - regimeFactor(plasticity_index);
}

}  // namespace mems_stiction
