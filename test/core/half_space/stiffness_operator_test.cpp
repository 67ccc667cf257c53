/// The elastic half-space in Fourier space against waves and against sums of single loads.

#include <atomic>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "half_space/stiffness_operator.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

constexpr double kModulus = 88.8e9;

struct Frame {
  const char* name;
  int rows;
  int cols;
  double pitch_x;
  double pitch_y;
};

const Frame kFrames[] = {{"even", 16, 32, 5e-9, 5e-9},  {"odd", 15, 21, 5e-9, 5e-9},
                         {"prime", 13, 17, 2e-9, 2e-9}, {"anisotropic", 24, 10, 1e-9, 3e-9},
                         {"row", 1, 12, 1e-9, 1e-9},    {"column", 9, 1, 1e-9, 1e-9}};

class StiffnessOfFrame : public testing::TestWithParam<Frame> {};
INSTANTIATE_TEST_SUITE_P(Frames, StiffnessOfFrame, testing::ValuesIn(kFrames),
                         [](const auto& tested) { return tested.param.name; });

template <typename Scalar>
LargePageVector<Scalar> noise(const HalfSpaceGrid& grid, bool on_frame_only) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> values(-1.0, 1.0);
  LargePageVector<Scalar> field(grid.size(), Scalar(0));
  for (int row = 0; row < (on_frame_only ? grid.frame_rows : grid.rows); ++row) {
    for (int col = 0; col < (on_frame_only ? grid.frame_cols : grid.cols); ++col) {
      field[grid.offset(row) + static_cast<std::size_t>(col)] = static_cast<Scalar>(values(random));
    }
  }
  return field;
}

TEST_P(StiffnessOfFrame, WaveNeedsHalfModulusTimesWaveNumber) {
  const Frame& frame = GetParam();
  const HalfSpaceGrid grid(frame.rows, frame.cols, frame.pitch_x, frame.pitch_y, HalfSpaceBoundary::kPeriodic);
  SpectrumMemory memory;
  StiffnessOperator<double> stiffness(grid, kModulus, 1, memory);
  for (int wave_y = 0; wave_y <= frame.rows / 2; wave_y += 2) {
    for (int wave_x = 0; wave_x <= frame.cols / 2; wave_x += 3) {
      const double q =
          2.0 * kPi * std::hypot(wave_x / (frame.cols * frame.pitch_x), wave_y / (frame.rows * frame.pitch_y));
      LargePageVector<double> wave(grid.size(), 0.0);
      for (int row = 0; row < frame.rows; ++row) {
        for (int col = 0; col < frame.cols; ++col) {
          wave[grid.offset(row) + static_cast<std::size_t>(col)] =
              std::cos(2.0 * kPi * (double(wave_x) * col / frame.cols - double(wave_y) * row / frame.rows));
        }
      }
      LargePageVector<double> traction(grid.size(), 0.0);
      stiffness.multiply(wave.data(), traction.data());
      for (std::size_t i = 0; i < wave.size(); ++i) {
        // round-off of the transforms, of the stiffest wave
        ASSERT_NEAR(traction[i], 0.5 * kModulus * q * wave[i], 1e-12 * kModulus / frame.pitch_x);
      }
    }
  }
}

template <typename Scalar>
void expectInverse(const Frame& frame, HalfSpaceBoundary boundary, double tolerance) {
  const HalfSpaceGrid grid(frame.rows, frame.cols, frame.pitch_x, frame.pitch_y, boundary);
  SpectrumMemory memory;
  StiffnessOperator<Scalar> stiffness(grid, kModulus, 1, memory);
  const LargePageVector<Scalar> traction = noise<Scalar>(grid, false);
  LargePageVector<Scalar> displacement(grid.size(), Scalar(0)), back(grid.size(), Scalar(0));
  const double shift = 0.1 * kModulus / frame.pitch_x;
  const double product = stiffness.precondition(shift, traction.data(), displacement.data());
  stiffness.multiply(displacement.data(), back.data());
  double mean = 0.0;
  double expected_product = 0.0;
  for (std::size_t i = 0; i < traction.size(); ++i) {
    mean += static_cast<double>(traction[i]) / (grid.rows * grid.cols);
    expected_product += static_cast<double>(traction[i]) * static_cast<double>(displacement[i]);
  }
  if (stiffness.resistsMean()) mean = 0.0;
  for (int row = 0; row < grid.rows; ++row) {
    for (int col = 0; col < grid.cols; ++col) {
      const std::size_t i = grid.offset(row) + static_cast<std::size_t>(col);
      ASSERT_NEAR(back[i] + shift * static_cast<double>(displacement[i]), traction[i] - mean, tolerance);
    }
  }
  EXPECT_NEAR(product, expected_product, tolerance * expected_product + 1e-300);
}

