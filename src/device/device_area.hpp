#pragma once

/// @file
/// The force of one made surface of a device: all its contacts at one height of the counter-surface.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "device/made_surface.hpp"
#include "mems_stiction/contact/contact_solution.hpp"
#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/prediction/options.hpp"

namespace mems_stiction {

/// The contacts of a device as squares of one size, each on a surface of its own.
struct DevicePieces {
  int count = 1;
  MadeSize size;            ///< of each
  double area_ratio = 1.0;  ///< of the device over what is made: above 1 where that has no room

  double side() const { return size.sideX(); }
  double area() const { return count * size.sideX() * size.sideY(); }  ///< that is made [m^2]
};

/// - @p most_cells of all pieces together
DevicePieces piecesOf(const DeviceArea& area, double pitch, double most_cells);

/// Brings made surfaces to contact.
class DeviceAreaSolver {
 public:
  /// - @p model its mechanical load presses an area of `loaded_area` [m^2]
  DeviceAreaSolver(const Options& model, double loaded_area, const DevicePieces& pieces);

  /// @throw SurfaceError if so much of the area comes in reach that it cannot be held
  Realisation realise(const SurfaceLaw& lower, const std::optional<SurfaceLaw>& upper, std::uint64_t seed);

  Exponents lastForceExponents() const { return force_exponents_; }
  Exponents lastWorkExponents() const { return work_exponents_; }
  /// About all realisations, each once.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  Options model_;
  double loaded_area_;
  DevicePieces pieces_;
  Exponents force_exponents_;
  Exponents work_exponents_;
  std::vector<std::string> warnings_;
};

}  // namespace mems_stiction
