#include "source/scan_publisher.hpp"

#include <algorithm>
#include <limits>

#include <ros/single_subscriber_publisher.h>
#include <sensor_msgs/Image.h>
#include <boost/make_shared.hpp>

#include "mems_stiction/ScanInfo.h"
#include "numeric/words.hpp"
#include "ros/checked_messages.hpp"
#include "ros/image_conversion.hpp"
#include "ros/own_log.hpp"
#include "ros/topic_names.hpp"

namespace mems_stiction {
namespace {

/// roscpp drops the oldest message of a full queue and counts nothing; max_ahead bounds this one.
constexpr std::uint32_t kUnlimitedQueue = 0;

/// In which nodes find the topics of one that has come.
const ros::WallDuration kJoins(2.0);

std::vector<std::string> fullNames(const ros::NodeHandle& handle, const std::string& list) {
  std::vector<std::string> names = wordsOf(replaced(list, ",", " "));
  for (std::string& name : names) name = handle.resolveName(name);
  return names;
}

}  // namespace

ScanPublisher::ScanPublisher(ros::NodeHandle& handle, const SourceOptions& options)
    : max_ahead_(static_cast<std::size_t>(options.max_ahead)),
      answer_timeout_(options.answer_timeout),
      listener_(options.listener.empty() ? "" : handle.resolveName(options.listener)),
      audience_(fullNames(handle, options.audience)),
      audience_until_(ros::SteadyTime::now() + ros::WallDuration(options.audience_timeout)),
      has_audience_(!audience_.empty()),
      height_(advertise<sensor_msgs::Image>(handle, kHeightTopic, height_listeners_)),
      info_(advertise<ScanInfo>(handle, kScanInfoTopic, info_listeners_)) {
  if (max_ahead_ == 0) return;
  predictions_ = subscribeChecked<StictionPrediction>(
      handle, kPredictionTopic, kPredictionQueue,
      {[this](const StictionPredictionConstPtr& prediction) { takeAnswer(*prediction); },
       [](const auto&, const std::string& reason) {
         logSoon(ros::console::levels::Warn, "an answer of the node is passed over: " + reason);
       }});
}

template <typename Message>
ros::Publisher ScanPublisher::advertise(ros::NodeHandle& handle, const char* topic,
                                        std::multiset<std::string>& listeners) {
  const ros::SubscriberStatusCallback come =
      [this, &listeners](const ros::SingleSubscriberPublisher& one) {
        const std::lock_guard<std::mutex> lock(mutex_);
        listeners.insert(one.getSubscriberName());
        last_come_ = ros::SteadyTime::now();
      };
  const ros::SubscriberStatusCallback go = [this,
                                            &listeners](const ros::SingleSubscriberPublisher& one) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = listeners.find(one.getSubscriberName());
    if (found != listeners.end()) listeners.erase(found);
  };
  return handle.advertise<Message>(topic, kUnlimitedQueue, come, go);
}

bool ScanPublisher::isHeard() {
  if (listener_.empty()) return height_.getNumSubscribers() > 0 && info_.getNumSubscribers() > 0;
  const std::lock_guard<std::mutex> lock(mutex_);
  return height_listeners_.count(listener_) > 0 && info_listeners_.count(listener_) > 0;
}

std::string ScanPublisher::missingListener() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto missing =
      std::find_if(audience_.begin(), audience_.end(),
                   [this](const std::string& name) { return info_listeners_.count(name) == 0; });
  if (missing != audience_.end() && ros::SteadyTime::now() < audience_until_) return *missing;
  if (missing != audience_.end()) {
    logSoon(ros::console::levels::Warn,
            *missing + " does not listen to " + info_.getTopic() + ": scans go on without");
  }
  audience_.clear();  // who leaves later is not waited for
  return "";
}

void ScanPublisher::takeAnswer(const StictionPrediction& prediction) {
  const std::lock_guard<std::mutex> lock(mutex_);
  unanswered_.erase(prediction.header.stamp.toNSec());
}

std::string ScanPublisher::waitsFor() {
  if (!isHeard()) {
    return (listener_.empty() ? "nobody" : "no " + listener_) + " listens to " +
           height_.getTopic() + " and " + info_.getTopic() + ": scans wait";
  }
  const std::string missing = missingListener();
  if (!missing.empty())
    return missing + " does not listen to " + info_.getTopic() + " yet: scans wait";
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (has_audience_ && now - last_come_ < kJoins)
    return "a listener has just come: scans wait until others hear its answers";
  if (max_ahead_ == 0 || predictions_.getNumPublishers() == 0) return "";
  for (auto one = unanswered_.begin(); one != unanswered_.end();) {
    one = (now - one->second).toSec() > answer_timeout_ ? unanswered_.erase(one) : std::next(one);
  }
  return unanswered_.size() < max_ahead_
             ? ""
             : "the node has not answered " + std::to_string(unanswered_.size()) +
                   " scans yet: the next ones wait";
}

std::uint64_t ScanPublisher::freeStamp(std::uint64_t stamp) const {
  if (stamp == 0) ++stamp;  // the node takes 0 for no stamp
  while (stamps_.count(stamp) != 0) ++stamp;
  return stamp;
}

void ScanPublisher::publish(const HeightMap& surface, const ScanIdentity& identity,
                            const std::string& frame, std::uint64_t stamp) {
  std_msgs::Header header;
  header.seq = count_++;
  header.stamp.fromNSec(stamp);
  header.frame_id = frame;
  ScanOptions calibration;
  calibration.pitch_x = surface.pitchX();
  calibration.pitch_y = surface.pitchY();
  const auto info = boost::make_shared<ScanInfo>(scanInfoMessage(calibration, header));
  // Heights that are not measured are NaN: a value that the node's configuration states is of the
  // raw pixels.
  info->has_invalid_value = true;
  info->invalid_value = std::numeric_limits<double>::quiet_NaN();
  fillIdentity(identity, *info);
  stamps_.insert(stamp);
  if (max_ahead_ > 0) {
    const std::lock_guard<std::mutex> lock(mutex_);
    unanswered_[stamp] = ros::SteadyTime::now();
  }
  info_.publish(info);
  height_.publish(exactHeightImage(surface.heights(), header));
}

}  // namespace mems_stiction
