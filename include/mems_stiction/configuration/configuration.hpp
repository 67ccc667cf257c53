#pragma once

/// @file
/// One configuration file or parameter tree: the model's options and how scans are read and
/// prepared.
///
///     Configuration configuration;
///     configuration.device.spring_stiffness = 10.0;  // [N/m]
///     configuration.device.travel = 1e-6;            // [m]
///     configuration.check();

#include <limits>
#include <string>
#include <vector>

#include "mems_stiction/configuration/provenance.hpp"
#include "mems_stiction/device/device_force_options.hpp"
#include "mems_stiction/half_space/half_space_options.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/height_map/raw_scan.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/preprocess/pipeline_options.hpp"
#include "mems_stiction/roughness/spatial_roughness.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "mems_stiction/surface/counter_surface_options.hpp"
#include "mems_stiction/verdict/device_options.hpp"
#include "mems_stiction/verdict/resolution.hpp"
#include "mems_stiction/verdict/uncertainty_options.hpp"

namespace mems_stiction {

/// What is taken of scans and settings; what is beyond is refused with a sentence. One scan may not
/// take so much of the machine that it stops the ones behind it.
struct ScanLimits {
  static constexpr const char* kMaxTime = "limits/max_time";
  static constexpr const char* kAcceptImplausible = "limits/accept_implausible";

  int max_pixels = 67108864;  ///< after refinement [-], >= 1
  double max_time = 60.0;     ///< of preparation and prediction together [s], >= 0; 0 = none
  /// Take what no instrument, material or device has (scan_sanity.hpp, usual_values.hpp).
  bool accept_implausible = false;

  void describe(OptionVisitor& visitor);

  /// @throw SurfaceError if the scan, refined, has more than max_pixels.
  void checkSize(const HeightMap& scan, int refinement) const;

  /// @throw SurfaceError for a surface that no instrument gives (scan_sanity.hpp), unless
  /// accept_implausible. It is to be judged as cleaned: damage that is mended is none.
  /// - @p is_probe a sphere or tip, which may be higher than its frame is wide
  void checkPlausibility(const HeightMap& cleaned, bool is_probe = false) const;

  /// What a refusal of something implausible ends with.
  static std::string howToAccept();

  /// For TimeLimit [s]: infinity without a limit.
  double longestTime() const {
    return max_time > 0.0 ? max_time : std::numeric_limits<double>::infinity();
  }
};

/// Everything that a configuration file may set.
struct Configuration {
  Options model;
  SpatialRoughnessOptions spatial_roughness;
  PartOptions part;
  ScanOptions scan;
  ScanLimits limits;
  ResolutionOptions resolution;
  PipelineOptions preprocessing;
  CounterSurfaceOptions counter_surface;
  DeviceOptions device;
  DeviceForceOptions device_force;
  UncertaintyOptions uncertainty;
  HalfSpaceOptions half_space;
  /// Of the files that the settings name (counter-surface, masks, polygons) when they were read,
  /// for settingsHash(). Whoever reads them sets it; empty: settingsHash() looks at the files
  /// itself.
  std::string files_checksum;
  /// What is odd about the files that the settings were read from, for settingsWarnings().
  std::vector<std::string> remarks;

  void describe(OptionVisitor& visitor);
  /// Of the tip that drew the scan [m]: resolution/tip_radius, else preprocessing/tip/radius; 0 =
  /// not known.
  double tipRadius() const;
  /// One line per violated constraint; empty when all is well.
  std::vector<std::string> validate() const;
  /// @throw OptionsError with the lines of validate(), if there are any.
  void check() const;
};

}  // namespace mems_stiction
