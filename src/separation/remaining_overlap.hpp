#pragma once

/// @file
/// What flow leaves of a contact.

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/constants.hpp"

namespace mems_stiction {

/// What is left of the overlaps of a patch when the contact has been taken apart: pressed together
/// again as far, the core must carry the hardness. Hertz's pressure exceeds it over the share
/// `core` = 1 - 1/(3 x)^2 of the contact, x = P/(Ha A) without flow; the surface that carries an
/// even pressure Ha on a radius a has the curvature Ha/(E a), and what lies outside the core is as
/// it was.
class RemainingOverlap {
 public:
  RemainingOverlap() = default;  ///< all of it
  /// - @p elastic_fullness x [-]
  /// - @p area_share real contact area over that of the overlap [-]
  /// - @p depth mean overlap, @p largest overlap of the patch [m]
  RemainingOverlap(double elastic_fullness, double area_share, double depth, double largest) {
    const double height = 2.0 * depth;  // of the paraboloid with this area and volume
    const double peak = elastic_fullness * std::sqrt(std::max(1.0, largest / height));
    if (!(3.0 * peak > 1.0)) return;
    const double core = 1.0 - 1.0 / (9.0 * peak * peak);
    core_edge_ = height * (1.0 - core * area_share);
    // R Ha/(E a) with x = (2/(3 pi)) (E/Ha) sqrt(height/R), a^2 = 2 R height area_share
    flatness_ = std::min(1.0, std::sqrt(2.0) / (3.0 * kPi) / (peak * std::sqrt(area_share)));
  }

  /// Whether anything has flowed.
  bool isChanged() const { return flatness_ < 1.0; }
  /// Of a cell [m].
  double of(double overlap) const {
    return overlap <= core_edge_ ? overlap : core_edge_ + flatness_ * (overlap - core_edge_);
  }

 private:
  double core_edge_ = std::numeric_limits<double>::infinity();
  double flatness_ = 1.0;
};

}  // namespace mems_stiction
