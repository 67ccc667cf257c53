#include "preprocess/window_median.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "numeric/median.hpp"

namespace mems_stiction {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Beyond the frame the surface goes on by its reflection through the border pixels, rows after
/// columns.
double heightAt(const cv::Mat1d& heights, int row, int col) {
  if (row < 0) return 2.0 * heightAt(heights, 0, col) - heightAt(heights, -row, col);
  const int last_row = heights.rows - 1;
  if (row > last_row)
    return 2.0 * heightAt(heights, last_row, col) - heightAt(heights, 2 * last_row - row, col);
  if (col < 0) return 2.0 * heights(row, 0) - heights(row, -col);
  const int last_col = heights.cols - 1;
  if (col > last_col) return 2.0 * heights(row, last_col) - heights(row, 2 * last_col - col);
  return heights(row, col);
}

/// One window after the other, by sorting.
double plainResidual(const cv::Mat1d& heights, int half, int row, int col) {
  const int half_rows = std::min(half, heights.rows - 1);
  const int half_cols = std::min(half, heights.cols - 1);
  std::vector<double> window;
  for (int near_row = row - half_rows; near_row <= row + half_rows; ++near_row) {
    for (int near_col = col - half_cols; near_col <= col + half_cols; ++near_col) {
      const double height = heightAt(heights, near_row, near_col);
      if (!std::isnan(height)) window.push_back(height);
    }
  }
  return heights(row, col) - medianOf(window);
}

/// To the bit.
void expectSame(const cv::Mat1d& heights, int half) {
  WindowMedian windows;
  windows.setFrame(heights.rows, heights.cols, half);
  for (int row = 0; row < heights.rows; ++row)
    std::copy_n(heights[row], heights.cols, windows.row(row));
  cv::Mat1d residuals(heights.size());
  windows.findResiduals(residuals[0]);
  int different = 0;
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      const double expected = plainResidual(heights, half, row, col);
      const double found = residuals(row, col);
      if (!(found == expected || (std::isnan(found) && std::isnan(expected)))) ++different;
    }
  }
  EXPECT_EQ(different, 0) << heights.cols << " x " << heights.rows << ", half a window of " << half;
}

cv::Mat1d noise(int rows, int cols, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  cv::Mat1d heights(rows, cols);
  for (double& height : heights) height = normal(engine);
  return heights;
}

TEST(WindowMedian, agreesWithSortingUpToTheBorder) {
  for (const int half : {1, 2, 3, 7}) expectSame(noise(43, 58, 1), half);
}

TEST(WindowMedian, agreesForEveryWidthOfTheFrame) {
  for (int cols = 1; cols <= 20; ++cols) {
    for (const int half : {1, 2}) expectSame(noise(9, cols, 2), half);
  }
}

TEST(WindowMedian, agreesOnFramesSmallerThanTheWindow) {
  for (int rows = 1; rows <= 4; ++rows) {
    for (int cols = 1; cols <= 4; ++cols) {
      for (const int half : {1, 2, 5}) expectSame(noise(rows, cols, 3), half);
    }
  }
}

TEST(WindowMedian, agreesWhereHeightsAreEqual) {
  for (const double step : {0.5, 2.0, 100.0}) {
    cv::Mat1d heights = noise(40, 41, 4);
    for (double& height : heights) height = std::round(height / step) * step;
    for (const int half : {1, 2}) expectSame(heights, half);
  }
}

TEST(WindowMedian, agreesAroundHoles) {
  cv::Mat1d heights = noise(60, 61, 5);
  heights(0, 0) = heights(30, 60) = heights(59, 30) = kNan;
  heights(cv::Rect(20, 20, 3, 4)).setTo(kNan);
  heights(cv::Rect(40, 40, 9, 9)).setTo(kNan);
  heights(44, 44) = 1.0;  // the only valid pixel of its window
  for (const int half : {1, 2, 3}) expectSame(heights, half);
}

TEST(WindowMedian, servesFramesOfAnotherSizeInTheSameMemory) {
  WindowMedian windows;
  for (const int size : {40, 12, 33}) {
    const cv::Mat1d heights = noise(size, size + 1, 6);
    windows.setFrame(heights.rows, heights.cols, 2);
    for (int row = 0; row < heights.rows; ++row)
      std::copy_n(heights[row], heights.cols, windows.row(row));
    cv::Mat1d residuals(heights.size());
    windows.findResiduals(residuals[0]);
    EXPECT_EQ(residuals(0, 0), plainResidual(heights, 2, 0, 0));
    EXPECT_EQ(residuals(size - 1, size), plainResidual(heights, 2, size - 1, size));
  }
}

}  // namespace
}  // namespace mems_stiction
