/// The elastic half-space in Fourier space against waves and against sums of single loads.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <initializer_list>
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

/// A body with an other side, against one that is rigid.
struct Body {
  explicit Body(double thickness, Backing backing, double substrate = 0.0) {
    lower.youngs_modulus = kModulus;
    lower.poisson_ratio = 0.3;
    lower.thickness = thickness;
    lower.backing = backing;
    lower.substrate.youngs_modulus = substrate;
    upper.youngs_modulus = 1e40;
  }
  double contactModulus() const { return ContactPair(lower, upper).contact_modulus; }

  Material lower;
  Material upper;
};

/// Every wave of a periodic frame needs stiffness_of(its wave number).
template <typename StiffnessOf>
void expectWaves(const Frame& frame, const ElasticResponse& response,
                 const StiffnessOf& stiffness_of) {
  const HalfSpaceGrid grid(frame.rows, frame.cols, frame.pitch_x, frame.pitch_y,
                           HalfSpaceBoundary::kPeriodic);
  SpectrumMemory memory;
  StiffnessOperator<double> stiffness(grid, response, 1, memory);
  for (int wave_y = 0; wave_y <= frame.rows / 2; wave_y += 2) {
    for (int wave_x = 0; wave_x <= frame.cols / 2; wave_x += 3) {
      const double q =
          2.0 * kPi *
          std::hypot(wave_x / (frame.cols * frame.pitch_x), wave_y / (frame.rows * frame.pitch_y));
      LargePageVector<double> wave(grid.size(), 0.0);
      for (int row = 0; row < frame.rows; ++row) {
        for (int col = 0; col < frame.cols; ++col) {
          wave[grid.offset(row) + static_cast<std::size_t>(col)] = std::cos(
              2.0 * kPi * (double(wave_x) * col / frame.cols - double(wave_y) * row / frame.rows));
        }
      }
      LargePageVector<double> traction(grid.size(), 0.0);
      stiffness.multiply(wave.data(), traction.data());
      for (std::size_t i = 0; i < wave.size(); ++i) {
        // round-off of the transforms, of the stiffest wave
        ASSERT_NEAR(traction[i], stiffness_of(q) * wave[i], 1e-12 * stiffness.largest() + 1e-300);
      }
    }
  }
}

TEST_P(StiffnessOfFrame, WaveNeedsHalfModulusTimesWaveNumber) {
  expectWaves(GetParam(), ElasticResponse{kModulus}, [](double q) { return 0.5 * kModulus * q; });
}

TEST_P(StiffnessOfFrame, WaveNeedsTheStiffnessOfAPlateOrFilm) {
  for (const Body& body : {Body(8e-9, Backing::kFree), Body(8e-9, Backing::kBonded),
                           Body(8e-9, Backing::kBonded, 5e9)}) {
    const WaveStiffness layers(body.lower, body.upper);
    expectWaves(GetParam(), ElasticResponse{body.contactModulus(), nullptr, &layers},
                [&](double q) { return q > 0.0 ? layers.at(q) : 0.0; });
  }
}

TEST(StiffnessOperator, ThickBodiesAnswerAsHalfSpacesToTheBit) {
  const HalfSpaceGrid grid(24, 30, 5e-9, 4e-9, HalfSpaceBoundary::kPeriodic);
  SpectrumMemory memory;
  const LargePageVector<double> displacement = noise<double>(grid, false);
  LargePageVector<double> of_half_space(grid.size(), 0.0), of_thick(grid.size(), 0.0);
  for (const Backing backing : {Backing::kFree, Backing::kBonded}) {
    const Body body(1e-3, backing);
    const WaveStiffness layers(body.lower, body.upper);
    StiffnessOperator<double> half_space(grid, body.contactModulus(), 1, memory);
    half_space.multiply(displacement.data(), of_half_space.data());
    StiffnessOperator<double> thick(grid, ElasticResponse{body.contactModulus(), nullptr, &layers},
                                    1, memory);
    thick.multiply(displacement.data(), of_thick.data());
    EXPECT_EQ(of_half_space, of_thick);
    EXPECT_EQ(half_space.smallest(), thick.smallest());
    EXPECT_EQ(half_space.largest(), thick.largest());
  }
}

