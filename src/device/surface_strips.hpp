#pragma once

/// @file
/// The force of one made surface whose rows are made in strips, here or on other machines, in any
/// order and any cut: the same to the bit as that of the whole.
///
///     DividedSurface surface(surfaces, area, model, options, 0);       // on each machine
///     const std::string part = surface.strip(first_row, rows);         // on any
///     SurfaceStrips strips(surface);
///     strips.add(part);                                                // of all machines
///     const Realisation found = surface.realise(strips);

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "device/device_area.hpp"
#include "device/device_surface.hpp"
#include "device/usable_scans.hpp"

namespace mems_stiction {

class SurfaceStrips;

/// A made surface of the device's whole size: device_force/max_cells has no say in it. One object
/// serves one thread at a time.
class DividedSurface {
 public:
  /// - @p number of the surface among those that are made, from 0
  /// - @p depth cells that far below the highest are collected one by one [m]; none: what suffices
  /// as a rule, or all of a small
  ///   surface
  /// @throw OptionsError, SurfaceError
  DividedSurface(const DeviceSurfaces& surfaces, const DeviceArea& area, const Options& model,
                 const DeviceForceOptions& options, int number, std::optional<double> depth);

  DeviceSurface& surface() { return surface_; }
  /// What a strip tells of the contacts of the whole: its highest cells, and the heights of all
  /// others.
  /// @throw SurfaceError if these are no rows of the surface
  std::string strip(std::int64_t first_row, std::int64_t rows);
  /// @throw SurfaceError if rows are missing, or the cells do not reach deep enough
  Realisation realise(const SurfaceStrips& strips);
  const std::vector<std::string>& warnings() const { return solver_.warnings(); }
  /// What the scans lack, what of them was filled or left out, and where they contradict each
  /// other, in words.
  const std::vector<std::string>& shortcomings() const { return shortcomings_; }

 private:
  DividedSurface(const UsableScans& scans, const DeviceArea& area, const Options& model,
                 const DeviceForceOptions& options, int number, std::optional<double> depth);
  /// Below the highest place of a strip [m].
  double depth();

  std::unique_ptr<const DeviceLaws> laws_;
  DeviceSurface surface_;
  DeviceAreaSolver solver_;
  std::optional<double> depth_;
  std::vector<std::string> shortcomings_;
};

/// What has come in of a surface.
class SurfaceStrips {
 public:
  explicit SurfaceStrips(DividedSurface& surface);

  /// @throw SurfaceError if it is no strip of this surface, or some of its rows are there already
  void add(std::string_view strip);
  /// @throw SurfaceError if rows are missing
  const AreaCells& cells() const;

 private:
  std::string identity_;
  std::int64_t rows_;
  std::map<std::int64_t, std::int64_t> ends_;  ///< by first row; strips that touch are joined
  std::optional<AreaCells> cells_;
};

}  // namespace mems_stiction
