#pragma once

/// @file
/// Deformation regime of one asperity by its plasticity index (plasticity.hpp).

#include <cstdint>

#include "mems_stiction/mechanics/plasticity.hpp"

namespace mems_stiction {

/// The values are those of the contact map.
enum class Regime : std::uint8_t { kApart = 0, kElastic = 1, kElastoPlastic = 2, kPlastic = 3 };

/// Whether hardness plays a part. kElastic keeps every contact elastic.
enum class Deformation { kThreeRegimes, kElastic };

inline Regime regimeOf(double plasticity_index) {
  if (plasticity_index <= kElasticLimit) return Regime::kElastic;
  return plasticity_index < kPlasticLimit ? Regime::kElastoPlastic : Regime::kPlastic;
}

}  // namespace mems_stiction
