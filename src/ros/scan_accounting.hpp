#pragma once

/// @file
/// The books of the node: every scan that arrives ends as exactly one of predicted, dropped or
/// rejected; the last two with a reason and a throttled warning. May be called from every thread.

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <string>

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/time.h>
#include <std_msgs/Header.h>

namespace mems_stiction {

/// Counts since start.
struct ScanCounts {
  std::uint64_t received = 0;   ///< predicted + dropped + rejected + waiting
  std::uint64_t predicted = 0;  ///< a prediction was published
  std::uint64_t dropped = 0;    ///< given up for newer ones (drop_policy latest)
  std::uint64_t rejected = 0;   ///< cannot be predicted
  std::uint64_t missing_by_sequence =
      0;  ///< numbers that header.seq skipped in one publisher's sequence: lost on the way
  std::uint64_t stamps_not_increasing =
      0;  ///< scans not newer than the one before: a bag in a loop, a clock set back
  std::uint64_t counter_surfaces = 0;           ///< accepted
  std::uint64_t counter_surfaces_rejected = 0;  ///< cannot be used
  std::uint64_t waiting() const { return received - predicted - dropped - rejected; }
};

/// Counts, warns and reports.
class ScanAccounting {
 public:
  /// @param warning_period at most one warning of a kind in so long a time.
  /// @param report_period between calls of report(); a pause much longer is one in which the
  /// process stood still.
  explicit ScanAccounting(ros::WallDuration warning_period,
                          ros::WallDuration report_period = ros::WallDuration(1.0));

  /// An image came, before it is known whether it is a scan: its number and stamp tell what is
  /// missing before it.
  void arrived(const std_msgs::Header& header);
  /// A scan enters the books.
  void received();
  /// @param latency from arrival to publication [s]; @param processing_time of the core [s]
  void predicted(double latency, double processing_time);
  void dropped(const std_msgs::Header& header, const std::string& reason);
  void rejected(const std_msgs::Header& header, const std::string& reason);
  void counterSurfaceAccepted();
  void counterSurfaceRejected(const std_msgs::Header& header, const std::string& reason);
  /// A throttled warning about a scan that is predicted all the same.
  void warn(const std_msgs::Header& header, const std::string& text);

  ScanCounts counts() const;

  /// One status with every count; WARN if scans were lost since the last report, or the process did
  /// not run.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  /// When one kind was shown last, and how many were not since.
  struct Throttle {
    ros::SteadyTime last_shown;
    std::uint64_t suppressed = 0;
  };

  /// One publisher's numbers. Which of several sent an image, nobody says.
  struct Sequence {
    std::uint32_t last;
    ros::Time stamp;
    std::uint64_t
        missing;  ///< counted when a number went beyond it; taken back if the sequence goes on
  };

  /// @param kind the text without the scan; figures and quotations in it do not matter
  void warnThrottled(const std::string& kind, const std::string& text);

  const ros::WallDuration warning_period_;
  const ros::WallDuration report_period_;
  mutable std::mutex mutex_;
  ScanCounts counts_;
  ScanCounts reported_;
  ros::SteadyTime last_report_;
  std::map<std::string, Throttle> throttles_;  ///< by kind
  std::string last_reason_;
  std::deque<Sequence> sequences_;  ///< the latest first
  double last_latency_ = 0.0;
  double max_latency_ = 0.0;
  double last_processing_time_ = 0.0;
  double longest_pause_ = 0.0;
};

}  // namespace mems_stiction
