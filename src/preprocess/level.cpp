#include "mems_stiction/preprocess/level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "mems_stiction/base/errors.hpp"

namespace mems_stiction {
namespace {

template <typename Scalar, typename Visit>
void forEachValid(const cv::Mat& heights, Visit visit) {
  for (int row = 0; row < heights.rows; ++row) {
    const Scalar* line = heights.ptr<Scalar>(row);
    for (int col = 0; col < heights.cols; ++col) {
      const double height = line[col];
      if (std::isfinite(height)) visit(row, col, height);
    }
  }
}

template <typename Scalar>
Plane planeOf(const HeightMap& surface) {
  const cv::Mat& heights = surface.heights();
  long long count = 0;
  double origin = 0.0;
  double sum_row = 0.0;
  double sum_col = 0.0;
  double sum_height = 0.0;
  forEachValid<Scalar>(heights, [&](int row, int col, double height) {
    if (count++ == 0) origin = height;
    sum_row += row;
    sum_col += col;
    sum_height += height - origin;
  });
  if (count == 0) throw SurfaceError("the height map has no valid pixel to level by");
  const double mean_row = sum_row / static_cast<double>(count);
  const double mean_col = sum_col / static_cast<double>(count);
  const double mean_height = sum_height / static_cast<double>(count);

  // About the centroid the three normal equations part into the mean and two for the slopes. Lengths are in units of
  // the frame's longer side.
  const double unit = std::max(heights.cols * surface.pitchX(), heights.rows * surface.pitchY());
  const double step_x = surface.pitchX() / unit;
  const double step_y = surface.pitchY() / unit;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  forEachValid<Scalar>(heights, [&](int row, int col, double height) {
    const Eigen::Vector2d position((col - mean_col) * step_x, (row - mean_row) * step_y);
    normal += position * position.transpose();
    moment += position * ((height - origin) - mean_height);
  });

  // Rank-revealing: pixels on one line leave the slope across it at its least norm, 0. Eigenvalues of a line are zero
  // to about 1e-15 of the largest; two full neighboring rows of 10^5 pixels still have 1e-9.
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix2d> decomposition;
  decomposition.setThreshold(1e-12);
  decomposition.compute(normal);
  const Eigen::Vector2d slope = decomposition.solve(moment) / unit;

  Plane plane;
  plane.mean_height = origin + mean_height;
  plane.slope_x = slope.x();
  plane.slope_y = slope.y();
  plane.center_x = mean_col * surface.pitchX();
  plane.center_y = mean_row * surface.pitchY();
  return plane;
}

template <typename Scalar>
HeightMap levelledBy(const Plane& plane, const HeightMap& surface) {
  const cv::Mat& heights = surface.heights();
  cv::Mat result(heights.size(), CV_64FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  forEachValid<Scalar>(heights, [&](int row, int col, double height) {
    const double tilt = plane.slope_x * (col * surface.pitchX() - plane.center_x) +
                        plane.slope_y * (row * surface.pitchY() - plane.center_y);
    result.at<double>(row, col) = (height - plane.mean_height) - tilt;
  });
  return {result, surface.pitchX(), surface.pitchY()};
}

bool isSingle(const HeightMap& surface) { return surface.heights().depth() == CV_32F; }

}  // namespace

Plane leastSquaresPlane(const HeightMap& surface) {
  return isSingle(surface) ? planeOf<float>(surface) : planeOf<double>(surface);
}

HeightMap levelled(const HeightMap& surface) {
  const Plane plane = leastSquaresPlane(surface);
  return isSingle(surface) ? levelledBy<float>(plane, surface) : levelledBy<double>(plane, surface);
}

}  // namespace mems_stiction
