#include "mems_stiction/preprocess/spike_removal.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/base/median.hpp"
#include "mems_stiction/height_map/validity.hpp"
#include "mems_stiction/preprocess/polynomial_level.hpp"

namespace mems_stiction {
namespace {

/// The heights with a margin all around in which the surface goes on by its reflection through the border pixels, which
/// keeps planes: windows at the border are as balanced as others.
cv::Mat withMargin(const cv::Mat& heights, int margin) {
  const int rows = std::min(margin, heights.rows - 1);
  const int cols = std::min(margin, heights.cols - 1);
  cv::Mat mirrored;
  cv::Mat border;
  cv::copyMakeBorder(heights, mirrored, 0, 0, cols, cols, cv::BORDER_REFLECT_101);
  cv::copyMakeBorder(heights, border, 0, 0, cols, cols, cv::BORDER_REPLICATE);
  cv::Mat wide = 2.0 * border - mirrored;
  heights.copyTo(wide(cv::Rect(cols, 0, heights.cols, heights.rows)));
  cv::copyMakeBorder(wide, mirrored, rows, rows, 0, 0, cv::BORDER_REFLECT_101);
  cv::copyMakeBorder(wide, border, rows, rows, 0, 0, cv::BORDER_REPLICATE);
  cv::Mat all = 2.0 * border - mirrored;
  wide.copyTo(all(cv::Rect(0, rows, wide.cols, wide.rows)));
  return all;
}

/// Height less the median of the valid heights in the window; NaN where invalid.
cv::Mat localResiduals(const cv::Mat& heights, int half) {
  const cv::Mat wide = withMargin(heights, half);
  const int margin_rows = (wide.rows - heights.rows) / 2;
  const int margin_cols = (wide.cols - heights.cols) / 2;
  cv::Mat residuals(heights.size(), CV_64FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  cv::parallel_for_(cv::Range(0, heights.rows), [&](const cv::Range& rows) {
    std::vector<double> window;
    for (int row = rows.start; row < rows.end; ++row) {
      for (int col = 0; col < heights.cols; ++col) {
        const double height = heights.at<double>(row, col);
        if (std::isnan(height)) continue;
        window.clear();
        for (int near_row = row - margin_rows; near_row <= row + margin_rows; ++near_row) {
          const double* line = wide.ptr<double>(near_row + margin_rows) + margin_cols;
          for (int near = col - margin_cols; near <= col + margin_cols; ++near) {
            if (!std::isnan(line[near])) window.push_back(line[near]);
          }
        }
        residuals.at<double>(row, col) = height - medianOf(window);
      }
    }
  });
  return residuals;
}

}  // namespace

void SpikeOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.flag(prefix + "/enabled", enabled, "make pixels that jump out of their surroundings invalid");
  visitor.number(prefix + "/threshold", threshold, "", Range::positive(),
                 "how far a spike lies from the median of its window, in robust standard deviations of that distance");
  visitor.integer(prefix + "/window", window, Range::within(3, 31), "side of the window, in pixels");
}

HeightMap withoutSpikes(const HeightMap& surface, const SpikeOptions& options) {
  const HeightMap flat = without(fitPolynomial(surface, 2, FitWeights::kRobust), surface);
  const cv::Mat residuals = localResiduals(flat.heights(), options.window / 2);

  std::vector<double> values;
  std::copy_if(residuals.begin<double>(), residuals.end<double>(), std::back_inserter(values),
               [](double residual) { return !std::isnan(residual); });
  const double center = medianOf(values);
  for (double& value : values) value = std::fabs(value - center);
  const HeightStatistics statistics = heightStatistics(surface);
  const double rounding =
      1e-9 * (statistics.max - statistics.min) + 1e-15 * std::max(std::fabs(statistics.max), std::fabs(statistics.min));
  double deviation = medianOf(values);
  if (deviation <= rounding) {
    values.erase(std::remove_if(values.begin(), values.end(), [=](double value) { return value <= rounding; }),
                 values.end());
    // Fewer than one pixel in 50 differs from a surface that is smooth to rounding: those are the spikes.
    deviation = values.size() > residuals.total() / 50 ? medianOf(values) : rounding;
  }
  const double limit = std::max(options.threshold * 1.4826 * deviation, rounding);

  cv::Mat heights = ownedHeights(surface);
  for (int row = 0; row < heights.rows; ++row) {
    const double* residual = residuals.ptr<double>(row);
    double* line = heights.ptr<double>(row);
    for (int col = 0; col < heights.cols; ++col) {
      if (std::fabs(residual[col] - center) > limit) line[col] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return {heights, surface.pitchX(), surface.pitchY()};
}

}  // namespace mems_stiction
