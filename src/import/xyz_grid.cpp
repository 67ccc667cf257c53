#include "import/xyz_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "import/file_bytes.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr double kAside = 0.1;        // of a step: printed coordinates are rounded
constexpr int kManyPoints = 10;       // fewer are on a grid with gaps by chance
constexpr double kLeastFilled = 0.5;  // a list that fills less is no scan of a rectangle

/// Places along one axis.
struct Axis {
  double first = 0.0;
  double step = 0.0;
  int count = 0;

  /// @return the place, or -1 if the coordinate lies between places
  int place(double coordinate) const {
    const double at = (coordinate - first) / step;
    const double nearest = std::round(at);
    return std::abs(at - nearest) <= kAside ? static_cast<int>(nearest) : -1;
  }
};

Axis axisOf(const cv::Mat& points, int column, const char* name) {
  std::vector<double> sorted(static_cast<std::size_t>(points.rows));
  for (int row = 0; row < points.rows; ++row)
    sorted[static_cast<std::size_t>(row)] = points.at<double>(row, column);
  if (std::any_of(sorted.begin(), sorted.end(),
                  [](double value) { return !std::isfinite(value); })) {
    throw FileError(std::string("a point without ") + name);
  }
  std::sort(sorted.begin(), sorted.end());
  const double range = sorted.back() - sorted.front();
  // Coordinates of one column differ by rounding alone; a scan has less than 100 000 columns.
  const double rounding = 1e-6 * range;
  std::vector<double> steps;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i] - sorted[i - 1] > rounding) steps.push_back(sorted[i] - sorted[i - 1]);
  }
  if (steps.empty())
    throw FileError(std::string("all points have the same ") + name + ": a profile, not a surface");
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                   steps.end());
  Axis axis;
  axis.first = sorted.front();
  const double intervals = std::round(range / steps[steps.size() / 2]);
  checkPixelCount(static_cast<std::uint64_t>(std::min(intervals, 1e9)) + 1, 1);
  axis.step = range / intervals;
  axis.count = static_cast<int>(intervals) + 1;
  return axis;
}

}  // namespace

XyzGrid gridOfPoints(const cv::Mat& points) {
  const Axis x = axisOf(points, 0, "x");
  const Axis y = axisOf(points, 1, "y");
  checkPixelCount(static_cast<std::uint64_t>(x.count), static_cast<std::uint64_t>(y.count));
  const std::string size = std::to_string(x.count) + " x " + std::to_string(y.count);
  if (points.rows < kLeastFilled * x.count * y.count) {
    throw FileError("the " + std::to_string(points.rows) +
                    " points are on no regular grid of x and y (" + size + " places)");
  }
  XyzGrid grid;
  grid.pitch_x = x.step;
  grid.pitch_y = y.step;
  grid.heights =
      cv::Mat(y.count, x.count, CV_64FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  cv::Mat taken = cv::Mat::zeros(y.count, x.count, CV_8UC1);
  for (int i = 0; i < points.rows; ++i) {
    const double* point = points.ptr<double>(i);
    const int col = x.place(point[0]);
    const int row = y.place(point[1]);
    if (col < 0 || row < 0 || col >= x.count || row >= y.count) {
      throw FileError("point " + std::to_string(i + 1) +
                      " is not on the regular grid of the others (" + size + ")");
    }
    if (taken.at<unsigned char>(row, col)++ != 0) {
      throw FileError("point " + std::to_string(i + 1) + " has the x and y of another one");
    }
    grid.heights.at<double>(row, col) = point[2];
  }
  return grid;
}

bool mayBeAxis(const cv::Mat& column) {
  if (!cv::checkRange(column)) return false;
  cv::Mat sorted;
  cv::sort(column, sorted, cv::SORT_EVERY_COLUMN | cv::SORT_ASCENDING);
  const auto* begin = sorted.ptr<double>(0);
  auto* end = std::unique(sorted.ptr<double>(0), sorted.ptr<double>(0) + sorted.rows);
  return 2 * (end - begin) <= column.rows;
}

bool areOnGrid(const cv::Mat& x, const cv::Mat& y) {
  cv::Mat points;
  cv::hconcat(std::vector<cv::Mat>{x, y, y}, points);
  try {
    const std::size_t places = gridOfPoints(points).heights.total();
    return points.rows >= kManyPoints || places == static_cast<std::size_t>(points.rows);
  } catch (const FileError&) {
    return false;
  }
}

bool runsFromTheTop(const cv::Mat& points) {
  const auto sign_of_first_step = [&points](int column) {
    for (int i = 1; i < points.rows; ++i) {
      const double step = points.at<double>(i, column) - points.at<double>(i - 1, column);
      if (step != 0.0) return step;
    }
    return 0.0;
  };
  return sign_of_first_step(0) > 0.0 && sign_of_first_step(1) < 0.0;
}

}  // namespace mems_stiction
