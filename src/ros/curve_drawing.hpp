#pragma once

/// @file
/// Force over height in a picture, whichever solver followed it.

#include <limits>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "contact/curve_point.hpp"

namespace mems_stiction {

/// A curve with what is marked on it.
struct DrawnCurve {
  std::string name;  ///< written beside another curve; empty: not
  std::vector<CurvePoint> points;
  double pull_off_force = std::numeric_limits<double>::quiet_NaN();   ///< [N]; NaN: not marked
  double pull_off_height = std::numeric_limits<double>::quiet_NaN();  ///< [m]
};

/// Both ways of the curve with axes and a legend, and the pull-off marked.
/// - @p frame of the axes; their numbers and names are outside
/// - @p curve has a point
/// - @p beside laid under it as far as the axes reach, both ways in one colour; may have no point
void drawCurves(cv::Mat& picture, const cv::Rect& frame, const DrawnCurve& curve,
                const DrawnCurve& beside = {});

}  // namespace mems_stiction
