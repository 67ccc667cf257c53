#pragma once

/// @file
/// The force of one made surface of a device: all its contacts at one height of the counter-surface.

#include <cstdint>
#include <functional>
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
  double area_ratio = 1.0;  ///< of the device over what is made: not 1 where that has no room, or has whole pixels

  double side() const { return size.sideX(); }
  double area() const { return count * size.sideX() * size.sideY(); }  ///< that is made [m^2]
};

/// Whether scans have room for all pieces: then they need not be made.
bool haveRoom(const std::vector<HeightMap>& scans, const DevicePieces& pieces);

/// - @p most_cells of all pieces together
DevicePieces piecesOf(const DeviceArea& area, double pitch, double most_cells);

/// Brings made surfaces to contact.
class DeviceAreaSolver {
 public:
  /// - @p model its mechanical load presses an area of `loaded_area` [m^2]
  DeviceAreaSolver(const Options& model, double loaded_area, const DevicePieces& pieces);

  /// On surfaces that are made by laws.
  Realisation realise(const SurfaceLaw& lower, const std::optional<SurfaceLaw>& upper, std::uint64_t seed);
  /// On parts of scans that are chosen at random.
  Realisation realise(const std::vector<HeightMap>& lower, const std::vector<HeightMap>& upper, std::uint64_t seed);

  Exponents lastForceExponents() const { return force_exponents_; }
  Exponents lastWorkExponents() const { return work_exponents_; }
  /// About all realisations, each once.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  class Gatherer;

  Realisation follow(const Gatherer& gathered, const std::function<cv::Mat()>& frame);
  Realisation followFrame(const cv::Mat& relief);
  Options loadedOn(double area) const;
  void warnOnce(const std::string& warning);

  Options model_;
  double loaded_area_;
  DevicePieces pieces_;
  Exponents force_exponents_;
  Exponents work_exponents_;
  std::vector<std::string> warnings_;
};

}  // namespace mems_stiction
