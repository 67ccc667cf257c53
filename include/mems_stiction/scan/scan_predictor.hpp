#pragma once

/// @file
/// From a scan to its prediction with one configuration: what node, command line and bag tools share to the last line.

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "mems_stiction/scan/configuration.hpp"
#include "mems_stiction/scan/convergence.hpp"
#include "mems_stiction/scan/counter_surface_source.hpp"

namespace mems_stiction {

/// Prepares the scan (configuration.preprocessing), mounts the counter-surface (configuration.counter_surface) and asks
/// the model. One object serves one thread at a time.
///
/// Refinement (preprocessing/refine) stays inside: figures are those of the refined surfaces, maps have the scan's own
/// size. Deformed surfaces are the scan's pixels less the mean depth over each, so that untouched pixels keep their
/// heights; the contact map shows the severest regime within each pixel. Positions of asperities are in the scan's
/// frame.
class ScanPredictor {
 public:
  /// Reads the counter-surface's file, if it has one.
  /// @throw OptionsError if the configuration is out of range, also when that file cannot be used.
  explicit ScanPredictor(const Configuration& configuration);

  const Configuration& configuration() const { return configuration_; }

  /// Both loads at once [V], [N]. @throw OptionsError naming each refused value; then nothing changes.
  void setLoad(double voltage, double mechanical_load);
  /// What the next predictions return beside the figures, which do not depend on it.
  void setOutput(const OutputOptions& output);
  /// Where the counter-surface lies over the next scans, of every type; a plane takes the tilts.
  /// @throw OptionsError naming each refused value; then nothing changes.
  void setCounterSurfacePose(const SurfacePose& pose);

  /// The scan with configuration.preprocessing applied, on its own grid: all steps but refinement. Maps of the
  /// prediction compare with it.
  /// @throw SurfaceError if no pixel is valid, or too many are missing.
  HeightMap prepared(const HeightMap& scan) const;

  /// Against the configured counter-surface. @throw SurfaceError if the scan cannot be used, or the configured
  /// counter-surface is one that arrives beside the scan.
  Prediction predict(const HeightMap& scan);
  /// Against a measured counter-surface. @throw SurfaceError if either cannot be used or their grids differ.
  Prediction predict(const HeightMap& scan, const HeightMap& measured_counter_surface);

  /// What preprocessing did to the scan of the latest prediction.
  const PreprocessRecord& lastRecord() const { return record_; }

  /// predict() at full, half and quarter resolution; rows and columns beyond a multiple of 4 are left out of all three,
  /// so that they see the same area. Both surfaces are made coarser after cleaning and before refinement.
  /// @throw SurfaceError as predict(), or if a side has fewer than 16 pixels.
  std::vector<ConvergenceRow> convergence(const HeightMap& scan);

 private:
  HeightMap prepare(const HeightMap& scan);
  /// @param upper empty for a level plane
  Prediction predictPair(const HeightMap& lower, const HeightMap& upper);
  Prediction predictRefined(const HeightMap& lower, const HeightMap& upper);
  /// What the scan alone decides: flags of resolution, spatial roughness.
  void describeScan(const HeightMap& lower, Prediction& prediction) const;

  Configuration configuration_;
  AdhesionModel model_;
  CounterSurfaceSource counter_surface_;
  PreprocessRecord record_;
};

}  // namespace mems_stiction
