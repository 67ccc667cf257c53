#include "surface/block_convolution.hpp"

#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// Falls by `power` up to a wave of 2 cells, and smoothly to 0 towards waves of 48 cells.
double bandGain(double wave_x, double wave_y, double power) {
  const double wave = std::hypot(wave_x, wave_y);
  if (wave <= 2.0 * kPi / 48.0) return 0.0;
  const double t = std::min(1.0, std::log(wave * 48.0 / (2.0 * kPi)) / std::log(4.0));
  return t * t * t * (10.0 - 15.0 * t + 6.0 * t * t) * std::pow(wave, -power);
}

/// The cells (row, col) to (row + size - 1, col + size - 1), block by block.
std::vector<float> cells(const BlockConvolution& convolution, std::int64_t row, std::int64_t col,
                         std::int64_t size) {
  NumberedNoise noise(11, 0);
  ConvolutionMemory memory;
  const std::int64_t rows = convolution.block().rows;
  const std::int64_t cols = convolution.block().cols;
  std::vector<float> block(static_cast<std::size_t>(rows * cols));
  std::vector<float> values(static_cast<std::size_t>(size * size));
  for (std::int64_t i = row / rows; i * rows < row + size; ++i) {
    for (std::int64_t j = col / cols; j * cols < col + size; ++j) {
      convolution.make(noise, i, j, memory, block.data());
      for (std::int64_t y = std::max(row, i * rows); y < std::min(row + size, (i + 1) * rows);
           ++y) {
        for (std::int64_t x = std::max(col, j * cols); x < std::min(col + size, (j + 1) * cols);
             ++x) {
          values[static_cast<std::size_t>((y - row) * size + x - col)] =
              block[static_cast<std::size_t>((y - i * rows) * cols + x - j * cols)];
        }
      }
    }
  }
  return values;
}

// Seams of one layout lie inside the blocks of the other.
TEST(BlockConvolution, makesTheSameInBlocksOfAnySize) {
  const WaveGain gain = [](double x, double y) { return bandGain(x, y, 1.8); };
  BlockLayout large;
  BlockLayout small;
  small.choice = BlockChoice::kSmall;
  const BlockConvolution one(gain, large);
  const BlockConvolution other(gain, small);
  ASSERT_NE(one.block().rows, other.block().rows);
  ASSERT_NE(one.block().cols, other.block().cols);
  const std::vector<float> a = cells(one, 100, 1000, 900);
  const std::vector<float> b = cells(other, 100, 1000, 900);
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::fabs(static_cast<double>(a[i]) - b[i]));
  // the kernel is sampled at other waves: what wraps around a transform is 1e-4 of it
  EXPECT_LT(largest, 1e-3 * std::sqrt(one.variance()));
}

TEST(BlockConvolution, neglectsLessThanAThousandthOfTheRmsHeight) {
  for (const double power : {0.0, 1.0, 1.5, 1.8, 2.0}) {
    const WaveGain gain = [power](double x, double y) { return bandGain(x, y, power); };
    for (const bool for_spline : {false, true}) {
      BlockLayout layout;
      layout.for_spline = for_spline;
      EXPECT_LT(std::sqrt(BlockConvolution(gain, layout).neglected()), 1e-3) << power;
    }
  }
}

TEST(BlockConvolution, takesNoLargerMarginThanAKernelNeeds) {
  const BlockConvolution convolution(
      [](double x, double y) { return std::exp(-(x * x + y * y) * 4.0); }, {});
  EXPECT_EQ(convolution.block().cols, 2 * convolution.block().rows);
  EXPECT_GE(convolution.block().rows, 7 * 512 / 8);
  EXPECT_LT(convolution.neglected(), 1e-12);
}

TEST(BlockConvolution, cutsAFarReachingKernelOffEarlierThanThatItWouldNotFit) {
  EXPECT_TRUE(BlockConvolution::fits(1.0, 30.0));
  EXPECT_TRUE(BlockConvolution::fits(6.0, 6.0));
  EXPECT_FALSE(BlockConvolution::fits(30.0, 30.0));
  BlockLayout layout;
  layout.reach_cols = 30.0;
  const BlockConvolution convolution([](double x, double y) { return bandGain(30.0 * x, y, 1.8); },
                                     layout);
  EXPECT_GE(convolution.block().rows, 64);
  EXPECT_GE(convolution.block().cols, 512);
  EXPECT_LT(std::sqrt(convolution.neglected()), 1e-2);
  EXPECT_GT(convolution.neglected(), 0.0);
}

}  // namespace
}  // namespace mems_stiction
