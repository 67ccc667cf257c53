#pragma once

/// @file
/// The force that a prediction has followed, as a picture for a screen; bgr8, of the size of the
/// half-space's.

#include <sensor_msgs/Image.h>
#include <std_msgs/Header.h>

#include "ros/curve_drawing.hpp"
#include "ros/predicted_scan.hpp"

namespace mems_stiction {

/// Named by its formulation, with the pull-off force at the highest point of the unloading branch;
/// no point where the formulation does not follow the force.
DrawnCurve drawnCurve(const PredictedScan& scan);

/// Force over height, with the figures above and what the flags name; without a curve the sentence
/// that says why.
sensor_msgs::ImagePtr forceCurvePicture(const PredictedScan& scan, const std_msgs::Header& header);

}  // namespace mems_stiction
