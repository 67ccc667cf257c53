#pragma once

/// @file
/// From a scan to its prediction with one configuration: what node, command line and bag tools
/// share to the last line.

#include <functional>
#include <vector>

#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/evaluation/convergence.hpp"
#include "mems_stiction/evaluation/prepared_scan.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"

namespace mems_stiction {

/// Prepares scans (prepared_scan.hpp) and asks the model. One object serves one thread at a time.
///
///     ScanPredictor predictor(configuration);
///     const PreparedScan prepared = predictor.preparer().prepare(scan);
///     const Prediction prediction = predictor.predict(prepared);
///
/// Refinement (preprocessing/refine) stays inside: figures are those of the refined surfaces, maps
/// have the scan's own size. Deformed surfaces are the scan's pixels less the mean depth over each,
/// so that untouched pixels keep their heights; the contact map shows the severest regime within
/// each pixel. Positions of asperities are in the scan's frame.
class ScanPredictor {
 public:
  /// Reads the counter-surface's file, if it has one.
  /// @throw OptionsError if the configuration is out of range, also when that file cannot be used.
  explicit ScanPredictor(const Configuration& configuration);

  ScanPreparer& preparer() { return preparer_; }
  const ScanPreparer& preparer() const { return preparer_; }

  /// What the model is told beside the surfaces. Roughness is the preparation's: output/roughness
  /// is of no effect here.
  const Options& options() const { return options_; }
  /// For the next predictions; prepared scans stay good. @throw OptionsError naming each refused
  /// value; then nothing changes.
  void setOptions(const Options& options);
  /// What load/device_force is scaled with, for the next predictions.
  void setDevice(const DeviceOptions& device) { device_ = device; }

  /// @throw SurfaceError if the two surfaces do not fit, or it takes longer than
  /// configuration.limits allows.
  /// - @p on_model gets what the model says on its own grid, before it is brought to the scan's
  using OnModel = std::function<void(const Prediction&)>;
  Prediction predict(const PreparedScan& prepared, const OnModel& on_model = {});

  /// The scan of the last predict() once more, under the options and device of now; what follows
  /// from its surfaces alone is not computed again.
  /// - @p prepared that of the last call, of this object's preparer
  Prediction predictAgain(const PreparedScan& prepared);

  /// One scan from its beginning, under a counter-surface that was measured beside it, or the
  /// configured one if that is empty. @throw SurfaceError if either cannot be used or their grids
  /// differ, or if the configured one is one that arrives beside the scan.
  Prediction predict(const HeightMap& scan, const HeightMap& measured_counter_surface = {});

  /// predict() at full, half and quarter resolution; rows and columns beyond a multiple of 4 are
  /// left out of all three, so that they see the same area. Both surfaces are made coarser after
  /// cleaning and before refinement.
  /// @throw SurfaceError as predict(), or if a side has fewer than 16 pixels.
  std::vector<ConvergenceRow> convergence(const PreparedScan& prepared);

 private:
  /// Tells the model what depends on the frame.
  void setFrame(const PreparedScan& prepared);
  /// A prediction of the model as one of the scan.
  Prediction finished(const PreparedScan& prepared, Prediction&& prediction) const;

  ScanPreparer preparer_;
  Options options_;  ///< as they are stated: a load may be per area
  DeviceOptions device_;
  AdhesionModel model_;
  ScanLimits limits_;
  double min_contact_pixels_;
  double tip_radius_;  ///< of the tip that drew the scan [m]; 0 = not known
};

}  // namespace mems_stiction
