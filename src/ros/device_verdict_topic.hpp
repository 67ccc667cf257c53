#pragma once

/// @file
/// The topic `verdict`: one answer for each part, or for each scan that names none, whoever has judged the device. Touched
/// by the worker only.

#include <cstdint>
#include <deque>
#include <optional>

#include <ros/node_handle.h>

#include "mems_stiction/DeviceVerdict.h"
#include "ros/predicted_scan.hpp"

namespace mems_stiction {

/// What may still change the answer on a scan.
struct AwaitedAnswers {
  bool device_force = false;
  bool half_space = false;
};

/// What judges the device of a scan.
struct DeviceAnswer {
  ScanOfPart last;                    ///< of the part: the scan that came last
  std::optional<Verdict> verdict;     ///< on the device; nothing: it could not be judged
  std::optional<PooledVerdict> part;  ///< what all scans of the part say; nothing if the scan names no part
  bool is_by_device_force = false;
};

/// - @p answer with a verdict
DeviceVerdict deviceVerdictMessage(const DeviceAnswer& answer, const AwaitedAnswers& awaited);

/// Publishes the answers, and remembers the newest of them.
class DeviceVerdictTopic {
 public:
  explicit DeviceVerdictTopic(const ros::NodeHandle& handle);

  /// Without a verdict, what was said of the scan before is said again if it waits for less now.
  void publish(const DeviceAnswer& answer, const AwaitedAnswers& awaited);

 private:
  struct Said {
    std::uint64_t scan_id;
    DeviceVerdict message;
  };

  ros::Publisher publisher_;
  std::deque<Said> said_;  ///< the newest first
};

}  // namespace mems_stiction
