#pragma once

/// @file
/// The half-space's answer as pictures for a screen; bgr8, of a size that does not depend on the
/// scan. For looking at, not for measuring. Along the lower edge stands what the solution says of
/// where it comes from.

#include <sensor_msgs/Image.h>
#include <opencv2/core.hpp>

#include "mems_stiction/HalfSpaceSolution.h"
#include "ros/curve_drawing.hpp"

namespace mems_stiction {

/// Force over height: approach and retraction, with axes, the pull-off marked and the figures
/// above; without a curve the sentence that says why.
/// - @p beside the prediction's, laid under it; may have no point
sensor_msgs::ImagePtr curvePicture(const HalfSpaceSolution& solution,
                                   const DrawnCurve& beside = {});

/// Both contact maps of one scan side by side, in the colours of the regimes.
/// - @p model_map, @p half_space_map CV_8UC1 with the values of Regime, or empty
/// - @p solution of that scan
sensor_msgs::ImagePtr contactMapsPicture(const cv::Mat& model_map, const cv::Mat& half_space_map,
                                         const HalfSpaceSolution& solution);

}  // namespace mems_stiction
