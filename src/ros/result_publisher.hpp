#pragma once

/// @file
/// What goes out for a predicted scan: the prediction, and what somebody listens to. Nothing else
/// is computed.

#include <functional>

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include "ros/image_conversion.hpp"
#include "ros/parameters.hpp"
#include "ros/predicted_scan.hpp"

namespace mems_stiction {

/// Every topic that the node publishes, but the diagnostics.
class ResultPublisher {
 public:
  /// - @p preview_wanted called on the handle's queue when somebody starts to listen to the
  /// preview.
  ResultPublisher(const ros::NodeHandle& handle, const DisplayOptions& display,
                  std::function<void()> preview_wanted);

  /// What the subscribers of this moment need.
  OutputOptions demanded() const;

  /// Publishes the prediction, what its part's scans say, and of the rest what it has and somebody
  /// listens to.
  void publish(const PredictedScan& predicted, const ReceivedScan& scan) const;

  void publishPart(const PooledVerdict& part, const ScanOfPart& last) const;

  bool isPreviewWanted() const;
  void publishPreview(const HeightMap& surface, const std_msgs::Header& header) const;

 private:
  DisplayOptions display_;
  image_transport::ImageTransport transport_;
  ros::Publisher prediction_;
  ros::Publisher summary_;
  ros::Publisher part_verdict_;
  image_transport::Publisher deformed_height_;
  image_transport::Publisher deformed_counter_height_;
  image_transport::Publisher contact_map_;
  ros::Publisher asperities_;
  ros::Publisher surface_points_;
  ros::Publisher asperity_markers_;
  ros::Publisher preview_;
};

}  // namespace mems_stiction
