#pragma once

/// @file
/// The surfaces after contact (doc/theory.md, section 7).
///
/// Only cells in interference change, by w = z1 - z2 > 0 there, and only outside the elastic
/// regime:
///
///     z1' = z1 - c s w,   z2' = z2 + c (1 - s) w                                        (12), (13)
///     s   = 1/2 + (1/2) ln(H2/H1)/|ln a|    for a H1 <= H2 <= H1/a; else the softer body takes all
///     c   = 0 for phi <= 0.6, 2 (phi - 0.6) between, 1 for phi >= 1.1
///
/// A fully plastic patch ends with z1' = z2'; an elastic one comes back unchanged.

#include "mems_stiction/mechanics/material.hpp"

namespace mems_stiction {

/// How the interference of a cell is divided between the bodies.
class DeformationShare {
 public:
  /// - @p hardness_ratio_limit a of (12), in (0, 1)
  DeformationShare(const Material& lower, const Material& upper, double hardness_ratio_limit);

  /// Share of w that the lower surface loses, c s [-].
  double lower(double plasticity_index) const { return flow(plasticity_index) * lower_share_; }
  /// Share of w that the upper surface loses, c (1 - s) [-].
  double upper(double plasticity_index) const {
    return flow(plasticity_index) * (1.0 - lower_share_);
  }

 private:
  /// c [-]
  static double flow(double plasticity_index);

  double lower_share_ = 0.5;  ///< s [-], in [0, 1]
};

}  // namespace mems_stiction
