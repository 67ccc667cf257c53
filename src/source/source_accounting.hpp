#pragma once

/// @file
/// The books of scan_source: all that is found ends as published or refused, or waits. Every thread
/// may call.

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/time.h>

namespace mems_stiction {

/// Counts since start.
struct SourceCounts {
  std::uint64_t published = 0;
  std::uint64_t refused = 0;  ///< with a reason each
  std::uint64_t waiting = 0;  ///< not whole yet, or nobody listens
  std::uint64_t repeated =
      0;                   ///< the same content as one that was published, also by an earlier run
  std::uint64_t gone = 0;  ///< removed while they waited
  std::uint64_t found() const { return published + refused + waiting; }
};

/// Counts, warns and reports.
class SourceAccounting {
 public:
  /// - @p tell takes what was refused and why, on one line
  explicit SourceAccounting(std::function<void(const std::string&)> tell)
      : tell_(std::move(tell)) {}

  void published(const std::string& name);
  void refused(const std::string& name, const std::string& reason);
  /// One of those that wait, for newer ones.
  /// - @p most that may wait, by queue_size
  void givenUp(const std::string& name, int most);
  void repeated();
  /// - @p gone so many in all
  void waits(std::uint64_t count, std::uint64_t gone = 0);
  /// What keeps scans from being published at all; empty = nothing. To be said again for as long as
  /// it lasts: the log has what lasts longer than a start.
  void hindered(const std::string& by);
  /// A figure of the source's own, shown with the others.
  void show(const std::string& key, const std::string& value);

  SourceCounts counts() const;
  /// One status with every count; WARN where something was refused since the last report, or is
  /// hindered.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  const std::function<void(const std::string&)> tell_;
  mutable std::mutex mutex_;
  SourceCounts counts_;
  std::uint64_t reported_refused_ = 0;
  std::string last_published_, last_refused_, hindered_by_, told_hindrance_;
  ros::SteadyTime hindered_since_;
  std::vector<std::pair<std::string, std::string>> shown_;
};

}  // namespace mems_stiction
