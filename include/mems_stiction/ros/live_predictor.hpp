#pragma once

/// What the node remembers between scans, and the core beside it: the load, the last scan, the counter-surface and the
/// deformation that has accumulated. No ROS graph; one object serves one thread.

#include <optional>

#include "mems_stiction/prediction/scan_predictor.hpp"
#include "mems_stiction/ros/image_conversion.hpp"

namespace mems_stiction {

class LivePredictor {
 public:
  /// @param accumulate_deformation the depth that a contact has pressed into a scan is taken off the scans of the same
  ///        size that follow: every scan is then taken for the surface as it was made, worn by the contacts before.
  /// @throw OptionsError if the configuration is out of range.
  LivePredictor(const Configuration& configuration, bool accumulate_deformation);

  /// The scan that the topic brought. @throw SurfaceError if it cannot be predicted; then nothing changes.
  Prediction predictScan(const ReceivedScan& scan, const OutputOptions& output);

  /// Both loads at once [V], [N]. @throw OptionsError naming each refused value; then nothing changes.
  void setLoad(double voltage, double mechanical_load) { predictor_.setLoad(voltage, mechanical_load); }

  /// The last scan again, at the load that is set, without adding to the accumulated deformation.
  /// @return nothing if there is no scan yet. @throw SurfaceError if it does not fit a newer counter-surface.
  std::optional<Prediction> predictLastScan();

  /// A scan at a load of its own, unworn; nothing is remembered.
  /// @throw OptionsError, SurfaceError as above.
  Prediction predictOnce(const HeightMap& scan, double voltage, double mechanical_load);

  /// For counter_surface/type topic: the latest is kept.
  void setCounterSurface(const ReceivedScan& counter_surface);

  /// Forgets the accumulated deformation.
  void resetSurface();

  const LoadOptions& load() const { return predictor_.configuration().model.load; }
  const std::optional<ReceivedScan>& lastScan() const { return last_scan_; }

 private:
  Prediction run(ScanPredictor& predictor, const HeightMap& surface) const;

  ScanPredictor predictor_;
  ScanPredictor single_predictor_;  ///< for predictOnce()
  bool accumulate_deformation_;
  std::optional<ReceivedScan> counter_surface_;
  std::optional<ReceivedScan> last_scan_;
  cv::Mat wear_before_last_scan_;
  cv::Mat wear_;  ///< depth pressed in by the contacts so far, rows x cols CV_64FC1 [m]; empty = none
};

}  // namespace mems_stiction
