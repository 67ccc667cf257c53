#include "ros/scan_pairer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "errors/plain_format.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "ros/message_bytes.hpp"

namespace mems_stiction {
namespace {

constexpr double kNear = 1.0;  // between stamps that may have been meant to be one [s]

constexpr const char* kNeedsOwnStamp =
    ", so nobody can tell which scan_info belongs to which image; give each scan a header.stamp "
    "of its own, or set use_scan_info to false";

constexpr const char* kDoubtful =
    "; a scan of this stamp that was predicted before may have got the scan_info of another";

/// Looks of expire() before anything is late.
constexpr int kFewestLooks = 3;

/// Stamps that are remembered: far more than come in the time in which they matter.
constexpr std::size_t kMostStamps = 100000;

auto bears(const ros::Time& stamp) {
  return [stamp](const auto& waiting) { return waiting.message->header.stamp == stamp; };
}

template <typename Queue>
auto findIn(Queue& queue, const ros::Time& stamp) {
  return std::find_if(queue.begin(), queue.end(), bears(stamp));
}

template <typename Queue>
std::vector<ros::Time> stampsOf(const Queue& queue) {
  std::vector<ros::Time> stamps;
  stamps.reserve(queue.size());
  for (const auto& waiting : queue) stamps.push_back(waiting.message->header.stamp);
  return stamps;
}

template <typename Queue>
std::size_t bytesOfAll(const Queue& queue) {
  return std::accumulate(
      queue.begin(), queue.end(), std::size_t{0},
      [](std::size_t sum, const auto& waiting) { return sum + bytesOf(waiting.message); });
}

/// "; one came with the stamp 12.000001000, 1e-06 s later": two clocks, or a stamp that was
/// rounded. Empty if none is near.
std::string nearestOf(const std::vector<ros::Time>& stamps, const ros::Time& stamp) {
  // not by ros::Time, whose differences end at 2^31 s, and throw beyond
  const auto distance = [&](const ros::Time& other) {
    return 1e-9 * std::abs(static_cast<double>(static_cast<std::int64_t>(other.toNSec()) -
                                               static_cast<std::int64_t>(stamp.toNSec())));
  };
  const auto nearest = std::min_element(
      stamps.begin(), stamps.end(),
      [&](const ros::Time& a, const ros::Time& b) { return distance(a) < distance(b); });
  if (nearest == stamps.end() || distance(*nearest) > kNear || *nearest == stamp) return "";
  PlainStream text;
  text << "; one came with the stamp " << *nearest << ", " << distance(*nearest) << " s "
       << (*nearest > stamp ? "later" : "earlier");
  return text.str();
}

}  // namespace

std::string whySharedStamp() { return std::string("another scan has its stamp") + kNeedsOwnStamp; }

ScanPairer::ScanPairer(ros::WallDuration timeout, Accept accept, Reject reject,
                       std::size_t max_bytes)
    : timeout_(timeout),
      max_bytes_(max_bytes),
      accept_(std::move(accept)),
      reject_(std::move(reject)) {}

/// Rejects a half that waits no more, but if the other half was counted before.
template <typename Message, typename Other>
void ScanPairer::giveUp(const std_msgs::Header& header, const std::string& reason,
                        const Topic<Message>& topic, const Topic<Other>& other) {
  Stamp& stamp = stamps_[header.stamp];
  unsigned& counted = (stamp.*other.half).given_up;
  if (counted > 0) {
    --counted;
    return;
  }
  ++(stamp.*topic.half).given_up;
  reject_(header, reason);
}

template <typename Message, typename Other>
void ScanPairer::rejectOf(const ros::Time& stamp, const std::string& reason, Topic<Message>& topic,
                          const Topic<Other>& other) {
  const auto found = findIn(topic.waiting, stamp);
  if (found == topic.waiting.end()) return;
  const Message message = found->message;
  topic.waiting.erase(found);
  giveUp(message->header, reason, topic, other);
}

/// - @p partners stamps of the other topic's
template <typename Message, typename Other>
void ScanPairer::rejectOldest(std::size_t count, const std::string& reason, Topic<Message>& topic,
                              const Topic<Other>& other, const std::vector<ros::Time>& partners) {
  for (; count > 0; --count) {
    const Message message = topic.waiting.front().message;
    topic.waiting.pop_front();
    giveUp(message->header, topic.reason + reason + nearestOf(partners, message->header.stamp),
           topic, other);
  }
}

/// Rejects the oldest ones of the topic, but never the newest, until the others hold no more than
/// they may.
template <typename Message, typename Other>
void ScanPairer::makeRoom(Topic<Message>& topic, const Topic<Other>& other) {
  std::size_t bytes = bytesOfAll(topic.waiting);
  std::size_t count = 0;
  for (; max_bytes_ > 0 && bytes > max_bytes_ && count + 1 < topic.waiting.size(); ++count) {
    bytes -= bytesOf(topic.waiting[count].message);
  }
  rejectOldest(count, " before newer ones held more than max_waiting_memory", topic, other,
               stampsOf(other.waiting));
}

std::size_t ScanPairer::waitingBytes() const {
  return bytesOfAll(images_.waiting) + bytesOfAll(infos_.waiting);
}

bool ScanPairer::isAnyWaiting(const ros::Time& stamp) const {
  return findIn(images_.waiting, stamp) != images_.waiting.end() ||
         findIn(infos_.waiting, stamp) != infos_.waiting.end();
}

template <typename Message, typename Other>
void ScanPairer::add(const Message& message, ros::SteadyTime now, Topic<Message>& topic,
                     Topic<Other>& other) {
  const ros::Time at = message->header.stamp;
  if (at.isZero()) {
    giveUp(message->header, std::string("it has no stamp (0)") + kNeedsOwnStamp, topic, other);
    return;
  }
  const std::uint32_t number = message->header.seq;
  const bool is_new_publisher =
      number < topic.last_number || (number > 0 && number == topic.last_number);
  if ((at < topic.last_stamp || is_new_publisher) && !several_publishers_) ++topic.round;
  topic.last_stamp = at;
  topic.last_number = number;

  Stamp& stamp = stamps_[at];
  Half& half = stamp.*topic.half;
  if (half.round != topic.round) {
    half = Half();
    half.round = topic.round;
    stamp.is_paired = false;
    rejectOf(at, topic.reason + std::string(" before the stamps began anew"), topic, other);
  } else if (now - stamp.last > timeout_ && !isAnyWaiting(at)) {
    stamp.image.has_come = stamp.info.has_come = stamp.is_paired = false;
  }
  stamp.last = now;
  if (half.has_come) {
    const std::string reason = whySharedStamp() + (stamp.is_paired ? kDoubtful : "");
    rejectOf(at, reason, topic, other);
    rejectOf(at, reason, other, topic);
    giveUp(message->header, reason, topic, other);
    return;
  }
  half.has_come = true;
  topic.waiting.push_back({message, now});
  if (findIn(other.waiting, at) == other.waiting.end()) {
    makeRoom(topic, other);
    return;
  }
  stamp.is_paired = true;
  const auto image = findIn(images_.waiting, at);
  const auto info = findIn(infos_.waiting, at);
  const sensor_msgs::ImageConstPtr first = image->message;
  const ScanInfoConstPtr second = info->message;
  images_.waiting.erase(image);
  infos_.waiting.erase(info);
  accept_(first, second);
}

void ScanPairer::add(const sensor_msgs::ImageConstPtr& image, ros::SteadyTime now) {
  add(image, now, images_, infos_);
}

void ScanPairer::add(const ScanInfoConstPtr& info, ros::SteadyTime now) {
  add(info, now, infos_, images_);
}

template <typename Message, typename Other>
void ScanPairer::refuse(const std_msgs::Header& header, const std::string& reason,
                        Topic<Message>& topic, Topic<Other>& other) {
  if (header.stamp.isZero()) {  // it may be that nothing of the header is known
    reject_(header, reason);
    return;
  }
  rejectOf(header.stamp, reason, other, topic);
  giveUp(header, reason, topic, other);
}

void ScanPairer::refuseImage(const std_msgs::Header& header, const std::string& reason) {
  refuse(header, reason, images_, infos_);
}

void ScanPairer::refuseInfo(const std_msgs::Header& header, const std::string& reason) {
  refuse(header, reason, infos_, images_);
}

void ScanPairer::forgetStamps(ros::SteadyTime now) {
  for (auto one = stamps_.begin(); one != stamps_.end();) {
    const Stamp& stamp = one->second;
    const bool is_over = now - stamp.last > timeout_ && stamp.image.given_up == 0 &&
                         stamp.info.given_up == 0 && !isAnyWaiting(one->first);
    one = is_over ? stamps_.erase(one) : std::next(one);
  }
  while (stamps_.size() > kMostStamps) stamps_.erase(stamps_.begin());
}

void ScanPairer::expire(ros::SteadyTime now) {
  const std::string after = " within " + numberText(timeout_.toSec()) + " s";
  const std::vector<ros::Time> images = stampsOf(images_.waiting);
  const std::vector<ros::Time> infos = stampsOf(infos_.waiting);
  const auto rejectLate = [&](auto& topic, auto& other, const auto& partners) {
    std::size_t count = 0;
    for (auto& one : topic.waiting) {
      if (++one.looks >= kFewestLooks && now - one.since > timeout_) ++count;
    }
    rejectOldest(count, after, topic, other, partners);
  };
  rejectLate(images_, infos_, infos);
  rejectLate(infos_, images_, images);
  forgetStamps(now);
}

}  // namespace mems_stiction
