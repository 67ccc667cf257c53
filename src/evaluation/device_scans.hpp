#pragma once

/// @file
/// The force of a device from scans as its settings have them: cleaned, under their
/// counter-surface, with their load. What programs, Python and the node share.
///
///     DeviceScans scans(configuration);
///     for (const auto& [name, scan] : files) scans.add(name, preparer.prepare(scan));
///     const DeviceForce force = scans.force();

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "device/surface_strips.hpp"
#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/evaluation/prepared_scan.hpp"
#include "mems_stiction/verdict/evidence.hpp"

namespace mems_stiction {

/// All scans of the two surfaces of one device. Copies share the pixels.
class DeviceScans {
 public:
  explicit DeviceScans(const Configuration& configuration) : configuration_(configuration) {}

  /// Of the lower surface, with what lies over it: a counter-surface from a file or a generator
  /// counts once on each grid. Where the generated one fits the scan, what is between both counts:
  /// its spectrum has the correlation band by band, and so do the surfaces that are made.
  void add(const std::string& name, const PreparedScan& prepared);
  /// Of the upper surface, as it was measured: cleaned as the scans are, turned over if
  /// counter_surface/facing is up. The first one takes the place of all that lay over the scans.
  /// @throw OptionsError if counter_surface/facing does not say how it lies, or a made one is to
  /// fit the scans; SurfaceError if it cannot be used.
  /// @return what looks wrong in it
  std::vector<std::string> addCounterSurface(const std::string& name, const HeightMap& measured);

  /// Place of the scan with the finest pixels; of several the one that comes before the others
  /// (comesBefore()).
  std::size_t finest() const;

  /// One of the surfaces that are made for it, the whole of it, to be made in strips.
  /// - @p number from 0
  /// - @p depth as of DividedSurface
  /// @throw as DividedSurface()
  DividedSurface surface(int number, std::optional<double> depth) const;
  /// Of device/contact_area and device/contacts. A load on the scanned area counts as one on the
  /// finest scan.
  /// @throw as deviceForce()
  DeviceForce force(const std::function<void(double)>& on_progress = {}) const;
  /// The same by each of several models.
  std::vector<DeviceForce> forces(const std::vector<Options>& models,
                                  const std::function<void(double)>& on_progress = {}) const;

 private:
  DeviceArea area() const {
    return {configuration_.device.contact_area, configuration_.device.contacts};
  }
  /// A warning where scans of several areas leave it open which one a load in newtons presses.
  std::string whichScanIsLoaded(const Options& model) const;
  /// With the load on the finest scan.
  Options loaded(const Options& model) const;

  Configuration configuration_;
  DeviceSurfaces surfaces_;
  std::vector<SurfacePair> frames_;  ///< of the scans
  bool has_own_counter_surface_ = false;
};

/// What one scan by itself says of its device, if the verdict asks for it; where nothing was found,
/// the reason.
/// - @p extra gets the force too, unless null; where it was not found, one with nothing in it but a
/// warning
Evidence evidenceOfScan(const PreparedScan& prepared, const Configuration& configuration,
                        const std::function<void(double)>& on_progress = {},
                        DeviceForce* extra = nullptr);

/// Beside the figures of a scan under several loads, for sweeps and cycles of it; none if the
/// verdict does not ask for them or they were not found.
/// - @p loads on the frame
/// - @p scans of the device; nothing: the scan alone
std::vector<LoadedScale> scalesUnder(const std::vector<LoadOptions>& loads,
                                     const PreparedScan& prepared,
                                     const Configuration& configuration,
                                     const std::function<void(double)>& on_progress = {},
                                     const std::optional<DeviceScans>& scans = std::nullopt);

}  // namespace mems_stiction
