#pragma once

/// What goes out for a predicted scan, and what somebody listens to: nothing else is computed or published.

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/ros/image_conversion.hpp"
#include "mems_stiction/ros/parameters.hpp"

namespace mems_stiction {

class ResultPublisher {
 public:
  ResultPublisher(const ros::NodeHandle& handle, const DisplayOptions& display);

  /// What the subscribers of this moment need.
  OutputOptions demanded() const;

  /// Publishes the prediction, and of the rest what `prediction` holds and somebody listens to.
  void publish(const Prediction& prediction, const ReceivedScan& scan) const;

 private:
  DisplayOptions display_;
  image_transport::ImageTransport transport_;
  ros::Publisher prediction_;
  image_transport::Publisher deformed_height_;
  image_transport::Publisher deformed_counter_height_;
  image_transport::Publisher contact_map_;
  ros::Publisher asperities_;
  ros::Publisher surface_points_;
  ros::Publisher asperity_markers_;
};

}  // namespace mems_stiction
