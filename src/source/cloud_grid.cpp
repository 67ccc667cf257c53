#include "source/cloud_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "errors/short_number.hpp"
#include "import/file_bytes.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A pitch that is stated and differs by less is the grid's own.
constexpr double kSamePitch = 0.01;

/// Share of the distances between neighbours that the pitch of an uneven grid exceeds: fewer cells
/// than the rest stay empty.
constexpr double kCoveredShare = 0.95;

/// One coordinate over the index of a row or column: first + step x index.
struct Axis {
  double first = 0.0, step = 0.0, worst = 0.0;  ///< worst: largest distance of a point from it
};

/// Least squares over all measured points.
Axis fitAxis(const cv::Mat& points, int coordinate, bool is_over_rows) {
  double count = 0.0, sum_i = 0.0, sum_v = 0.0, sum_ii = 0.0, sum_iv = 0.0;
  const auto each = [&](auto&& function) {
    for (int row = 0; row < points.rows; ++row) {
      const auto* point = points.ptr<cv::Vec3d>(row);
      for (int col = 0; col < points.cols; ++col) {
        if (!std::isnan(point[col][2])) function(is_over_rows ? row : col, point[col][coordinate]);
      }
    }
  };
  each([&](double index, double value) {
    count += 1.0;
    sum_i += index;
    sum_v += value;
  });
  const double mean_i = sum_i / count, mean_v = sum_v / count;
  each([&](double index, double value) {
    sum_ii += (index - mean_i) * (index - mean_i);
    sum_iv += (index - mean_i) * (value - mean_v);
  });
  Axis axis;
  axis.step = sum_ii > 0.0 ? sum_iv / sum_ii : 0.0;
  axis.first = mean_v - axis.step * mean_i;
  each([&](double index, double value) {
    axis.worst = std::max(axis.worst, std::abs(value - axis.first - axis.step * index));
  });
  return axis;
}

struct Grid {
  Axis x, y;
  bool is_transposed;  ///< x changes from row to row
};

/// The grid that the points lie on; nothing if they lie on none within the tolerance.
std::optional<Grid> evenGrid(const cv::Mat& points, double tolerance) {
  if (points.rows < 2 || points.cols < 2) return std::nullopt;
  for (const bool is_transposed : {false, true}) {
    const Grid grid = {fitAxis(points, 0, is_transposed), fitAxis(points, 1, !is_transposed),
                       is_transposed};
    const bool is_even = grid.x.step != 0.0 && grid.y.step != 0.0 &&
                         grid.x.worst <= tolerance * std::abs(grid.x.step) &&
                         grid.y.worst <= tolerance * std::abs(grid.y.step);
    if (is_even) return grid;
  }
  return std::nullopt;
}

HeightMap mapOnOwnGrid(const cv::Mat& points, const Grid& grid) {
  cv::Mat heights;
  cv::extractChannel(points, heights, 2);
  if (grid.is_transposed) cv::transpose(heights, heights);
  if (grid.x.step < 0.0) cv::flip(heights, heights, 1);
  if (grid.y.step > 0.0) cv::flip(heights, heights, 0);
  return {heights, std::abs(grid.x.step), std::abs(grid.y.step)};
}

/// Distances of measured neighbours along one coordinate, of both directions of the order: a cell
/// of this size has a point of the lattice wherever it lies, however the lattice is turned.
double coveringPitch(const cv::Mat& points, int coordinate) {
  std::vector<double> along_rows, along_cols;
  for (int row = 0; row < points.rows; ++row) {
    for (int col = 0; col < points.cols; ++col) {
      const cv::Vec3d& one = points.at<cv::Vec3d>(row, col);
      const auto add = [&](const cv::Vec3d& other, std::vector<double>& distances) {
        if (!std::isnan(one[2]) && !std::isnan(other[2])) {
          distances.push_back(std::abs(one[coordinate] - other[coordinate]));
        }
      };
      if (col + 1 < points.cols) add(points.at<cv::Vec3d>(row, col + 1), along_cols);
      if (row + 1 < points.rows) add(points.at<cv::Vec3d>(row + 1, col), along_rows);
    }
  }
  double both = 0.0;
  for (std::vector<double>* distances : {&along_rows, &along_cols}) {
    if (distances->empty()) continue;
    const auto place =
        distances->begin() + static_cast<std::ptrdiff_t>(kCoveredShare * (distances->size() - 1));
    std::nth_element(distances->begin(), place, distances->end());
    both += *place;
  }
  return both;
}

/// The plane z = a + b x + c y nearest to the points, about their middle.
struct MeanPlane {
  cv::Vec3d middle, slope;  ///< slope: b, c, and a at the middle
  double at(double x, double y) const {
    return slope[2] + slope[0] * (x - middle[0]) + slope[1] * (y - middle[1]);
  }
};

MeanPlane meanPlane(const std::vector<cv::Vec3d>& points) {
  MeanPlane plane;
  for (const cv::Vec3d& point : points) plane.middle += point;
  plane.middle /= static_cast<double>(points.size());
  cv::Matx22d products = cv::Matx22d::zeros();
  cv::Vec2d right(0.0, 0.0);
  for (const cv::Vec3d& point : points) {
    const cv::Vec3d from = point - plane.middle;
    products +=
        cv::Matx22d(from[0] * from[0], from[0] * from[1], from[0] * from[1], from[1] * from[1]);
    right += cv::Vec2d(from[0] * from[2], from[1] * from[2]);
  }
  cv::Vec2d slopes(0.0, 0.0);
  cv::solve(products, right, slopes, cv::DECOMP_SVD);
  plane.slope = {slopes[0], slopes[1], plane.middle[2]};
  return plane;
}

