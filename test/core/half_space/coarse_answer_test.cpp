/// What every second cell answers to a traction against what all cells answer.

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "half_space/coarse_answer.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

constexpr double kModulus = 88.8e9;

struct Frame {
  const char* name;
  int rows;
  int cols;
  HalfSpaceBoundary boundary;
};

const Frame kFrames[] = {{"even", 32, 48, HalfSpaceBoundary::kPeriodic},
                         {"odd", 33, 47, HalfSpaceBoundary::kPeriodic},
                         {"mixed", 32, 45, HalfSpaceBoundary::kPeriodic},
                         {"free", 24, 31, HalfSpaceBoundary::kFree}};

/// Answers of all cells and of every second one on one frame.
class BothAnswers {
 public:
  explicit BothAnswers(const Frame& frame, int threads = 1)
      : grid_(frame.rows, frame.cols, 5e-9, 4e-9, frame.boundary),
        stiffness_(grid_, kModulus, threads, memory_),
        coarse_(grid_, ElasticResponse{kModulus}, threads, memory_, nullptr) {}

  const HalfSpaceGrid& grid() const { return grid_; }
  std::vector<float> fine(const std::vector<float>& traction) {
    std::vector<float> displacement(grid_.size(), 0.0F);
    stiffness_.precondition(shift(), traction.data(), displacement.data());
    return displacement;
  }
  std::vector<float> coarse(const std::vector<float>& traction) {
    std::vector<float> displacement(grid_.size(), 0.0F);
    coarse_.find(shift(), traction.data());
    for (int row = 0; row < grid_.rows; ++row)
      coarse_.row(row, displacement.data() + grid_.offset(row));
    return displacement;
  }
  std::vector<float> noise(unsigned seed) const {
    std::mt19937 random(seed);
    return field([&](int, int) { return static_cast<double>(random()) / random.max() - 0.5; });
  }
  /// As many waves along the rows and down the columns.
  std::vector<float> wave(int along, int down) const {
    return field([&](int row, int col) {
      return std::cos(2.0 * kPi *
                      (static_cast<double>(along * col) / grid_.cols +
                       static_cast<double>(down * row) / grid_.rows));
    });
  }
  double product(const std::vector<float>& a, const std::vector<float>& b) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
      sum += static_cast<double>(a[i]) * static_cast<double>(b[i]);
    return sum;
  }

 private:
  double shift() const { return 0.5 * stiffness_.smallest(); }
  template <typename At>
  std::vector<float> field(const At& at) const {
    std::vector<float> values(grid_.size(), 0.0F);
    for (int row = 0; row < grid_.rows; ++row) {
      for (int col = 0; col < grid_.cols; ++col) {
        values[grid_.offset(row) + static_cast<std::size_t>(col)] =
            static_cast<float>(at(row, col));
      }
    }
    return values;
  }

  HalfSpaceGrid grid_;
  SpectrumMemory memory_;
  StiffnessOperator<float> stiffness_;
  CoarseAnswer coarse_;
};

class CoarseAnswerOfFrame : public testing::TestWithParam<Frame> {};
INSTANTIATE_TEST_SUITE_P(Frames, CoarseAnswerOfFrame, testing::ValuesIn(kFrames),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(CoarseAnswerOfFrame, LongWavesAreAnsweredAsByAllCells) {
  BothAnswers answers(GetParam());
  for (const int waves : {1, 2}) {
    const std::vector<float> traction = answers.wave(waves, waves);
    const std::vector<float> fine = answers.fine(traction);
    const std::vector<float> coarse = answers.coarse(traction);
    double error = 0.0;
    for (std::size_t i = 0; i < fine.size(); ++i)
      error += std::pow(static_cast<double>(coarse[i] - fine[i]), 2);
    EXPECT_LT(std::sqrt(error / answers.product(fine, fine)), 0.2) << waves;
  }
}

TEST_P(CoarseAnswerOfFrame, WhatVariesFromCellToCellIsNotAnswered) {
  BothAnswers answers(GetParam());
  const HalfSpaceGrid& grid = answers.grid();
  const std::vector<float> traction = answers.wave(grid.cols / 2, grid.rows / 2);
  const std::vector<float> fine = answers.fine(traction);
  EXPECT_LT(answers.product(answers.coarse(traction), traction),
            0.1 * answers.product(fine, traction));
}

TEST_P(CoarseAnswerOfFrame, IsSymmetricAndNeverNegative) {
  BothAnswers answers(GetParam());
  const std::vector<float> one = answers.noise(1);
  const std::vector<float> other = answers.noise(2);
  const std::vector<float> answer = answers.coarse(one);
  const double scale = answers.product(answer, one);
  EXPECT_GT(scale, 0.0);
  EXPECT_NEAR(answers.product(answer, other), answers.product(answers.coarse(other), one),
              1e-4 * scale);
}

TEST_P(CoarseAnswerOfFrame, BitsDoNotDependOnTheThreads) {
  BothAnswers one(GetParam(), 1);
  BothAnswers three(GetParam(), 3);
  const std::vector<float> traction = one.noise(3);
  EXPECT_EQ(one.coarse(traction), three.coarse(traction));
}

TEST(CoarseAnswer, NarrowFramesHaveNone) {
  EXPECT_FALSE(CoarseAnswer::fits(HalfSpaceGrid(1, 512, 1e-9, 1e-9, HalfSpaceBoundary::kPeriodic)));
  EXPECT_TRUE(CoarseAnswer::fits(HalfSpaceGrid(17, 16, 1e-9, 1e-9, HalfSpaceBoundary::kPeriodic)));
}

}  // namespace
}  // namespace mems_stiction
