#include "mems_stiction/deformation/modified_topography.hpp"

#include <algorithm>
#include <cmath>

#include "mems_stiction/mechanics/plasticity.hpp"

namespace mems_stiction {
namespace {

/// P/w of (12) as printed.
double printedShare(double log_ratio, double log_limit) {
  if (log_ratio == 0.0) return 0.5;
  const double sign = log_ratio > 0.0 ? 1.0 : -1.0;
  return 0.5 + sign / (4.0 * (1.0 - log_ratio / log_limit * sign));
}

}  // namespace

DeformationShare::DeformationShare(const Material& lower, const Material& upper, double hardness_ratio_limit,
                                   Formulation formulation, Deformation deformation) {
  const double log_ratio = std::log(upper.hardness / lower.hardness);
  const double log_limit = std::log(hardness_ratio_limit);
  const bool is_printed = formulation == Formulation::kPrinted;
  // compared so that exchanged bodies, at the limit itself too, get exchanged shares
  const double softer_over_harder = std::min(lower.hardness, upper.hardness) / std::max(lower.hardness, upper.hardness);
  if (softer_over_harder < hardness_ratio_limit) {
    lower_share_ = log_ratio > 0.0 ? 1.0 : 0.0;
    flows_in_every_regime_ = is_printed && deformation == Deformation::kThreeRegimes;
  } else {
    lower_share_ = is_printed ? printedShare(log_ratio, log_limit)
                              : std::clamp(0.5 + 0.5 * log_ratio / std::abs(log_limit), 0.0, 1.0);
  }
}

double DeformationShare::flow(double plasticity_index) const {
  return flows_in_every_regime_ ? 1.0 : 1.0 - regimeFactor(plasticity_index);
}

}  // namespace mems_stiction
