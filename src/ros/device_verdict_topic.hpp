#pragma once

/// @file
/// The topic `verdict`: one answer for each part, or for each scan that names none, whoever has
/// judged the device. Touched by the worker only.

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include <ros/node_handle.h>

#include "mems_stiction/DeviceVerdict.h"
#include "ros/predicted_scan.hpp"

namespace mems_stiction {

/// What may still change the answer on a scan, or leaves the last word to another one.
struct AwaitedAnswers {
  bool device_force = false;  ///< of a scan of its part
  bool half_space = false;    ///< of a scan of its part
  bool is_overtaken = false;  ///< a newer scan of its part has come
};

/// What judges the device of a scan.
struct DeviceAnswer {
  ScanOfPart last;                 ///< of the part: the scan that came last
  std::optional<Verdict> verdict;  ///< on the device; nothing: it could not be judged
  std::optional<PooledVerdict>
      part;  ///< what all scans of the part say; nothing if the scan names no part
  bool is_by_device_force = false;
};

/// - @p answer with a verdict
DeviceVerdict deviceVerdictMessage(const DeviceAnswer& answer, const AwaitedAnswers& awaited);

/// Remembers the newest answers, so that a late one does not hide that on a newer scan.
class DeviceVerdicts {
 public:
  /// What is to be published, the last one of which is latched. Without a verdict, what was said of
  /// the scan before is said again if it waits for less now, unless it is overtaken. After a late
  /// answer on an earlier scan the newest scan's follows: whoever comes finds that one.
  std::vector<DeviceVerdict> answer(const DeviceAnswer& answer, const AwaitedAnswers& awaited,
                                    bool is_of_newest_scan);
  /// Whether the last answer on the part of a scan, or on a scan that names none, was by the force
  /// of the whole device.
  bool isByDeviceForce(const ScanOfPart& scan) const;

 private:
  struct Said {
    std::uint64_t scan_id;
    DeviceVerdict message;
  };

  std::deque<Said> said_;                ///< the last said first
  std::optional<DeviceVerdict> newest_;  ///< said of the newest scan
};

/// Publishes the answers.
class DeviceVerdictTopic {
 public:
  explicit DeviceVerdictTopic(const ros::NodeHandle& handle);

  void publish(const DeviceAnswer& answer, const AwaitedAnswers& awaited, bool is_of_newest_scan);
  const DeviceVerdicts& said() const { return said_; }

 private:
  ros::Publisher publisher_;
  DeviceVerdicts said_;
};

}  // namespace mems_stiction
