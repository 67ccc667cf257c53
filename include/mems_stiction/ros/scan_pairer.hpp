#pragma once

/// @file
/// Puts each height image together with the scan_info of the same stamp, and tells who was left alone and why. One
/// object serves one thread.

#include <deque>
#include <functional>
#include <string>

#include <ros/time.h>
#include <sensor_msgs/Image.h>

#include "mems_stiction/ScanInfo.h"

namespace mems_stiction {

/// Holds back each half of a pair until the other one comes, or time is up.
class ScanPairer {
 public:
  using Accept = std::function<void(const sensor_msgs::ImageConstPtr&, const ScanInfoConstPtr&)>;
  /// A message without partner, for good.
  using Reject = std::function<void(const std_msgs::Header&, const std::string& reason)>;

  /// - @p timeout how long a message waits for its partner.
  ScanPairer(ros::WallDuration timeout, Accept accept, Reject reject);

  void add(const sensor_msgs::ImageConstPtr& image, ros::WallTime now);
  void add(const ScanInfoConstPtr& info, ros::WallTime now);

  /// Rejects what has waited for longer than the timeout.
  void expire(ros::WallTime now);

  std::size_t waiting() const { return images_.size() + infos_.size(); }

 private:
  template <typename Message>
  struct Waiting {
    Message message;
    ros::WallTime since;
  };

  void pair(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info);

  ros::WallDuration timeout_;
  Accept accept_;
  Reject reject_;
  std::deque<Waiting<sensor_msgs::ImageConstPtr>> images_;
  std::deque<Waiting<ScanInfoConstPtr>> infos_;
};

}  // namespace mems_stiction