TEST_P(StiffnessOfFrame, PreconditionerIsTheShiftedInverse) {
  // round-off of the transforms of values up to 1, times the ratio of the stiffest wave to the shift
  for (const HalfSpaceBoundary boundary : {HalfSpaceBoundary::kPeriodic, HalfSpaceBoundary::kFree}) {
    expectInverse<double>(GetParam(), boundary, 1e-12);
    expectInverse<float>(GetParam(), boundary, 1e-4);
  }
}

TEST_P(StiffnessOfFrame, FreeBoundaryAddsTheLoadsOfAllCells) {
  const Frame& frame = GetParam();
  const HalfSpaceGrid grid(frame.rows, frame.cols, frame.pitch_x, frame.pitch_y, HalfSpaceBoundary::kFree);
  SpectrumMemory memory;
  StiffnessOperator<double> stiffness(grid, kModulus, 1, memory);
  const LargePageVector<double> traction = noise<double>(grid, true);
  // (K + shift)^-1 with a shift that is nothing beside K
  LargePageVector<double> displacement(grid.size(), 0.0);
  stiffness.precondition(1e-12 * stiffness.smallest(), traction.data(), displacement.data());
  const int fine = 40;
  for (int row = 0; row < frame.rows; row += 4) {
    for (int col = 0; col < frame.cols; col += 5) {
      double expected = 0.0;
      for (int y = 0; y < frame.rows; ++y) {
        for (int x = 0; x < frame.cols; ++x) {
          // the midpoint rule for the integral of 1/r over the cell; an even number of points avoids r = 0
          double integral = 0.0;
          for (int j = 0; j < fine; ++j) {
            for (int i = 0; i < fine; ++i) {
              const double dx = (x - col + (i + 0.5) / fine - 0.5) * frame.pitch_x;
              const double dy = (y - row + (j + 0.5) / fine - 0.5) * frame.pitch_y;
              integral += frame.pitch_x * frame.pitch_y / (fine * fine) / std::hypot(dx, dy);
            }
          }
          expected += integral / (kPi * kModulus) * traction[grid.offset(y) + static_cast<std::size_t>(x)];
        }
      }
      // the midpoint rule misses 2 % of the loaded cell's own 1/r with 40 x 40 points
      const double own = 3.6 * std::max(frame.pitch_x, frame.pitch_y) / (kPi * kModulus);
      ASSERT_NEAR(displacement[grid.offset(row) + static_cast<std::size_t>(col)], expected, 0.02 * own);
    }
  }
}

TEST(StiffnessOperator, SetUpOfFreeEdgesEndsWhenCancelled) {
  const HalfSpaceGrid grid(40, 30, 1e-9, 1e-9, HalfSpaceBoundary::kFree);
  SpectrumMemory memory;
  std::atomic<bool> cancel{false};
  EXPECT_TRUE(std::isfinite(StiffnessOperator<float>(grid, kModulus, 1, memory, &cancel).smallest()));
  cancel = true;
  EXPECT_TRUE(std::isinf(StiffnessOperator<float>(grid, kModulus, 1, memory, &cancel).smallest()));
}

TEST(StiffnessOperator, ProductsEndWhenCancelled) {
  for (const HalfSpaceBoundary boundary : {HalfSpaceBoundary::kPeriodic, HalfSpaceBoundary::kFree}) {
    const HalfSpaceGrid grid(40, 30, 1e-9, 1e-9, boundary);
    SpectrumMemory memory;
    std::atomic<bool> cancel{false};
    StiffnessOperator<float> stiffness(grid, kModulus, 1, memory, &cancel);
    const LargePageVector<float> displacement = noise<float>(grid, false);
    LargePageVector<float> traction(grid.size(), 7.0F);
    cancel = true;
    stiffness.multiply(displacement.data(), traction.data());
    EXPECT_EQ(traction, LargePageVector<float>(grid.size(), 7.0F));  // not a row was written
  }
}

TEST(StiffnessOperator, BitsDoNotDependOnTheThreads) {
  for (const HalfSpaceBoundary boundary : {HalfSpaceBoundary::kPeriodic, HalfSpaceBoundary::kFree}) {
    const HalfSpaceGrid grid(45, 70, 1e-9, 1e-9, boundary);
    const LargePageVector<float> traction = noise<float>(grid, false);
    SpectrumMemory memory;
    LargePageVector<float> one(grid.size(), 0.0F), three(grid.size(), 0.0F);
    const double product_of_one =
        StiffnessOperator<float>(grid, kModulus, 1, memory).precondition(1e19, traction.data(), one.data());
    const double product_of_three =
        StiffnessOperator<float>(grid, kModulus, 3, memory).precondition(1e19, traction.data(), three.data());
    EXPECT_EQ(one, three);
    EXPECT_EQ(product_of_one, product_of_three);
  }
}

}  // namespace
}  // namespace mems_stiction
