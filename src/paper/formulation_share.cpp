#include "paper/formulation_share.hpp"

#include <algorithm>
#include <cmath>

namespace mems_stiction {
namespace {

/// P/w of (12) as printed.
double printedShare(double log_ratio, double log_limit) {
  if (log_ratio == 0.0) return 0.5;
  const double sign = log_ratio > 0.0 ? 1.0 : -1.0;
  return 0.5 + sign / (4.0 * (1.0 - log_ratio / log_limit * sign));
}

}  // namespace

FormulationShare::FormulationShare(const Material& lower, const Material& upper,
                                   double hardness_ratio_limit, Formulation formulation,
                                   Deformation deformation)
    : lower_share_(DeformationShare(lower, upper, hardness_ratio_limit).lower(kPlasticLimit)) {
  if (formulation != Formulation::kPrinted) return;
  const double softer_over_harder =
      std::min(lower.hardness, upper.hardness) / std::max(lower.hardness, upper.hardness);
  if (softer_over_harder < hardness_ratio_limit) {
    flows_in_every_regime_ = deformation == Deformation::kThreeRegimes;
  } else {
    lower_share_ =
        printedShare(std::log(upper.hardness / lower.hardness), std::log(hardness_ratio_limit));
  }
}

double FormulationShare::flow(double plasticity_index) const {
  return flows_in_every_regime_ ? 1.0 : 1.0 - regimeFactor(plasticity_index);
}

}  // namespace mems_stiction
