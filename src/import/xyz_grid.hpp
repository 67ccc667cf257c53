#pragma once

/// @file
/// Lists of points that lie on a regular grid.

#include <opencv2/core.hpp>

namespace mems_stiction {

/// Heights of a list on its grid.
struct XyzGrid {
  cv::Mat heights;  ///< rows x cols CV_64FC1; columns grow with x, rows with y; NaN without a point
  double pitch_x = 0.0, pitch_y = 0.0;  ///< in the unit of x and y
};

/// - @p points one row for each point, CV_64FC1 with the columns x, y and z, in any order of rows
/// @throw FileError without a file name if the points are on no regular grid or two are in one
/// place.
XyzGrid gridOfPoints(const cv::Mat& points);

/// True if each number of the column stands there twice on average, as the coordinates of a grid
/// do.
bool mayBeAxis(const cv::Mat& column);

/// True if these columns are x and y of a regular grid of two rows and columns or more, with a
/// point in each place. Of many points some may be missing.
bool areOnGrid(const cv::Mat& x, const cv::Mat& y);

/// True if the list begins with the largest y and the smallest x: an image of an upward y, written
/// from its top. A list that begins with the largest x was turned over, and says nothing.
bool runsFromTheTop(const cv::Mat& points);

}  // namespace mems_stiction
