#include "ros/transform_listener.hpp"

#include <tf2/exceptions.h>

#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "ros/checked_messages.hpp"
#include "ros/own_log.hpp"

namespace mems_stiction {

TransformListener::TransformListener(const ros::NodeHandle& handle) : handle_(handle) {
  constexpr std::uint32_t kQueue = 100;
  const auto subscribe = [&](const std::string& topic, bool is_static) {
    return subscribeChecked<tf2_msgs::TFMessage>(
        handle_, topic, kQueue,
        {[this, is_static](const auto& message) { take(*message, is_static); },
         [topic](const auto&, const std::string& reason) {
           logSoon(ros::console::levels::Warn,
                   "a message of " + topic + " is passed over: " + reason);
         }});
  };
  moving_ = subscribe("/tf", false);
  static_ = subscribe("/tf_static", true);
}

/// As tf2_ros::TransformListener does, but one transform that tf2 cannot take leaves the others of
/// the message.
void TransformListener::take(const tf2_msgs::TFMessage& message, bool is_static) {
  const ros::Time now = ros::Time::now();
  if (now < last_update_) {
    logSoon(ros::console::levels::Warn,
            "the clock has jumped back: transforms from before are forgotten");
    buffer_.clear();
  }
  last_update_ = now;
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    try {
      buffer_.setTransform(transform, "a publisher of tf", is_static);
    } catch (const std::exception& error) {
      logSoon(ros::console::levels::Warn,
              oneLine("a transform to '" + shortened(transform.child_frame_id, kLongestQuotation) +
                      "' is passed over: " + error.what()));
    }
  }
}

geometry_msgs::Transform TransformListener::at(const std::string& target, const std::string& source,
                                               const ros::Time& stamp) const {
  try {
    return buffer_.lookupTransform(target, source, stamp).transform;
  } catch (const tf2::TransformException& error) {
    throw NoTransform(error.what());
  } catch (const std::runtime_error& error) {
    // ros::Time refuses differences beyond 2^31 s and sums beyond 2^32 s.
    PlainStream text;
    text << stamp << " s, which lies too far from those of the transforms: " << error.what();
    throw SurfaceError(text.str());
  }
}

}  // namespace mems_stiction
