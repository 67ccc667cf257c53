#pragma once

/// @file
/// Which force holds a device whose contacts are larger, or smaller, than the scans of its surface?
///
/// A larger pair of rough surfaces rests on a higher summit and stands further apart, so that a
/// handful of places holds it whatever its area: the force of a frame times area is too large by
/// one to two orders (doc/device.md). So surfaces of the device's size are made, with the spectrum
/// and the distribution of heights that all scans say together, and each is brought to contact by
/// the separation curve. The figure is their median; its interval holds their scatter, what the
/// scans leave open of spectrum, long waves and highest summits, the constants and the model.
///
///     DeviceSurfaces surfaces;
///     surfaces.scans = {{"a.gwy", a}, {"b.gwy", b}};
///     const DeviceForce force = deviceForce(surfaces, {1e-8, 1}, options, uncertainty, {});

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "mems_stiction/device/device_force_options.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/roughness/unresolved_waves.hpp"
#include "mems_stiction/verdict/uncertainty_options.hpp"

namespace mems_stiction {

/// One scan of a surface, cleaned.
struct NamedScan {
  std::string name;  ///< for sentences about it
  HeightMap surface;
  std::optional<UnresolvedWaves> short_waves =
      std::nullopt;  ///< that it does not show; nothing: as its pixels say
};

/// All that has been scanned of the two surfaces that meet, of any pitch and size.
struct DeviceSurfaces {
  std::vector<NamedScan> scans;  ///< of the lower surface, at least one
  std::vector<NamedScan>
      counter_surface;  ///< of the upper one, as it faces the lower; empty = a level plane
};

/// What of the device touches.
struct DeviceArea {
  double area = 0.0;  ///< nominal, of all contacts together [m^2], > 0
  int contacts = 1;   ///< separate ones that share it, >= 1
};

/// One made surface, or one set of the scans' own parts.
struct Realisation {
  double pull_off_force = 0.0;             ///< [N]
  double apparent_work_of_adhesion = 0.0;  ///< [J/m^2]
  int contacts = 0;                        ///< that hold at the pull-off
  double separation_at_rest = 0.0;         ///< mean gap [m]
};

/// The pull-off force of a part of a scan, as it was predicted.
struct PartOfScan {
  double area = 0.0;            ///< [m^2]
  double pull_off_force = 0.0;  ///< [N]
};

/// What the scans say together of the waves of one band.
struct BandOfWaves {
  double wavelength = 0.0;     ///< [m]
  double density = 0.0;        ///< power spectral density, averaged over directions [m^4]
  double density_lower = 0.0;  ///< 2.5 % quantile [m^4]
  double density_upper = 0.0;  ///< 97.5 % quantile [m^4]
  double rms_height = 0.0;     ///< of all waves shorter than this, with those of the band [m]
  double rms_slope = 0.0;      ///< of all waves longer than this, with those of the band [-]
  double rms_curvature = 0.0;  ///< the same [1/m]
  bool is_measured = true;     ///< false: continued beyond what the scans show
};

/// NaN stands for what could not be said.
struct DeviceForce {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  double pull_off_force = kUnknown;                   ///< median [N]
  double pull_off_force_lower = kUnknown;             ///< 2.5 % quantile [N]
  double pull_off_force_upper = kUnknown;             ///< 97.5 % quantile [N]
  double apparent_work_of_adhesion = kUnknown;        ///< median [J/m^2]
  double apparent_work_of_adhesion_lower = kUnknown;  ///< 2.5 % quantile [J/m^2]
  double apparent_work_of_adhesion_upper = kUnknown;  ///< 97.5 % quantile [J/m^2]
  double linear_pull_off_force = kUnknown;  ///< mean force of the scans by area, for comparison [N]
  double contacts = kUnknown;               ///< that hold at the pull-off, median [-]
  double separation_at_rest = kUnknown;     ///< mean gap, median [m]
  bool is_conforming = false;  ///< the surfaces bond all over: force and work go with area
  double area = kUnknown;      ///< [m^2]
  double pitch = kUnknown;     ///< of the made surfaces [m]
  double force_deviation =
      kUnknown;  ///< standard deviation of ln force but for constants and model [-]
  double work_deviation = kUnknown;  ///< the same of ln work [-]
  /// The distributions whose 2.5 % and 97.5 % quantiles the intervals are: samples over the median,
  /// ascending [-]. A verdict takes its margin from them.
  std::vector<double> force_factors;
  std::vector<double> work_factors;
  /// The same where a half-space has answered what the curve doubts; empty: it doubts nothing.
  std::vector<double> force_factors_without_doubt;
  std::vector<double> work_factors_without_doubt;
  std::vector<Realisation> realisations;
  std::vector<PartOfScan> parts_of_scans;
  int contacts_of_scans = 0;  ///< that hold at the pull-off in all scans together
  bool is_cut_from_scans =
      false;  ///< the realisations are places of the scans: no surface was made
  std::vector<BandOfWaves> spectrum;  ///< by descending wavelength
  std::vector<std::string> warnings;  ///< in words
  std::string missing_scan;  ///< without which the force is not known, since no scan shows what
                             ///< holds; empty: none
  HeightMap made_surface;    ///< the relief of the first one, to look at: pixels left out; empty
                             ///< where none was made
};

/// - @p model the settings of the prediction; its voltage and load make the rest, as they do of a
/// frame
/// - @p on_progress called with the share that is done, in [0, 1]; may throw to end it
/// @throw OptionsError for an area or settings out of range
/// @throw SurfaceError if no scan can be used; the sentence names it
DeviceForce deviceForce(const DeviceSurfaces& surfaces, const DeviceArea& area,
                        const Options& model, const UncertaintyOptions& uncertainty,
                        const DeviceForceOptions& options,
                        const std::function<void(double)>& on_progress = {});

/// The same by several models, as by constants that are sought: the surfaces are made once, which
/// is most of the work. Each force is that of deviceForce() to the last bit.
std::vector<DeviceForce> deviceForces(const DeviceSurfaces& surfaces, const DeviceArea& area,
                                      const std::vector<Options>& models,
                                      const UncertaintyOptions& uncertainty,
                                      const DeviceForceOptions& options,
                                      const std::function<void(double)>& on_progress = {});

}  // namespace mems_stiction
