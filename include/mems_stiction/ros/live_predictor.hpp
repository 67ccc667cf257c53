#pragma once

/// @file
/// What the node remembers between scans, and the core beside it: the settings that may change, the last scan, the
/// counter-surface and the deformation that has accumulated. No ROS graph; one object serves one thread.

#include <optional>

#include "mems_stiction/ros/image_conversion.hpp"
#include "mems_stiction/ros/predicted_scan.hpp"
#include "mems_stiction/ros/running_options.hpp"
#include "mems_stiction/scan/scan_predictor.hpp"

namespace mems_stiction {

/// What a long run on one scan needs, so that it can go its own way while scans are predicted.
struct StationCase {
  std_msgs::Header header;      ///< of the scan
  Configuration configuration;  ///< with the pose of that scan
  HeightMap scan;               ///< before preprocessing, worn
  HeightMap measured_counter;   ///< for counter_surface/type topic, else empty
};

/// The core as the node uses it, one scan after the other.
class LivePredictor {
 public:
  /// - @p accumulate_deformation the depth that a contact has pressed into a scan is taken off the scans of the same
  ///        size that follow: every scan is then taken for the surface as it was made, worn by the contacts before.
  /// @throw OptionsError if the configuration is out of range.
  LivePredictor(const Configuration& configuration, bool accumulate_deformation);

  /// The scan that the topic brought. @throw SurfaceError if it cannot be predicted; then nothing changes.
  PredictedScan predictScan(const ReceivedScan& scan, const OutputOptions& output);

  /// The one way by which a setting changes while the node runs; all of them at once.
  /// @throw OptionsError naming each refused value; then nothing changes.
  void change(const RunningOptions& options);
  /// The same for both loads [V], [N].
  void setLoad(double voltage, double mechanical_load);

  /// The last scan again, with the settings of now, without adding to the accumulated deformation.
  /// @return nothing if there is no scan yet. @throw SurfaceError if it does not fit a newer counter-surface.
  std::optional<PredictedScan> predictLastScan();

  /// A scan at a load of its own, unworn; nothing is remembered.
  /// @throw OptionsError, SurfaceError as above.
  PredictedScan predictOnce(const ReceivedScan& scan, double voltage, double mechanical_load);

  /// @param given null: the last scan as the contacts before have left it.
  /// @throw SurfaceError if there is no scan, or no counter-surface.
  StationCase stationCase(const ReceivedScan* given) const;

  /// The scan on its own grid as the model gets it, before refinement. @throw SurfaceError if it cannot be used.
  HeightMap prepared(const HeightMap& scan) const { return predictor_.prepared(scan); }

  /// For counter_surface/type topic: the latest is kept.
  void setCounterSurface(const ReceivedScan& counter_surface);

  /// Forgets the accumulated deformation.
  void resetSurface();

  const Configuration& configuration() const { return predictor_.configuration(); }
  RunningOptions runningOptions() const { return RunningOptions(configuration()); }
  const LoadOptions& load() const { return configuration().model.load; }
  const std::optional<ReceivedScan>& lastScan() const { return last_scan_; }

 private:
  PredictedScan run(ScanPredictor& predictor, const HeightMap& surface, const ReceivedScan& scan) const;
  void requireCounterSurface() const;

  ScanPredictor predictor_;
  ScanPredictor single_predictor_;  ///< for predictOnce()
  bool accumulate_deformation_;
  std::optional<ReceivedScan> counter_surface_;
  std::optional<ReceivedScan> last_scan_;
  cv::Mat wear_before_last_scan_;
  cv::Mat wear_;  ///< depth pressed in by the contacts so far, rows x cols CV_64FC1 [m]; empty = none
};

}  // namespace mems_stiction