TEST(StiffnessOperator, KnowsTheSoftestAndTheStiffestWave) {
  const HalfSpaceGrid grid(24, 30, 5e-9, 4e-9, HalfSpaceBoundary::kPeriodic);
  Body body(3e-9, Backing::kBonded);
  body.lower.poisson_ratio = 0.5;  // long waves and short ones are stiff
  const WaveStiffness layers(body.lower, body.upper);
  SpectrumMemory memory;
  const StiffnessOperator<double> stiffness(
      grid, ElasticResponse{body.contactModulus(), nullptr, &layers}, 1, memory);
  double smallest = 1e300, largest = 0.0;
  for (int row = 0; row <= 12; ++row) {
    for (int col = 0; col <= 15; ++col) {
      if (row + col == 0) continue;
      const double of_wave =
          layers.at(2.0 * kPi * std::hypot(row / (24 * 4e-9), col / (30 * 5e-9)));
      smallest = std::min(smallest, of_wave);
      largest = std::max(largest, of_wave);
    }
  }
  EXPECT_NEAR(stiffness.smallest() / smallest, 1.0, 1e-12);
  EXPECT_NEAR(stiffness.largest() / largest, 1.0, 1e-12);
}

/// Displacement at some distance from the middle of a Gaussian pressure of 1 Pa [m].
double ofGaussianPressure(const WaveStiffness& layers, double width, double distance) {
  double sum = 0.0;
  const double step = 2e-3 / width;
  for (double q = 0.5 * step; q * width < 7.0; q += step) {
    sum += step * q / layers.at(q) * width * width * std::exp(-0.5 * q * q * width * width) *
           ::j0(q * distance);
  }
  return sum;
}

TEST(StiffnessOperator, FilmsWithFreeEdgesGiveWayAsTheirWavesDo) {
  const double pitch = 4e-9;
  const int cells = 96;
  const double width = 8.0 * pitch;
  const HalfSpaceGrid grid(cells, cells, pitch, pitch, HalfSpaceBoundary::kFree);
  SpectrumMemory memory;
  for (const double pixels : {0.3, 2.0, 20.0, 300.0}) {
    for (const double substrate : {0.0, 10e9, 400e9}) {
      Body body(pixels * pitch, Backing::kBonded, substrate);
      body.upper = body.lower;
      body.upper.thickness = 0.0;
      body.upper.youngs_modulus *= 3.0;
      const WaveStiffness layers(body.lower, body.upper);
      StiffnessOperator<double> stiffness(
          grid, ElasticResponse{body.contactModulus(), nullptr, &layers}, 1, memory);
      EXPECT_GT(stiffness.smallest(), 0.0);
      LargePageVector<double> traction(grid.size(), 0.0), displacement(grid.size(), 0.0);
      const auto place = [&](int row, int col) {
        return grid.offset(row) + static_cast<std::size_t>(col);
      };
      for (int row = 0; row < cells; ++row) {
        for (int col = 0; col < cells; ++col) {
          const double r = pitch * std::hypot(row - cells / 2, col - cells / 2);
          traction[place(row, col)] = std::exp(-0.5 * r * r / (width * width));
        }
      }
      stiffness.precondition(1e-12 * stiffness.smallest(), traction.data(), displacement.data());
      const double deepest = ofGaussianPressure(layers, width, 0.0);
      for (const int away : {0, 5, 17, 40}) {
        EXPECT_NEAR(displacement[place(cells / 2, cells / 2 + away)],
                    ofGaussianPressure(layers, width, away * pitch),
                    1e-3 * deepest)
            << pixels << ' ' << substrate << ' '
            << away;  // the pressure of each cell is that of its middle
      }
    }
  }
}

template <typename Scalar>
void expectInverse(const Frame& frame, HalfSpaceBoundary boundary, double tolerance,
                   const ElasticResponse& response = ElasticResponse{kModulus}) {
  const HalfSpaceGrid grid(frame.rows, frame.cols, frame.pitch_x, frame.pitch_y, boundary);
  SpectrumMemory memory;
  StiffnessOperator<Scalar> stiffness(grid, response, 1, memory);
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
      ASSERT_NEAR(back[i] + shift * static_cast<double>(displacement[i]), traction[i] - mean,
                  tolerance);
    }
  }
  EXPECT_NEAR(product, expected_product, tolerance * expected_product + 1e-300);
}

