#include "mems_stiction/mechanics/plasticity.hpp"

#include <algorithm>
#include <cmath>

namespace mems_stiction {

const char* word(Regime regime) {
  constexpr const char* kWords[] = {"APART", "ELASTIC", "ELASTO_PLASTIC", "PLASTIC"};
  return kWords[static_cast<int>(regime)];
}

Regime regimeOf(double plasticity_index) {
  if (plasticity_index <= kElasticLimit) return Regime::kElastic;
  return plasticity_index < kPlasticLimit ? Regime::kElastoPlastic : Regime::kPlastic;
}

double plasticityIndex(double contact_modulus, double hardness, double composite_rms_height,
                       double radius) {
  return contact_modulus / hardness * std::sqrt(composite_rms_height / radius);
}

double regimeFactor(double plasticity_index) {
  return std::clamp((kPlasticLimit - plasticity_index) / (kPlasticLimit - kElasticLimit), 0.0, 1.0);
}

}  // namespace mems_stiction