std::vector<cv::Vec3d> measuredPoints(const cv::Mat& points) {
  std::vector<cv::Vec3d> measured;
  for (int row = 0; row < points.rows; ++row) {
    const auto* point = points.ptr<cv::Vec3d>(row);
    std::copy_if(point, point + points.cols, std::back_inserter(measured),
                 [](const cv::Vec3d& one) { return !std::isnan(one[2]); });
  }
  return measured;
}

std::string metres(double value) { return shortNumber(value) + " m"; }

CloudMap mapOnNewGrid(const cv::Mat& points, double pitch_x, double pitch_y) {
  const std::vector<cv::Vec3d> measured = measuredPoints(points);
  const auto [left, right] =
      std::minmax_element(measured.begin(), measured.end(),
                          [](const auto& one, const auto& other) { return one[0] < other[0]; });
  const auto [bottom, top] =
      std::minmax_element(measured.begin(), measured.end(),
                          [](const auto& one, const auto& other) { return one[1] < other[1]; });
  const double first_x = (*left)[0], last_y = (*top)[1];
  const double cols = std::floor(((*right)[0] - first_x) / pitch_x + 0.5) + 1.0;
  const double rows = std::floor((last_y - (*bottom)[1]) / pitch_y + 0.5) + 1.0;
  if (!(cols * rows <= static_cast<double>(kMaxPixels)) || cols < 2.0 || rows < 2.0) {
    throw SurfaceError("points over " + metres((*right)[0] - first_x) + " x " +
                       metres(last_y - (*bottom)[1]) + " make no map with a pitch of " +
                       metres(pitch_x) + " x " + metres(pitch_y));
  }
  const MeanPlane plane = meanPlane(measured);
  const cv::Size size(static_cast<int>(cols), static_cast<int>(rows));
  cv::Mat sums = cv::Mat::zeros(size, CV_64FC1), counts = cv::Mat::zeros(size, CV_64FC1);
  for (const cv::Vec3d& point : measured) {
    const int col = static_cast<int>(std::floor((point[0] - first_x) / pitch_x + 0.5));
    const int row = static_cast<int>(std::floor((last_y - point[1]) / pitch_y + 0.5));
    sums.at<double>(row, col) += point[2] - plane.at(point[0], point[1]);
    counts.at<double>(row, col) += 1.0;
  }
  cv::Mat heights = sums / counts;
  for (int row = 0; row < size.height; ++row) {
    auto* height = heights.ptr<double>(row);
    const auto* count = counts.ptr<double>(row);
    for (int col = 0; col < size.width; ++col) {
      height[col] = count[col] > 0.0
                        ? height[col] + plane.at(first_x + col * pitch_x, last_y - row * pitch_y)
                        : kNan;
    }
  }
  double most = 0.0;
  cv::minMaxLoc(counts, nullptr, &most);
  const int filled = cv::countNonZero(counts);
  const std::string note =
      "put on a grid of " + std::to_string(size.width) + " x " + std::to_string(size.height) +
      " cells of " + metres(pitch_x) + " x " + metres(pitch_y) + ": " + std::to_string(filled) +
      " hold " + shortNumber(static_cast<double>(measured.size()) / filled) +
      " points in the mean, at most " + shortNumber(most) + "; the others are not measured";
  return {HeightMap(heights, pitch_x, pitch_y), {note}};
}

bool isOther(double stated, double own) {
  return stated > 0.0 && std::abs(stated - own) > kSamePitch * own;
}

double neededPitch(const char* key, double stated, const cv::Mat& points, int coordinate) {
  if (stated > 0.0) return stated;
  const bool has_order = points.rows > 1 && points.cols > 1;
  const double own = has_order ? coveringPitch(points, coordinate) : 0.0;
  if (own > 0.0) return own;
  throw SurfaceError(std::string(has_order ? "the points that are measured lie in one line"
                                           : "the cloud has no order of rows and columns") +
                     ", from which no pitch follows: state " + key);
}

}  // namespace

void dropUnmeasured(cv::Mat& points, const CloudOptions& options) {
  for (int row = 0; row < points.rows; ++row) {
    auto* point = points.ptr<cv::Vec3d>(row);
    for (int col = 0; col < points.cols; ++col) {
      const cv::Vec3d& one = point[col];
      const bool is_measured = std::isfinite(one[0]) && std::isfinite(one[1]) &&
                               one[2] >= options.invalid_below && one[2] <= options.invalid_above;
      if (!is_measured) point[col][2] = kNan;
    }
  }
}

cv::Vec3d axisSigns(const CloudOptions& options) {
  const bool turns_y =
      options.mirror == Mirror::kY || (options.mirror == Mirror::kAuto && options.is_up_negative);
  return {options.mirror == Mirror::kX ? -1.0 : 1.0, turns_y ? -1.0 : 1.0,
          options.is_up_negative ? -1.0 : 1.0};
}

CloudMap mapOfPoints(const cv::Mat& stated, const CloudOptions& options) {
  cv::Mat points = stated.clone();
  const cv::Vec3d signs = axisSigns(options);
  if (signs != cv::Vec3d::all(1.0)) cv::multiply(points, cv::Scalar(signs), points);
  if (measuredPoints(points).empty()) {
    throw SurfaceError("none of the " + std::to_string(points.total()) + " points is measured");
  }
  const std::optional<Grid> grid = evenGrid(points, options.grid_tolerance);
  if (grid && !isOther(options.pitch_x, std::abs(grid->x.step)) &&
      !isOther(options.pitch_y, std::abs(grid->y.step))) {
    return {mapOnOwnGrid(points, *grid), {}};
  }
  return mapOnNewGrid(points, neededPitch("pitch_x", options.pitch_x, points, 0),
                      neededPitch("pitch_y", options.pitch_y, points, 1));
}

}  // namespace mems_stiction
