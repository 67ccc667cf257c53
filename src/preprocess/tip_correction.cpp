#include "preprocess/tip_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "height_map/validity.hpp"

namespace mems_stiction {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPixelsFromMiddle =
    2.0;  ///< contact points of one touch lie no further from their middle

/// One run of tip pixels side by side.
struct TipRow {
  int row = 0;                ///< from the axis
  int reach = 0;              ///< columns -reach .. reach
  std::vector<double> depth;  ///< 2 reach + 1 values [m]

  /// In the column so many from the axis, at most `reach`.
  double depthAt(int shift) const { return depth.data()[reach + shift]; }
};

/// The part of the tip that is less deep than `range`: no other part can touch. Symmetrical in both
/// axes.
std::vector<TipRow> sampledTip(const TipOptions& tip, const HeightMap& grid, double range) {
  std::vector<TipRow> rows;
  const auto depthAt = [&](int row, int col) {
    return tipDepth(tip, std::hypot(row * grid.pitchY(), col * grid.pitchX()));
  };
  int last_row = 0;
  while (last_row + 1 < grid.rows() && depthAt(last_row + 1, 0) <= range) ++last_row;
  for (int row = -last_row; row <= last_row; ++row) {
    TipRow tip_row;
    tip_row.row = row;
    while (tip_row.reach + 1 < grid.cols() && depthAt(row, tip_row.reach + 1) <= range)
      ++tip_row.reach;
    for (int col = -tip_row.reach; col <= tip_row.reach; ++col)
      tip_row.depth.push_back(depthAt(row, col));
    rows.push_back(std::move(tip_row));
  }
  return rows;
}

/// least(p) = min over x of heights(x) + depth(x - p). Infinite heights constrain nothing.
cv::Mat eroded(const cv::Mat& heights, const std::vector<TipRow>& tip) {
  cv::Mat least(heights.size(), CV_64FC1, cv::Scalar(kInfinity));
  cv::parallel_for_(cv::Range(0, heights.rows), [&](const cv::Range& rows) {
    for (int row = rows.start; row < rows.end; ++row) {
      double* result = least.ptr<double>(row);
      for (const TipRow& tip_row : tip) {
        if (row + tip_row.row < 0 || row + tip_row.row >= heights.rows) continue;
        const double* line = heights.ptr<double>(row + tip_row.row);
        for (int shift = -tip_row.reach; shift <= tip_row.reach; ++shift) {
          const double depth = tip_row.depthAt(shift);
          const int first = std::max(0, -shift);
          const int last = std::min(heights.cols, heights.cols - shift);
          for (int col = first; col < last; ++col) {
            const double bound = line[col + shift] + depth;
            result[col] = bound < result[col] ? bound : result[col];
          }
        }
      }
    }
  });
  return least;
}

/// The pixels that the tip all but touches at one position: their extent around the axis, in
/// pixels.
struct Touch {
  int min_row = std::numeric_limits<int>::max();
  int max_row = std::numeric_limits<int>::min();
  int min_col = std::numeric_limits<int>::max();
  int max_col = std::numeric_limits<int>::min();

  void add(int row, int col) {
    min_row = std::min(min_row, row);
    max_row = std::max(max_row, row);
    min_col = std::min(min_col, col);
    max_col = std::max(max_col, col);
  }
};

/// visit(col, shift) for each pixel (row + tip_row.row, col + shift) that the tip at (row, col) all
/// but touches.
template <typename Visit>
void forEachTouch(const cv::Mat& image, const cv::Mat& surface, const TipRow& tip_row, int row,
                  double tolerance, Visit visit) {
  const double* height = image.ptr<double>(row);
  const double* bound = surface.ptr<double>(row + tip_row.row);
  for (int shift = -tip_row.reach; shift <= tip_row.reach; ++shift) {
    const double depth = tip_row.depthAt(shift) - tolerance;
    const int last = std::min(image.cols, image.cols - shift);
    for (int col = std::max(0, -shift); col < last; ++col) {
      if (height[col] + depth <= bound[col + shift]) visit(col, shift);
    }
  }
}

/// @param image infinite where invalid
/// @param surface the eroded image, minus infinity where invalid
cv::Mat reachedPixels(const cv::Mat& image, const cv::Mat& surface, const std::vector<TipRow>& tip,
                      const HeightMap& grid, double tolerance) {
  const double pixel = std::max(grid.pitchX(), grid.pitchY());
  const double max_rows = 2.0 * kPixelsFromMiddle * pixel / grid.pitchY() + 1e-6;
  const double max_cols = 2.0 * kPixelsFromMiddle * pixel / grid.pitchX() + 1e-6;
  cv::Mat reached(image.size(), CV_8UC1, cv::Scalar(0));
  std::vector<Touch> touches(static_cast<std::size_t>(image.cols));
  for (int row = 0; row < image.rows; ++row) {
    std::fill(touches.begin(), touches.end(), Touch());
    for (const TipRow& tip_row : tip) {
      if (row + tip_row.row < 0 || row + tip_row.row >= image.rows) continue;
      forEachTouch(image, surface, tip_row, row, tolerance, [&](int col, int shift) {
        touches[static_cast<std::size_t>(col)].add(tip_row.row, shift);
      });
    }
    for (int col = 0; col < image.cols; ++col) {
      const Touch& touch = touches[static_cast<std::size_t>(col)];
      if (touch.min_row > touch.max_row || touch.max_row - touch.min_row > max_rows ||
          touch.max_col - touch.min_col > max_cols) {
        continue;
      }
      // Again over the few pixels of this touch.
      for (const TipRow& tip_row : tip) {
        if (tip_row.row < touch.min_row || tip_row.row > touch.max_row) continue;
        const double* bound = surface.ptr<double>(row + tip_row.row);
        const int first = std::max(touch.min_col, -tip_row.reach);
        for (int shift = first; shift <= std::min(touch.max_col, tip_row.reach); ++shift) {
          const double depth = tip_row.depthAt(shift) - tolerance;
          if (image.at<double>(row, col) + depth <= bound[col + shift]) {
            reached.at<uchar>(row + tip_row.row, col + shift) = 255;
          }
        }
      }
    }
  }
  return reached;
}

}  // namespace

void TipOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.number(prefix + "/radius", radius, "m", Range::nonNegative(),
                 "radius of the tip's end: the scan is eroded by the tip; 0 = off");
  visitor.number(
      prefix + "/half_angle", half_angle, "rad", Range::within(0.0, 1.55),
      "angle between the tip's axis and the flank of its cone; 0 = a sphere on a cylinder");
}

double tipDepth(const TipOptions& tip, double distance) {
  const double tangent_distance = tip.radius * std::cos(tip.half_angle);
  if (distance <= tangent_distance) {
    // R - sqrt(R^2 - r^2) without cancellation
    return distance * distance /
           (tip.radius +
            std::sqrt(std::max(0.0, (tip.radius - distance) * (tip.radius + distance))));
  }
  if (tip.half_angle == 0.0) return kInfinity;
  return tip.radius * (1.0 - std::sin(tip.half_angle)) +
         (distance - tangent_distance) / std::tan(tip.half_angle);
}

TipCorrection tipCorrected(const HeightMap& image, const TipOptions& tip) {
  const HeightStatistics statistics = heightStatistics(image);
  cv::Mat heights = ownedHeights(image);
  heights -= statistics.mean;
  const cv::Mat valid = validMask(heights);
  heights.setTo(kInfinity, ~valid);

  TipCorrection correction;
  if (tip.radius == 0.0) {
    correction.surface = HeightMap(ownedHeights(image), image.pitchX(), image.pitchY());
    correction.reached = valid;
    return correction;
  }
  const double range = statistics.max - statistics.min;
  cv::Mat surface = eroded(heights, sampledTip(tip, image, range));
  surface.setTo(-kInfinity, ~valid);
  double tolerance = tipDepth(tip, std::max(image.pitchX(), image.pitchY()));
  // A tip within one pixel touches at its apex only.
  if (!std::isfinite(tolerance)) tolerance = 0.0;
  // Bounds are compared with sums that are rounded: leave them a few digits.
  tolerance += 1e-12 * range;
  correction.reached =
      reachedPixels(heights, surface, sampledTip(tip, image, range + tolerance), image, tolerance);
  correction.unreached_fraction = 1.0 - static_cast<double>(cv::countNonZero(correction.reached)) /
                                            static_cast<double>(statistics.valid_count);
  surface += statistics.mean;
  surface.setTo(std::numeric_limits<double>::quiet_NaN(), ~valid);
  correction.surface = HeightMap(surface, image.pitchX(), image.pitchY());
  return correction;
}

HeightMap tipImaged(const HeightMap& surface, const TipOptions& tip) {
  const HeightStatistics statistics = heightStatistics(surface);
  cv::Mat heights = ownedHeights(surface);
  if (tip.radius == 0.0) return {heights, surface.pitchX(), surface.pitchY()};
  const cv::Mat valid = validMask(heights);
  heights -= statistics.mean;
  heights *= -1.0;  // dilation is the erosion of the surface turned over
  heights.setTo(kInfinity, ~valid);
  cv::Mat imaged = eroded(heights, sampledTip(tip, surface, statistics.max - statistics.min));
  imaged *= -1.0;
  imaged += statistics.mean;
  imaged.setTo(std::numeric_limits<double>::quiet_NaN(), ~valid);
  return {imaged, surface.pitchX(), surface.pitchY()};
}

}  // namespace mems_stiction
