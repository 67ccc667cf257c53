#include "mems_stiction/ros/scan_pairer.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "mems_stiction/base/option_visitor.hpp"

namespace mems_stiction {
namespace {

constexpr char kLoneImage[] = "no scan_info with the stamp of the scan came";
constexpr double kNear = 1.0;  // between stamps that may have been meant to be one [s]
constexpr char kLoneInfo[] = "no scan with the stamp of the scan_info came";

/// Takes the first of those that wait with this stamp.
template <typename Queue>
auto takeStamped(Queue& queue, const ros::Time& stamp) -> decltype(queue.front().message) {
  const auto found = std::find_if(queue.begin(), queue.end(),
                                  [&](const auto& waiting) { return waiting.message->header.stamp == stamp; });
  if (found == queue.end()) return nullptr;
  auto message = found->message;
  queue.erase(found);
  return message;
}

template <typename Queue>
std::vector<ros::Time> stampsOf(const Queue& queue) {
  std::vector<ros::Time> stamps;
  for (const auto& waiting : queue) stamps.push_back(waiting.message->header.stamp);
  return stamps;
}

/// "; one came with the stamp 12.000001000, 1e-06 s later": two clocks, or a stamp that was rounded. Empty if none is near.
std::string nearestOf(const std::vector<ros::Time>& stamps, const ros::Time& stamp) {
  const auto distance = [&](const ros::Time& other) { return std::abs((other - stamp).toSec()); };
  const auto nearest = std::min_element(
      stamps.begin(), stamps.end(), [&](const ros::Time& a, const ros::Time& b) { return distance(a) < distance(b); });
  if (nearest == stamps.end() || distance(*nearest) > kNear || *nearest == stamp) return "";
  std::ostringstream text;
  text << "; one came with the stamp " << *nearest << ", " << distance(*nearest) << " s "
       << (*nearest > stamp ? "later" : "earlier");
  return text.str();
}

/// Rejects those that `is_lone` picks, in the order of arrival.
/// @param partners stamps of the other topic's
template <typename Queue, typename Predicate>
void rejectIf(Queue& queue, const Predicate& is_lone, const std::string& reason, const std::vector<ros::Time>& partners,
              const ScanPairer::Reject& reject) {
  for (auto waiting = queue.begin(); waiting != queue.end();) {
    if (is_lone(*waiting)) {
      reject(waiting->message->header, reason + nearestOf(partners, waiting->message->header.stamp));
      waiting = queue.erase(waiting);
    } else {
      ++waiting;
    }
  }
}

}  // namespace

ScanPairer::ScanPairer(ros::WallDuration timeout, Accept accept, Reject reject)
    : timeout_(timeout), accept_(std::move(accept)), reject_(std::move(reject)) {}

void ScanPairer::add(const sensor_msgs::ImageConstPtr& image, ros::WallTime now) {
  if (const ScanInfoConstPtr info = takeStamped(infos_, image->header.stamp)) {
    pair(image, info);
  } else {
    images_.push_back({image, now});
  }
}

void ScanPairer::add(const ScanInfoConstPtr& info, ros::WallTime now) {
  if (const sensor_msgs::ImageConstPtr image = takeStamped(images_, info->header.stamp)) {
    pair(image, info);
  } else {
    infos_.push_back({info, now});
  }
}

void ScanPairer::pair(const sensor_msgs::ImageConstPtr& image, const ScanInfoConstPtr& info) {
  // Each topic keeps its order, so the partner of anything older than this pair will not come any more.
  const ros::Time stamp = image->header.stamp;
  const auto is_older = [&](const auto& waiting) { return waiting.message->header.stamp < stamp; };
  const std::vector<ros::Time> images = stampsOf(images_);
  rejectIf(images_, is_older, std::string(kLoneImage) + " before a newer pair", stampsOf(infos_), reject_);
  rejectIf(infos_, is_older, std::string(kLoneInfo) + " before a newer pair", images, reject_);
  accept_(image, info);
}

void ScanPairer::expire(ros::WallTime now) {
  const auto is_late = [&](const auto& waiting) { return now - waiting.since > timeout_; };
  const std::string after = " within " + numberText(timeout_.toSec()) + " s";
  const std::vector<ros::Time> images = stampsOf(images_);
  rejectIf(images_, is_late, kLoneImage + after, stampsOf(infos_), reject_);
  rejectIf(infos_, is_late, kLoneInfo + after, images, reject_);
}

}  // namespace mems_stiction
