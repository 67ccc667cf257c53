#include "mems_stiction/ros/scan_pairer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <sstream>
#include <utility>
#include <vector>

#include <ros/serialization.h>

#include "mems_stiction/base/option_visitor.hpp"

namespace mems_stiction {
namespace {

constexpr double kNear = 1.0;     // between stamps that may have been meant to be one [s]
constexpr double kSettling = 10;  // timeouts for which is remembered what was given up, and that stamps went back

const char* const kAmbiguous =
    "several scans bear its stamp at once, so that nobody can tell which scan_info belongs to which image: does the "
    "driver "
    "set header.stamp?";

/// Looks of expire() before anything is late.
constexpr int kFewestLooks = 3;

template <typename Queue>
std::vector<ros::Time> stampsOf(const Queue& queue) {
  std::vector<ros::Time> stamps;
  stamps.reserve(queue.size());
  for (const auto& waiting : queue) stamps.push_back(waiting.message->header.stamp);
  return stamps;
}

template <typename Message>
std::size_t bytesOf(const Message& message) {
  return ros::serialization::serializationLength(*message);
}

template <typename Queue>
std::size_t bytesOfAll(const Queue& queue) {
  return std::accumulate(queue.begin(), queue.end(), std::size_t{0},
                         [](std::size_t sum, const auto& waiting) { return sum + bytesOf(waiting.message); });
}

/// "; one came with the stamp 12.000001000, 1e-06 s later": two clocks, or a stamp that was rounded. Empty if none is near.
std::string nearestOf(const std::vector<ros::Time>& stamps, const ros::Time& stamp) {
  // not by ros::Time, whose differences end at 2^31 s, and throw beyond
  const auto distance = [&](const ros::Time& other) {
    return 1e-9 * std::abs(static_cast<double>(static_cast<std::int64_t>(other.toNSec()) -
                                               static_cast<std::int64_t>(stamp.toNSec())));
  };
  const auto nearest = std::min_element(
      stamps.begin(), stamps.end(), [&](const ros::Time& a, const ros::Time& b) { return distance(a) < distance(b); });
  if (nearest == stamps.end() || distance(*nearest) > kNear || *nearest == stamp) return "";
  std::ostringstream text;
  text << "; one came with the stamp " << *nearest << ", " << distance(*nearest) << " s "
       << (*nearest > stamp ? "later" : "earlier");
  return text.str();
}

}  // namespace

ScanPairer::ScanPairer(ros::WallDuration timeout, Accept accept, Reject reject, std::size_t max_bytes)
    : timeout_(timeout), max_bytes_(max_bytes), accept_(std::move(accept)), reject_(std::move(reject)) {}

/// Rejects those of the topic that `is_lone` picks, in the order of arrival, but for whom the partner was counted before.
/// - @p partners stamps of the other topic's
template <typename Message, typename Other, typename Predicate>
void ScanPairer::rejectIf(Topic<Message>& topic, Topic<Other>& other, const Predicate& is_lone,
                          const std::string& reason, const std::vector<ros::Time>& partners, ros::WallTime now) {
  std::deque<Waiting<Message>> lone;
  for (auto waiting = topic.waiting.begin(); waiting != topic.waiting.end();) {
    if (is_lone(*waiting)) {
      lone.push_back(std::move(*waiting));
      waiting = topic.waiting.erase(waiting);
    } else {
      ++waiting;
    }
  }
  for (const auto& waiting : lone) {
    const std_msgs::Header& header = waiting.message->header;
    const auto counted = std::find_if(other.given_up.begin(), other.given_up.end(),
                                      [&](const GivenUp& partner) { return partner.stamp == header.stamp; });
    if (counted != other.given_up.end()) {
      other.given_up.erase(counted);
      continue;
    }
    topic.given_up.push_back({header.stamp, now});
    reject_(header, reason + nearestOf(partners, header.stamp));
  }
}

/// Whether scans cannot be told apart by this stamp: two halves of one topic bear it at once, or did lately. One that is lost
/// would shift all pairs after it.
bool ScanPairer::isAmbiguous(const ros::Time& stamp, bool waits_twice, ros::WallTime now) {
  const bool was_ambiguous = is_ambiguous_ && ambiguous_stamp_ == stamp && now - ambiguous_at_ <= timeout_;
  if (!waits_twice && !was_ambiguous) return false;
  is_ambiguous_ = true;
  ambiguous_stamp_ = stamp;
  ambiguous_at_ = now;
  return true;
}

/// Rejects the oldest ones of the topic, but never the newest, until the others hold no more than they may.
template <typename Message, typename Other>
void ScanPairer::makeRoom(Topic<Message>& topic, Topic<Other>& other, ros::WallTime now) {
  std::size_t bytes = bytesOfAll(topic.waiting);
  if (max_bytes_ == 0 || bytes <= max_bytes_) return;
  std::size_t count = 0;
  for (; bytes > max_bytes_ && count + 1 < topic.waiting.size(); ++count) {
    bytes -= bytesOf(topic.waiting[count].message);
  }
  const std::uint64_t first_to_stay = topic.waiting[count].arrival;
  const auto is_too_old = [&](const auto& waiting) { return waiting.arrival < first_to_stay; };
  rejectIf(topic, other, is_too_old, topic.reason + std::string(" before newer ones held more than max_waiting_memory"),
           stampsOf(other.waiting), now);
}

std::size_t ScanPairer::waitingBytes() const { return bytesOfAll(images_.waiting) + bytesOfAll(infos_.waiting); }

/// - @p pair takes the partner
template <typename Message, typename Other, typename Pair>
void ScanPairer::add(const Message& message, ros::WallTime now, Topic<Message>& topic, Topic<Other>& other,
                     const Pair& pair) {
  const ros::Time stamp = message->header.stamp;
  const bool goes_back = topic.arrivals > 0 && stamp < topic.last_stamp;
  topic.last_stamp = stamp;
  const std::uint64_t arrival = ++topic.arrivals;
  if (goes_back) {
    topic.anew = arrival;
    went_back_ = true;
    went_back_at_ = now;
  }
  const auto has_stamp = [&](const auto& waiting) { return waiting.message->header.stamp == stamp; };
  if (!several_publishers_) {
    const auto is_from_before = [&](const auto& waiting) { return waiting.arrival < topic.anew && has_stamp(waiting); };
    rejectIf(topic, other, is_from_before, topic.reason + std::string(" before the stamps began anew"), {}, now);
    const bool waits_twice = std::any_of(topic.waiting.begin(), topic.waiting.end(), has_stamp);
    if (isAmbiguous(stamp, waits_twice, now)) {
      topic.waiting.push_back({message, now, arrival});
      rejectIf(topic, other, has_stamp, kAmbiguous, {}, now);
      return;
    }
  }
  const auto found = std::find_if(other.waiting.begin(), other.waiting.end(), has_stamp);
  if (found == other.waiting.end()) {
    topic.waiting.push_back({message, now, arrival});
    makeRoom(topic, other, now);
    return;
  }
  const Other partner = found->message;
  other.waiting.erase(found);
  pair(partner);
}

void ScanPairer::pair(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info, ros::WallTime now) {
  if (!several_publishers_ && !went_back_) {
    // Whatever waits came since stamps went back last, so that the older one came before.
    const auto is_older = [&image](const auto& waiting) { return waiting.message->header.stamp < image->header.stamp; };
    const std::vector<ros::Time> images = stampsOf(images_.waiting);
    const std::string when = " before a newer pair";
    rejectIf(images_, infos_, is_older, images_.reason + when, stampsOf(infos_.waiting), now);
    rejectIf(infos_, images_, is_older, infos_.reason + when, images, now);
  }
  accept_(image, info);
}

void ScanPairer::add(const sensor_msgs::ImageConstPtr& image, ros::WallTime now) {
  add(image, now, images_, infos_, [&](const auto& info) { pair(image, info, now); });
}

void ScanPairer::add(const ScanInfoConstPtr& info, ros::WallTime now) {
  add(info, now, infos_, images_, [&](const auto& image) { pair(image, info, now); });
}

void ScanPairer::expire(ros::WallTime now) {
  const auto look = [](auto& topic) {
    for (auto& waiting : topic.waiting) ++waiting.looks;
  };
  look(images_);
  look(infos_);
  const auto is_late = [&](const auto& waiting) {
    return now - waiting.since > timeout_ && waiting.looks >= kFewestLooks;
  };
  const std::string after = " within " + numberText(timeout_.toSec()) + " s";
  const std::vector<ros::Time> images = stampsOf(images_.waiting);
  rejectIf(images_, infos_, is_late, images_.reason + after, stampsOf(infos_.waiting), now);
  rejectIf(infos_, images_, is_late, infos_.reason + after, images, now);

  const ros::WallDuration settling = timeout_ * kSettling;
  const auto forget = [&](std::deque<GivenUp>& given_up) {
    while (!given_up.empty() && now - given_up.front().at > settling) given_up.pop_front();
  };
  forget(images_.given_up);
  forget(infos_.given_up);
  went_back_ = went_back_ && now - went_back_at_ <= settling;
}

}  // namespace mems_stiction
