#pragma once

/// @file
/// One point of the curve of force over height.

namespace mems_stiction {

/// One height of the curve.
struct ForcePoint {
  double height = 0.0;        ///< Z over first touch of the undeformed surfaces [m]; negative: pressed in
  double force = 0.0;         ///< attraction of the frame, positive pulls the bodies together [N]
  double energy = 0.0;        ///< of tractions and elastic deformation, 0 far apart; flow is not in it [J]
  double contact_area = 0.0;  ///< cells that repel each other [m^2]
  double mean_gap = 0.0;      ///< [m]
  bool is_solved = true;      ///< false: from the parabola between two solved heights, which contact and gap follow
};

}  // namespace mems_stiction
