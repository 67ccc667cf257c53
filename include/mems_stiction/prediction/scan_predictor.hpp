#pragma once

/// From a scan to its prediction with one configuration: what node, command line and bag tools share to the last line.

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "mems_stiction/prediction/configuration.hpp"

namespace mems_stiction {

/// Prepares the scan (configuration.preprocessing), mounts the counter-surface (configuration.counter_surface) and asks
/// the model. One object serves one thread at a time.
class ScanPredictor {
 public:
  /// @throw OptionsError if the configuration is out of range.
  explicit ScanPredictor(const Configuration& configuration);

  const Configuration& configuration() const { return configuration_; }

  /// Both loads at once [V], [N]. @throw OptionsError naming each refused value; then nothing changes.
  void setLoad(double voltage, double mechanical_load);
  /// What the next predictions return beside the figures, which do not depend on it.
  void setOutput(const OutputOptions& output);

  /// The scan as the model gets it: configuration.preprocessing applied. @throw SurfaceError if no pixel is valid.
  HeightMap prepared(const HeightMap& scan) const;

  /// Against the flat counter-surface. @throw SurfaceError if the scan cannot be used, or the configured
  /// counter-surface is not flat.
  Prediction predict(const HeightMap& scan);
  /// Against a measured counter-surface. @throw SurfaceError if either cannot be used or their grids differ.
  Prediction predict(const HeightMap& scan, const HeightMap& measured_counter_surface);

 private:
  Configuration configuration_;
  AdhesionModel model_;
};

}  // namespace mems_stiction