TEST_P(StiffnessOfFrame, PreconditionerIsTheShiftedInverse) {
  // round-off of the transforms of values up to 1, times the ratio of the stiffest wave to the
  // shift
  for (const HalfSpaceBoundary boundary :
       {HalfSpaceBoundary::kPeriodic, HalfSpaceBoundary::kFree}) {
    expectInverse<double>(GetParam(), boundary, 1e-12);
    expectInverse<float>(GetParam(), boundary, 1e-4);
  }
  for (const Backing backing : {Backing::kFree, Backing::kBonded}) {
    const Body body(8e-9, backing);
    const WaveStiffness layers(body.lower, body.upper);
    const ElasticResponse response{body.contactModulus(), nullptr, &layers};
    expectInverse<double>(GetParam(), HalfSpaceBoundary::kPeriodic, 1e-12, response);
    expectInverse<float>(GetParam(), HalfSpaceBoundary::kPeriodic, 1e-4, response);
  }
}

TEST_P(StiffnessOfFrame, FreeBoundaryAddsTheLoadsOfAllCells) {
  const Frame& frame = GetParam();
  const HalfSpaceGrid grid(frame.rows, frame.cols, frame.pitch_x, frame.pitch_y,
                           HalfSpaceBoundary::kFree);
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
          // the midpoint rule for the integral of 1/r over the cell; an even number of points
          // avoids r = 0
          double integral = 0.0;
          for (int j = 0; j < fine; ++j) {
            for (int i = 0; i < fine; ++i) {
              const double dx = (x - col + (i + 0.5) / fine - 0.5) * frame.pitch_x;
              const double dy = (y - row + (j + 0.5) / fine - 0.5) * frame.pitch_y;
              integral += frame.pitch_x * frame.pitch_y / (fine * fine) / std::hypot(dx, dy);
            }
          }
          expected +=
              integral / (kPi * kModulus) * traction[grid.offset(y) + static_cast<std::size_t>(x)];
        }
      }
      // the midpoint rule misses 2 % of the loaded cell's own 1/r with 40 x 40 points
      const double own = 3.6 * std::max(frame.pitch_x, frame.pitch_y) / (kPi * kModulus);
      ASSERT_NEAR(displacement[grid.offset(row) + static_cast<std::size_t>(col)], expected,
                  0.02 * own);
    }
  }
}

TEST(StiffnessOperator, SetUpOfFreeEdgesEndsWhenCancelled) {
  const HalfSpaceGrid grid(40, 30, 1e-9, 1e-9, HalfSpaceBoundary::kFree);
  SpectrumMemory memory;
  std::atomic<bool> cancel{false};
  EXPECT_TRUE(
      std::isfinite(StiffnessOperator<float>(grid, kModulus, 1, memory, &cancel).smallest()));
  cancel = true;
  EXPECT_TRUE(std::isinf(StiffnessOperator<float>(grid, kModulus, 1, memory, &cancel).smallest()));
}

TEST(StiffnessOperator, ProductsEndWhenCancelled) {
  for (const HalfSpaceBoundary boundary :
       {HalfSpaceBoundary::kPeriodic, HalfSpaceBoundary::kFree}) {
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
  for (const HalfSpaceBoundary boundary :
       {HalfSpaceBoundary::kPeriodic, HalfSpaceBoundary::kFree}) {
    const HalfSpaceGrid grid(45, 70, 1e-9, 1e-9, boundary);
    const LargePageVector<float> traction = noise<float>(grid, false);
    SpectrumMemory memory;
    LargePageVector<float> one(grid.size(), 0.0F), three(grid.size(), 0.0F);
    const double product_of_one = StiffnessOperator<float>(grid, kModulus, 1, memory)
                                      .precondition(1e19, traction.data(), one.data());
    const double product_of_three = StiffnessOperator<float>(grid, kModulus, 3, memory)
                                        .precondition(1e19, traction.data(), three.data());
    EXPECT_EQ(one, three);
    EXPECT_EQ(product_of_one, product_of_three);
  }
}

}  // namespace
}  // namespace mems_stiction
