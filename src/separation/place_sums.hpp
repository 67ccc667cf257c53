#pragma once

/// @file
/// All that the separation curve takes from a frame: sums over places at one displacement of the
/// upper surface.
///
/// FrameSums (frame_sums.hpp) makes them of one frame; separation_curve.cpp makes forces of them.

namespace mems_stiction {

/// Equations are those of doc/separation_curve.md.
struct PlaceSums {
  // over the cells
  int contact_count = 0;       ///< that overlap
  double adhesion = 0.0;       ///< t(d) dA of those apart, (S1), or held if that is more [N]
  double electrostatic = 0.0;  ///< of all [N]
  double capillary = 0.0;      ///< of those that water fills [N]
  // over the patches that overlap
  double carried = 0.0;  ///< what they carry, (S4) to (S6) [N]
  double opened = 0.0;   ///< attraction that the undeformed gap around them overstates, (S8b) [N]
  // over the patches in reach of the attraction, (S7)
  double weight = 0.0;      ///< V = R w(gap at the summit) [N]: how much attraction hangs on one
  double soft = 0.0;        ///< V mu
  double loss = 0.0;        ///< V (1 - c(mu)/2)/n
  double loss_alone = 0.0;  ///< V times that [N^2]
  // over the same, (S8c)
  double edge_loss = 0.0;   ///< V times what edges take
  double edge_slope = 0.0;  ///< V times what they leave, and its exponent of the modulus
  double width = 0.0;       ///< V a/a0

  /// mu of the summits in reach, their mean by weight [-]; 0 where nothing is.
  double taborParameter() const { return weight > 0.0 ? soft / weight : 0.0; }
};

}  // namespace mems_stiction
