#pragma once

/// @file
/// What goes out for a scan that the half-space has solved: the message always, maps and pictures while somebody listens.

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>
#include <opencv2/core.hpp>

#include "mems_stiction/HalfSpaceSolution.h"
#include "ros/curve_drawing.hpp"

namespace mems_stiction {

/// The topics of the half-space.
class HalfSpacePublisher {
 public:
  explicit HalfSpacePublisher(const ros::NodeHandle& handle);

  /// Whether somebody wants to see the model's contact map beside that of the half-space.
  bool areBothMapsWanted() const;

  /// - @p model_map, @p half_space_map contact maps of the scan; empty: not known
  /// - @p model_curve of the prediction; no point: not known
  void publish(const HalfSpaceSolution& solution, const cv::Mat& model_map, const cv::Mat& half_space_map,
               const DrawnCurve& model_curve) const;

 private:
  image_transport::ImageTransport transport_;
  ros::Publisher solution_;
  image_transport::Publisher contact_map_;
  ros::Publisher contact_maps_;
  ros::Publisher curve_;
};

}  // namespace mems_stiction
