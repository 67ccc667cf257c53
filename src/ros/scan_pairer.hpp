#pragma once

/// @file
/// Puts each height image together with the scan_info of the same stamp, and tells who was left
/// alone and why. One object serves one thread.
///
/// The messages of one publisher come in order. So a half that came before one of a newer pair, and
/// is older, is alone for good. Not so once stamps go back, as in a bag that starts again, or while
/// several publishers send: then only the timeout tells who is alone. A scan whose halves are given
/// up at different times counts once.
///
/// A stamp that several scans bear does not tell which scan_info belongs to which image. Neither
/// does the order of arrival or header.seq: a half that is lost, or was never sent, shifts all
/// after it. Such scans are pairs only if there are as many images as scan_infos, and every
/// scan_info says the same, also the one after. Else all of them are rejected, until none has come
/// for the timeout. The same goes for stamps that are not set (0), and for all while others repeat.

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

/// Why scans of one stamp are not taken.
inline constexpr char kAmbiguousStamp[] =
    "several scans bear its stamp and differ in their scan_info, or one half is missing: nobody "
    "can tell which "
    "scan_info "
    "belongs to which image; give each scan a header.stamp of its own, or set use_scan_info to "
    "false";

/// A hash of all that a scan_info says but its number.
std::size_t contentOf(ScanInfo info);

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
    std::uint64_t arrival;  ///< number on its topic
    int looks = 0;          ///< of expire()
  };

  /// Those of one stamp.
  struct GivenUp {
    unsigned count = 0;
    std::uint64_t arrival = 0;  ///< of its topic, when the latest was
  };

  /// One of the two topics.
  template <typename Message>
  struct Topic {
    const char* reason;  ///< of a half of this topic that is alone
    std::deque<Waiting<Message>> waiting{};
    std::map<ros::Time, GivenUp> given_up{};  ///< their partners are no scans of their own
    ros::Time last_stamp{};
    std::uint64_t arrivals = 0;
    std::uint64_t anew = 0;  ///< the last arrival whose stamp went back
  };

  /// What came with one stamp, until none has for the timeout, or the stamps of the one publisher
  /// went back.
  struct Bearers {
    unsigned images = 0;
    unsigned infos = 0;
    std::size_t content = 0;  ///< of the latest scan_info, as a hash
    bool differ = false;      ///< two scan_infos do
    bool accepted = false;    ///< a scan
    ros::SteadyTime last{};   ///< when the latest came
    std::uint64_t round = 0;
  };

  void end(const ros::Time& stamp, const Bearers& bearers);
  Bearers& bearersOf(const ros::Time& stamp, ros::SteadyTime now);
  static void count(const sensor_msgs::ImageConstPtr& image, Bearers& bearers);
  static void count(const ScanInfoConstPtr& info, Bearers& bearers);
  void pairAllBut(std::size_t most_waiting, const ros::Time& stamp);
  void rejectAllOf(const ros::Time& stamp);
  void settleLate(ros::SteadyTime now);

  template <typename Message, typename Other>
  void add(const Message& message, ros::SteadyTime now, Topic<Message>& topic, Topic<Other>& other);
  void pair(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info);
  template <typename Message, typename Other, typename Predicate>
  void rejectIf(Topic<Message>& topic, Topic<Other>& other, const Predicate& is_lone,
                const std::string& reason, const std::vector<ros::Time>& partners);
  template <typename Message, typename Other>
  void refuse(const std_msgs::Header& header, const std::string& reason, Topic<Message>& topic,
              Topic<Other>& other);
  template <typename Message, typename Other>
  void makeRoom(Topic<Message>& topic, Topic<Other>& other);
  template <typename Message>
  bool isLate(const Waiting<Message>& waiting, ros::SteadyTime now) const;

  ros::WallDuration timeout_;
  std::size_t max_bytes_;
  Accept accept_;
  Reject reject_;
  Topic<sensor_msgs::ImageConstPtr> images_{"no scan_info with the stamp of the scan came"};
  Topic<ScanInfoConstPtr> infos_{"no scan with the stamp of the scan_info came"};
  bool several_publishers_ = false;
  bool went_back_ = false;          ///< the stamps of a topic did, in the last kSettling timeouts
  ros::SteadyTime went_back_at_{};  ///< when they did last
  std::uint64_t round_ = 0;         ///< how often they did while there was one publisher
  std::map<ros::Time, Bearers> bearers_;
  bool repeats_ = false;  ///< scans that differ bore one stamp, in the last kSettling timeouts
  ros::SteadyTime repeated_at_{};  ///< when they did last
};

}  // namespace mems_stiction
