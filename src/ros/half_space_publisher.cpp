#include "ros/half_space_publisher.hpp"

#include <sensor_msgs/Image.h>

#include "ros/half_space_pictures.hpp"
#include "ros/image_conversion.hpp"
#include "ros/topic_names.hpp"

namespace mems_stiction {

HalfSpacePublisher::HalfSpacePublisher(const ros::NodeHandle& handle) : transport_(handle) {
  ros::NodeHandle node(handle);
  solution_ = node.advertise<HalfSpaceSolution>(kHalfSpaceTopic, kPredictionQueue);
  contact_map_ = transport_.advertise(kHalfSpaceContactMapTopic, kMapQueue);
  contact_maps_ = node.advertise<sensor_msgs::Image>(kContactMapsTopic, kDisplayQueue);
  curve_ = node.advertise<sensor_msgs::Image>(kHalfSpaceCurveTopic, kDisplayQueue);
}

bool HalfSpacePublisher::areBothMapsWanted() const { return contact_maps_.getNumSubscribers() > 0; }

void HalfSpacePublisher::publish(const HalfSpaceSolution& solution, const cv::Mat& model_map,
                                 const cv::Mat& half_space_map, const DrawnCurve& model_curve) const {
  if (!half_space_map.empty() && contact_map_.getNumSubscribers() > 0) {
    contact_map_.publish(contactMapImage(half_space_map, solution.header));
  }
  if (areBothMapsWanted()) {
    contact_maps_.publish(contactMapsPicture(model_map, half_space_map, solution));
  }
  if (curve_.getNumSubscribers() > 0) curve_.publish(curvePicture(solution, model_curve));
  // Last, so that whoever waits for the solution finds the maps sent.
  solution_.publish(solution);
}

}  // namespace mems_stiction
