#pragma once

/// @file
/// Puts each height image together with the scan_info of the same stamp, and tells who was left alone and why. One
/// object serves one thread.
///
/// Each topic of one publisher keeps its order, so whoever came on it before a half of a newer pair, and is older, is
/// alone for good. That says nothing once stamps go back, as in a bag that starts again, or while several publishers
/// send: then only the timeout tells who is alone. A scan whose halves are given up at different times counts once.
///
/// Scans of one publisher with equal stamps are pairs as long as they come one after the other. Once two of them wait at the
/// same time they are rejected, until none has come for the timeout.

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

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
  /// - @p max_bytes that those of one topic which wait may hold, but for the newest: older ones are rejected; 0 = any number.
  ScanPairer(ros::WallDuration timeout, Accept accept, Reject reject, std::size_t max_bytes = 0);

  /// Whether several publishers send on one of the topics: their stamps may cross.
  void setSeveralPublishers(bool several) { several_publishers_ = several; }

  void add(const sensor_msgs::ImageConstPtr& image, ros::WallTime now);
  void add(const ScanInfoConstPtr& info, ros::WallTime now);

  /// Rejects what has waited for longer than the timeout and was looked at by this call several times: what a process that
  /// stood still finds waiting may have its partner in the queue. To be called a few times in each timeout.
  void expire(ros::WallTime now);

  std::size_t waiting() const { return images_.waiting.size() + infos_.waiting.size(); }
  std::size_t waitingBytes() const;

 private:
  template <typename Message>
  struct Waiting {
    Message message;
    ros::WallTime since;
    std::uint64_t arrival;  ///< number on its topic
    int looks = 0;          ///< of expire()
  };

  struct GivenUp {
    ros::Time stamp;
    ros::WallTime at;
  };

  /// One of the two topics.
  template <typename Message>
  struct Topic {
    const char* reason;  ///< of a half of this topic that is alone
    std::deque<Waiting<Message>> waiting{};
    std::deque<GivenUp> given_up{};  ///< lately: their partners are no scans of their own
    ros::Time last_stamp{};
    std::uint64_t arrivals = 0;
    std::uint64_t anew = 0;  ///< the last arrival whose stamp went back
  };

  bool isAmbiguous(const ros::Time& stamp, bool waits_twice, ros::WallTime now);
  template <typename Message, typename Other, typename Pair>
  void add(const Message& message, ros::WallTime now, Topic<Message>& topic, Topic<Other>& other, const Pair& pair);
  void pair(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info, ros::WallTime now);
  template <typename Message, typename Other, typename Predicate>
  void rejectIf(Topic<Message>& topic, Topic<Other>& other, const Predicate& is_lone, const std::string& reason,
                const std::vector<ros::Time>& partners, ros::WallTime now);

  template <typename Message, typename Other>
  void makeRoom(Topic<Message>& topic, Topic<Other>& other, ros::WallTime now);

  ros::WallDuration timeout_;
  std::size_t max_bytes_;
  Accept accept_;
  Reject reject_;
  Topic<sensor_msgs::ImageConstPtr> images_{"no scan_info with the stamp of the scan came"};
  Topic<ScanInfoConstPtr> infos_{"no scan with the stamp of the scan_info came"};
  bool several_publishers_ = false;
  bool went_back_ = false;        ///< the stamps of a topic did, in the last kSettling timeouts
  ros::WallTime went_back_at_{};  ///< when they did last
  bool is_ambiguous_ = false;     ///< several scans bore one stamp
  ros::Time ambiguous_stamp_{};
  ros::WallTime ambiguous_at_{};  ///< when the last of them came
};

}  // namespace mems_stiction
