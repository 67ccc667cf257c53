#pragma once

/// @file
/// device_force/enabled: the force of the whole device beside the predictions. A thread of its own
/// takes the newest scan with all scans of its part, makes surfaces of the device's size, publishes
/// their force with the verdict by it, and takes what is the newest then.
///
/// What is at hand is brought to its end, whatever comes: an answer belongs to the scan of its
/// stamp and the settings of its prediction. Of each part its newest scan waits; those before are
/// in its surfaces. A scan without a part waits until the next one comes. The verdict takes the
/// flags and the half-space of the finest scan, in whatever order the scans came, as programs do
/// (device_prediction.hpp). Where the same scans come again with another spring, or a half-space of
/// the finest one comes, the verdict is found anew by the force that is there.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/node_handle.h>

#include "evaluation/device_scans.hpp"
#include "evaluation/part_surfaces.hpp"
#include "half_space/solution_pause.hpp"
#include "ros/awaited_scans.hpp"
#include "ros/device_force_conversion.hpp"
#include "ros/device_verdict_topic.hpp"
#include "ros/live_predictor.hpp"

namespace mems_stiction {

/// Finds the force of the newest of the scans that it is offered.
class DeviceForceStream {
 public:
  /// Called for each scan without a force, on the stream's thread or on that of offer().
  using Warn = std::function<void(const std_msgs::Header& header, const std::string& text)>;

  /// Called for each scan that was offered and that no newer one of its part has overtaken, once
  /// nothing more is to come of it: with the verdict on its device, or without one. On the stream's
  /// thread or on that of offer().
  using Judged = std::function<void(const DeviceAnswer& answer)>;

  /// - @p pause is given way to; it must outlive the stream
  DeviceForceStream(const ros::NodeHandle& handle, const SurfaceLimits& most, SolutionPause& pause,
                    Warn warn, Judged judged);
  ~DeviceForceStream() { stop(); }
  DeviceForceStream(const DeviceForceStream&) = delete;
  DeviceForceStream& operator=(const DeviceForceStream&) = delete;

  void start();
  /// Gives up what is at hand, which is not published, and joins the thread.
  void stop();

  /// Takes the place of a scan of the same part that waits. Nothing happens if the settings ask for
  /// no force of a device. Copies no pixels.
  /// - @p predicted of the scan, under the settings of the case
  void offer(const StationCase& scan, const PredictedScan& predicted);

  /// A half-space of a scan, which judges its device too: from now on, and once more if its force
  /// has been found.
  /// - @p why as of Evidence
  void takeHalfSpace(const StationCase& scan, const SolvedHalfSpace& solution,
                     const std::string& why);

  /// All scans of the device, if its force was found last, for just this scan.
  std::optional<DeviceScans> scansOf(const StationCase& scan) const;
  /// The same as evidence for a verdict on the scan, under the load of the case alone.
  Evidence evidenceOf(const StationCase& scan) const;

  /// Whether the force of a scan of the same part is to come: that scan waits, or is at hand, or
  /// its answer has not been taken.
  bool isExpected(const ScanOfPart& scan) const;
  /// An answer has come to whoever makes use of it.
  void taken(const ScanOfPart& scan);

  /// One status with every count; WARN if a scan since the last report has no force.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  using Clock = std::chrono::steady_clock;

  struct Task {
    PartName part;
    ScanOfPart scan;
    SettingsOwner::Snapshot settings;
    PreparedScan newest;    ///< its surfaces
    Prediction prediction;  ///< of it, without maps
  };
  /// What was found last, to judge by it again.
  struct Found {
    PreparedScan newest;                 ///< scan
    std::vector<std::uint64_t> numbers;  ///< of the surfaces of the scans
    std::string hash;                    ///< of the settings that bear on the force
    DeviceScans scans;
    PreparedScan finest;   ///< of the scans
    Prediction of_finest;  ///< without maps
    DeviceForce force;
    double time = 0.0;  ///< that it took [s]
  };
  /// Since start.
  struct Counts {
    std::uint64_t offered =
        0;  ///< found + judged_again + skipped + failed + the one at hand and those that wait
    std::uint64_t found = 0;
    std::uint64_t judged_again = 0;
    std::uint64_t skipped = 0;  ///< a newer scan came before their turn
    std::uint64_t failed = 0;   ///< published as REFUSED
  };

  /// A half-space, and what it is of.
  struct HalfSpaceOfScan {
    PreparedScan scan;
    std::string hash;  ///< of the settings that bear on the device's force
    SolvedHalfSpace solution;
    std::string why;

    bool isOf(const PreparedScan& other, const std::string& other_hash) const;
  };
  /// A part's newest task.
  struct NewestTask {
    Task task;
    std::string hash;     ///< as of HalfSpaceOfScan
    PreparedScan finest;  ///< of its scans; empty until its verdict has looked for a half-space
  };

  /// With the mutex held: whether it is of a scan of one of the newest tasks' parts.
  bool mayJudge(const HalfSpaceOfScan& half_space) const;
  /// With the mutex held: the oldest that may not judge, if there are too many.
  void forgetHalfSpace();
  void loop();
  /// @return without a verdict if it could not be judged
  DeviceAnswer work(const Task& task, const ScannedPart& part);
  /// With the mutex held: whether it was found with just this scan, but for the load.
  bool isFoundWith(const StationCase& scan) const;
  /// What the part's surfaces say under the task's settings, and whether they had to be made.
  DeviceAdhesion find(const Task& task, const ScannedPart& part, std::optional<Verdict>& verdict);
  DeviceForce make(const DeviceScans& scans);

  SolutionPause& pause_;
  ros::Publisher publisher_;
  Warn warn_;
  Judged judged_;
  std::atomic<bool> stopping_{false};

  mutable std::mutex mutex_;
  std::optional<Found> found_;  ///< changed by the stream's thread only
  std::deque<HalfSpaceOfScan>
      half_spaces_;  ///< the newest first; a few, since several scans wait for theirs
  std::deque<NewestTask> newest_tasks_;  ///< the newest first, one of each part
  AwaitedScans awaited_;
  std::condition_variable changed_;
  PartSurfaces parts_;
  std::vector<Task> waiting_;  ///< one of each part, the newest at the end
  Counts counts_;
  std::uint64_t reported_failed_ = 0;
  std::string last_failure_;
  double last_time_ = 0.0;                  ///< of surfaces that were made [s]
  std::optional<Clock::time_point> since_;  ///< when the surfaces at hand were begun
  double share_ = 0.0;                      ///< of them that is done
  std::thread thread_;
};

}  // namespace mems_stiction
