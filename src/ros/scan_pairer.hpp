#pragma once

/// @file
/// Puts each height image together with the scan_info of the same stamp, and tells who was left
/// alone and why. One object serves one thread.
///
/// Two rules. A scan has a stamp of its own: neither 0 nor that of a scan whose halves came within
/// the timeout. Else nobody can tell which scan_info belongs to which image, and it is rejected,
/// with whatever waits under that stamp. And a half waits for the other one up to the timeout. A
/// scan whose halves are given up at different times counts once.
///
/// Once stamps of a topic go back, as in a bag that starts again, or its header.seq, as where a
/// publisher starts again, those that came before count as new. Not so while several publishers
/// send, whose stamps cross.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <ros/time.h>
#include <sensor_msgs/Image.h>

#include "mems_stiction/ScanInfo.h"

namespace mems_stiction {

/// Why scans that share a stamp are not taken, and what to do.
std::string whySharedStamp();

/// Holds back each half of a pair until the other one comes, or time is up.
class ScanPairer {
 public:
  using Accept = std::function<void(const sensor_msgs::ImageConstPtr&, const ScanInfoConstPtr&)>;
  /// A message without partner, for good.
  using Reject = std::function<void(const std_msgs::Header&, const std::string& reason)>;

  /// - @p timeout how long a message waits for its partner.
  /// - @p max_bytes that those of one topic which wait may take, but for the newest: older ones are
  /// rejected; 0 = any number.
  ScanPairer(ros::WallDuration timeout, Accept accept, Reject reject, std::size_t max_bytes = 0);

  /// Whether several publishers send on one of the topics: their stamps may cross.
  void setSeveralPublishers(bool several) { several_publishers_ = several; }

  void add(const sensor_msgs::ImageConstPtr& image, ros::SteadyTime now);
  void add(const ScanInfoConstPtr& info, ros::SteadyTime now);

  /// An image or a scan_info that came and cannot be read: rejected. Its partner is no scan of its
  /// own.
  void refuseImage(const std_msgs::Header& header, const std::string& reason);
  void refuseInfo(const std_msgs::Header& header, const std::string& reason);

  /// Rejects what has waited for longer than the timeout and was looked at by this call several
  /// times: what a process that stood still finds waiting may have its partner in the queue. To be
  /// called a few times in each timeout.
  void expire(ros::SteadyTime now);

  std::size_t waiting() const { return images_.waiting.size() + infos_.waiting.size(); }
  std::size_t waitingBytes() const;

 private:
  template <typename Message>
  struct Waiting {
    Message message;
    ros::SteadyTime since;
    int looks = 0;  ///< of expire()
  };

  /// What is known of one topic's halves of one stamp.
  struct Half {
    bool has_come = false;
    std::uint64_t round = 0;  ///< of the topic, when it came
    unsigned given_up = 0;    ///< so many of the other topic's halves are no scans of their own
  };
  struct Stamp {
    Half image, info;
    bool is_paired = false;
    ros::SteadyTime last{};  ///< when the latest half came
  };

  /// One of the two topics.
  template <typename Message>
  struct Topic {
    const char* reason;  ///< of a half of this topic that is alone
    Half Stamp::*half;
    std::deque<Waiting<Message>> waiting{};  ///< one of a stamp, in the order of arrival
    ros::Time last_stamp{};
    std::uint32_t last_number = 0;  ///< header.seq, which each publisher counts
    std::uint64_t round = 0;        ///< how often its one publisher began anew
  };

  template <typename Message, typename Other>
  void add(const Message& message, ros::SteadyTime now, Topic<Message>& topic, Topic<Other>& other);
  template <typename Message, typename Other>
  void refuse(const std_msgs::Header& header, const std::string& reason, Topic<Message>& topic,
              Topic<Other>& other);
  template <typename Message, typename Other>
  void giveUp(const std_msgs::Header& header, const std::string& reason,
              const Topic<Message>& topic, const Topic<Other>& other);
  template <typename Message, typename Other>
  void rejectOf(const ros::Time& stamp, const std::string& reason, Topic<Message>& topic,
                const Topic<Other>& other);
  template <typename Message, typename Other>
  void rejectOldest(std::size_t count, const std::string& reason, Topic<Message>& topic,
                    const Topic<Other>& other, const std::vector<ros::Time>& partners);
  template <typename Message, typename Other>
  void makeRoom(Topic<Message>& topic, const Topic<Other>& other);
  bool isAnyWaiting(const ros::Time& stamp) const;
  void forgetStamps(ros::SteadyTime now);

  ros::WallDuration timeout_;
  std::size_t max_bytes_;
  Accept accept_;
  Reject reject_;
  Topic<sensor_msgs::ImageConstPtr> images_{"no scan_info with the stamp of the scan came",
                                            &Stamp::image};
  Topic<ScanInfoConstPtr> infos_{"no scan with the stamp of the scan_info came", &Stamp::info};
  bool several_publishers_ = false;
  std::map<ros::Time, Stamp> stamps_;
};

}  // namespace mems_stiction
