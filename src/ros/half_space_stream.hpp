#pragma once

/// @file
/// half_space/enabled: the half-space beside the predictions. A thread of its own solves the newest
/// scan, publishes the answer, and takes the scan that is the newest then. Of those between, some
/// wait whose flags ask for it; the others are skipped. It takes the prepared scan and the settings
/// of its prediction, whatever changes meanwhile: the answer belongs to the prediction of its
/// stamp.

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <image_transport/image_transport.h>
#include <ros/node_handle.h>
#include <opencv2/core.hpp>

#include "evaluation/half_space_call.hpp"
#include "half_space/solution_pause.hpp"
#include "mems_stiction/HalfSpaceSolution.h"
#include "mems_stiction/half_space/half_space_solver.hpp"
#include "ros/awaited_scans.hpp"
#include "ros/live_predictor.hpp"

namespace mems_stiction {

/// Solves the newest of the scans that it is offered.
class HalfSpaceStream {
 public:
  /// Called for each scan without a solution, on the thread of the half-space or on that of
  /// offer().
  using Warn = std::function<void(const std_msgs::Header& header, const std::string& text)>;

  /// Called for each scan whose turn has come or has passed: with the verdict, or without one. On
  /// the thread of the half-space or on that of offer().
  using Judged = std::function<void(const ScanOfPart& scan, const std::optional<Verdict>& verdict)>;

  /// Called before that with what judges it, on the thread of the half-space.
  using Solved = std::function<void(const StationCase& scan, const SolvedHalfSpace& solution,
                                    const std::string& why)>;

  /// What is known of the device of a scan, called on the thread of the half-space.
  using Beside = std::function<Evidence(const StationCase& scan)>;

  /// - @p pause is given way to; it must outlive the stream
  HalfSpaceStream(const ros::NodeHandle& handle, const HalfSpaceOptions& options,
                  SolutionPause& pause, Warn warn, Judged judged, Solved solved, Beside beside);
  ~HalfSpaceStream() { stop(); }
  HalfSpaceStream(const HalfSpaceStream&) = delete;
  HalfSpaceStream& operator=(const HalfSpaceStream&) = delete;

  void start();
  /// Gives up what is being solved, which is not published, and joins the thread.
  void stop();

  /// Takes the place of a scan that waits, unless flags ask for that one. Copies no pixels.
  /// - @p call that is made
  /// - @p scan where its prediction comes from
  void offer(const HalfSpaceCall& call, const StationCase& predicted, const ScanOfPart& scan);

  /// Whether the solution of a scan of the same part is to come: that scan waits, or is at hand, or
  /// its answer has not been taken.
  bool isExpected(const ScanOfPart& scan) const;
  /// An answer has come to whoever makes use of it.
  void taken(const ScanOfPart& scan);

  /// One status with every count; WARN if a scan since the last report has no solution.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  struct Task {
    HalfSpaceCall call;
    StationCase predicted;
    ScanOfPart scan;
  };
  /// Since start.
  struct Counts {
    std::uint64_t offered = 0;  ///< solved + skipped + failed + the one at hand and those that wait
    std::uint64_t solved = 0;
    std::uint64_t skipped = 0;  ///< a newer scan came before their turn
    std::uint64_t failed = 0;   ///< published with another status
  };

  void loop();
  /// @return the verdict on the scan's device; nothing if it could not be judged
  std::optional<Verdict> solve(const Task& task);
  /// The message always, the contact map while somebody listens.
  void publish(const HalfSpaceSolution& solution, const cv::Mat& map) const;

  const HalfSpaceSolver solver_;
  SolutionPause& pause_;
  image_transport::ImageTransport transport_;
  ros::Publisher solution_publisher_;
  image_transport::Publisher contact_map_publisher_;
  Warn warn_;
  Judged judged_;
  Solved solved_;
  Beside beside_;
  std::atomic<bool> stopping_{false};
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Task> waiting_;  ///< the newest at the end
  AwaitedScans awaited_;
  Counts counts_;
  std::uint64_t reported_failed_ = 0;
  std::string last_failure_;
  double last_time_ = 0.0;  ///< of a solution [s]
  std::thread thread_;
};

}  // namespace mems_stiction
