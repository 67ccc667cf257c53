#include "ros/scan_pairer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

#include <ros/serialization.h>

#include "errors/plain_format.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "ros/message_bytes.hpp"

namespace mems_stiction {
namespace {

constexpr double kNear = 1.0;  // between stamps that may have been meant to be one [s]
constexpr double kSettling =
    10;  // timeouts for which is remembered what came, and that stamps went back or repeated

constexpr const char* kDoubtful =
    "; a scan of this stamp that was predicted before may have got the scan_info of another";

/// Looks of expire() before anything is late.
constexpr int kFewestLooks = 3;

/// Stamps that are remembered: far more than come in the time in which they matter.
constexpr std::size_t kMostStamps = 100000;

/// Those of the oldest stamps go. Not for what has no stamp, which is one.
template <typename Map>
void forgetOldest(Map& by_stamp) {
  while (by_stamp.size() > kMostStamps) {
    const bool has_unset = by_stamp.begin()->first.isZero();
    by_stamp.erase(has_unset ? std::next(by_stamp.begin()) : by_stamp.begin());
  }
}

auto bears(const ros::Time& stamp) {
  return [stamp](const auto& waiting) { return waiting.message->header.stamp == stamp; };
}

template <typename Queue>
std::size_t countOf(const Queue& queue, const ros::Time& stamp) {
  return static_cast<std::size_t>(std::count_if(queue.begin(), queue.end(), bears(stamp)));
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

std::size_t contentOf(ScanInfo info) {
  info.header.seq = 0;
  std::string bytes(ros::serialization::serializationLength(info), '\0');
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the bytes of a string, as roscpp
  // wants them
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                     static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, info);
  return std::hash<std::string>()(bytes);
}

ScanPairer::ScanPairer(ros::WallDuration timeout, Accept accept, Reject reject,
                       std::size_t max_bytes)
    : timeout_(timeout),
      max_bytes_(max_bytes),
      accept_(std::move(accept)),
      reject_(std::move(reject)) {}

/// Rejects those of the topic that `is_lone` picks, in the order of arrival, but for whom the
/// partner was counted before.
/// - @p partners stamps of the other topic's
template <typename Message, typename Other, typename Predicate>
void ScanPairer::rejectIf(Topic<Message>& topic, Topic<Other>& other, const Predicate& is_lone,
                          const std::string& reason, const std::vector<ros::Time>& partners) {
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
    const auto counted = other.given_up.find(header.stamp);
    if (counted != other.given_up.end()) {
      if (--counted->second.count == 0) other.given_up.erase(counted);
      continue;
    }
    GivenUp& given_up = topic.given_up[header.stamp];
    ++given_up.count;
    given_up.arrival = topic.arrivals;
    forgetOldest(topic.given_up);
    reject_(header, reason + nearestOf(partners, header.stamp));
  }
}

/// Of several scans of one stamp nobody knows whose halves come late.
void ScanPairer::end(const ros::Time& stamp, const Bearers& bearers) {
  if (bearers.images <= 1 && bearers.infos <= 1) return;
  images_.given_up.erase(stamp);
  infos_.given_up.erase(stamp);
}

ScanPairer::Bearers& ScanPairer::bearersOf(const ros::Time& stamp, ros::SteadyTime now) {
  Bearers& bearers = bearers_[stamp];
  const bool is_over = now - bearers.last > timeout_ &&
                       countOf(images_.waiting, stamp) + countOf(infos_.waiting, stamp) == 0;
  if (is_over) end(stamp, bearers);
  if (is_over || bearers.round != round_) bearers = Bearers();
  bearers.round = round_;
  bearers.last = now;
  forgetOldest(bearers_);
  return bearers_[stamp];
}

void ScanPairer::count(const sensor_msgs::ImageConstPtr& /*image*/, Bearers& bearers) {
  ++bearers.images;
}

void ScanPairer::count(const ScanInfoConstPtr& info, Bearers& bearers) {
  const std::size_t content = contentOf(*info);
  if (bearers.infos > 0 && content != bearers.content) bearers.differ = true;
  bearers.content = content;
  ++bearers.infos;
}

/// Pairs those of the stamp in the order of arrival.
/// - @p most_waiting how many pairs, the newest, are to wait on
void ScanPairer::pairAllBut(std::size_t most_waiting, const ros::Time& stamp) {
  for (std::size_t count = countOf(images_.waiting, stamp); count > most_waiting; --count) {
    const auto image = std::find_if(images_.waiting.begin(), images_.waiting.end(), bears(stamp));
    const auto info = std::find_if(infos_.waiting.begin(), infos_.waiting.end(), bears(stamp));
    if (image == images_.waiting.end() || info == infos_.waiting.end()) return;
    const sensor_msgs::ImageConstPtr first_image = image->message;
    const ScanInfoConstPtr first_info = info->message;
    images_.waiting.erase(image);
    infos_.waiting.erase(info);
    bearers_[stamp].accepted = true;
    pair(first_image, first_info);
  }
}

void ScanPairer::rejectAllOf(const ros::Time& stamp) {
  const std::string reason =
      std::string(kAmbiguousStamp) + (bearers_[stamp].accepted ? kDoubtful : "");
  rejectIf(images_, infos_, bears(stamp), reason, {});
  rejectIf(infos_, images_, bears(stamp), reason, {});
}

/// Rejects the oldest ones of the topic, but never the newest, until the others hold no more than
/// they may.
template <typename Message, typename Other>
void ScanPairer::makeRoom(Topic<Message>& topic, Topic<Other>& other) {
  std::size_t bytes = bytesOfAll(topic.waiting);
  if (max_bytes_ == 0 || bytes <= max_bytes_) return;
  std::size_t count = 0;
  for (; bytes > max_bytes_ && count + 1 < topic.waiting.size(); ++count) {
    bytes -= bytesOf(topic.waiting[count].message);
  }
  const std::uint64_t first_to_stay = topic.waiting[count].arrival;
  const auto is_too_old = [&](const auto& waiting) { return waiting.arrival < first_to_stay; };
  rejectIf(topic, other, is_too_old,
           topic.reason + std::string(" before newer ones held more than max_waiting_memory"),
           stampsOf(other.waiting));
}

std::size_t ScanPairer::waitingBytes() const {
  return bytesOfAll(images_.waiting) + bytesOfAll(infos_.waiting);
}

template <typename Message, typename Other>
void ScanPairer::add(const Message& message, ros::SteadyTime now, Topic<Message>& topic,
                     Topic<Other>& other) {
  const ros::Time stamp = message->header.stamp;
  const std::uint64_t arrival = ++topic.arrivals;
  if (!stamp.isZero()) {
    const bool goes_back = stamp < topic.last_stamp;
    topic.last_stamp = stamp;
    if (goes_back) {
      topic.anew = arrival;
      went_back_ = true;
      went_back_at_ = now;
      if (!several_publishers_) ++round_;
    }
  }
  const auto given_up = topic.given_up.find(stamp);
  if (given_up != topic.given_up.end() && given_up->second.arrival < topic.anew)
    topic.given_up.erase(given_up);
  if (!several_publishers_) {
    const auto is_from_before = [&](const auto& waiting) {
      return waiting.arrival < topic.anew && bears(stamp)(waiting) && !stamp.isZero();
    };
    rejectIf(topic, other, is_from_before,
             topic.reason + std::string(" before the stamps began anew"), {});
  }

  Bearers& bearers = bearersOf(stamp, now);
  count(message, bearers);
  topic.waiting.push_back({message, now, arrival});
  if (bearers.differ) {
    repeats_ = repeats_ || !stamp.isZero();
    repeated_at_ = now;
    rejectAllOf(stamp);
    return;
  }
  const std::size_t infos = countOf(infos_.waiting, stamp);
  if (infos > 0 && infos == countOf(images_.waiting, stamp)) {
    const bool is_alone = bearers.images <= 1 && bearers.infos <= 1 && !stamp.isZero() && !repeats_;
    pairAllBut(is_alone ? 0 : 1, stamp);
  } else {
    makeRoom(topic, other);
  }
}

void ScanPairer::pair(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info) {
  if (!several_publishers_ && !went_back_ && !image->header.stamp.isZero()) {
    // Whatever waits alone came since stamps went back last, so that the older one came before.
    const std::vector<ros::Time> images = stampsOf(images_.waiting);
    const std::vector<ros::Time> infos = stampsOf(infos_.waiting);
    const auto is_older_than_all_of = [&image](const std::vector<ros::Time>& partners) {
      return [&image, &partners](const auto& waiting) {
        const ros::Time& stamp = waiting.message->header.stamp;
        return !stamp.isZero() && stamp < image->header.stamp &&
               std::find(partners.begin(), partners.end(), stamp) == partners.end();
      };
    };
    const std::string when = " before a newer pair";
    rejectIf(images_, infos_, is_older_than_all_of(infos), images_.reason + when, infos);
    rejectIf(infos_, images_, is_older_than_all_of(images), infos_.reason + when, images);
  }
  accept_(image, info);
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
  const auto partner =
      std::find_if(other.waiting.begin(), other.waiting.end(), bears(header.stamp));
  const auto counted = other.given_up.find(header.stamp);
  if (partner != other.waiting.end()) {
    other.waiting.erase(partner);
  } else if (counted != other.given_up.end()) {
    if (--counted->second.count == 0) other.given_up.erase(counted);
    return;
  } else if (!header.stamp.isZero()) {  // else it may be that nothing of the header is known
    GivenUp& given_up = topic.given_up[header.stamp];
    ++given_up.count;
    given_up.arrival = ++topic.arrivals;
    forgetOldest(topic.given_up);
  }
  reject_(header, reason);
}

void ScanPairer::refuseImage(const std_msgs::Header& header, const std::string& reason) {
  refuse(header, reason, images_, infos_);
}

void ScanPairer::refuseInfo(const std_msgs::Header& header, const std::string& reason) {
  refuse(header, reason, infos_, images_);
}

template <typename Message>
bool ScanPairer::isLate(const Waiting<Message>& waiting, ros::SteadyTime now) const {
  return now - waiting.since > timeout_ && waiting.looks >= kFewestLooks;
}

/// Those of a stamp that have waited for what comes after them, of both kinds: pairs once nothing
/// has come, as many of one kind as of the other.
void ScanPairer::settleLate(ros::SteadyTime now) {
  std::vector<ros::Time> stamps;
  const auto look = [&](auto& topic) {
    for (auto& waiting : topic.waiting) {
      ++waiting.looks;
      if (isLate(waiting, now)) stamps.push_back(waiting.message->header.stamp);
    }
  };
  look(images_);
  look(infos_);
  for (const ros::Time& stamp : stamps) {
    const std::size_t images = countOf(images_.waiting, stamp);
    const std::size_t infos = countOf(infos_.waiting, stamp);
    if (images == 0 || infos == 0) continue;
    const auto comes = [&](const auto& waiting) {
      return bears(stamp)(waiting) && !isLate(waiting, now);
    };
    if (images != infos) {
      rejectAllOf(stamp);
    } else if (std::none_of(images_.waiting.begin(), images_.waiting.end(), comes) &&
               std::none_of(infos_.waiting.begin(), infos_.waiting.end(), comes)) {
      pairAllBut(0, stamp);
    }
  }
}

void ScanPairer::expire(ros::SteadyTime now) {
  settleLate(now);
  const std::string after = " within " + numberText(timeout_.toSec()) + " s";
  const std::vector<ros::Time> images = stampsOf(images_.waiting);
  const std::vector<ros::Time> infos = stampsOf(infos_.waiting);
  const auto is_late_without = [&](const std::vector<ros::Time>& partners) {
    return [&](const auto& waiting) {
      return isLate(waiting, now) && std::find(partners.begin(), partners.end(),
                                               waiting.message->header.stamp) == partners.end();
    };
  };
  rejectIf(images_, infos_, is_late_without(infos), images_.reason + after, infos);
  rejectIf(infos_, images_, is_late_without(images), infos_.reason + after, images);

  const ros::WallDuration settling = timeout_ * kSettling;
  for (auto bearers = bearers_.begin(); bearers != bearers_.end();) {
    const bool is_over = now - bearers->second.last > settling;
    if (is_over) end(bearers->first, bearers->second);
    bearers = is_over ? bearers_.erase(bearers) : std::next(bearers);
  }
  went_back_ = went_back_ && now - went_back_at_ <= settling;
  repeats_ = repeats_ && now - repeated_at_ <= settling;
}

}  // namespace mems_stiction
