#pragma once

/// @file
/// How the force of a whole device is found from scans of its surface (device_force.hpp).
///
///     DeviceForceOptions options;
///     options.realisations = 16;

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// Keys device_force/...
struct DeviceForceOptions {
  bool enabled = true;   ///< a device that states its contact area is judged by its own force
  int realisations = 8;  ///< surfaces that are made, in [3, 1000]
  double pitch = 0.0;    ///< of the made surfaces [m], >= 0; 0 = the finest of the scans
  double max_cells =
      2e7;  ///< of one made surface [-], in [1e4, 1e11]; larger areas are continued from there
  bool own_long_waves =
      true;  ///< a scan as wide as the device gives its long waves: the force is that of its place
  int seed = 1;  ///< >= 0; the same seed gives the same surfaces

  void describe(OptionVisitor& visitor);
};

}  // namespace mems_stiction
