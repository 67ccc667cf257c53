/// The step of Newton's method against its own equation, (K + t') s = r, with small and with large
/// contacts.

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "half_space/conjugate_gradients.hpp"

namespace mems_stiction {
namespace {

constexpr double kModulus = 88.8e9;

/// A grid whose contacts are one cell in `every`, that hold with `stiffness` over that of the
/// shortest waves.
struct Case {
  HalfSpaceBoundary boundary;
  int every;
  double stiffness;
};

class SolvedCase {
 public:
  explicit SolvedCase(const Case& asked, int threads = 1, bool is_coarse = true)
      : grid_(20, 27, 5e-9, 4e-9, asked.boundary),
        stiffness_(grid_, kModulus, threads, memory_),
        coarse_(grid_, ElasticResponse{kModulus}, threads, memory_, nullptr),
        gradients_(grid_, stiffness_, is_coarse ? &coarse_ : nullptr, threads, nullptr, {}) {
    gradients_.allocate();
    std::mt19937 random(1);
    ConjugateGradients::System system;
    for (int row = 0; row < grid_.rows; ++row) {
      for (int col = 0; col < grid_.cols; ++col) {
        const std::size_t i = grid_.offset(row) + static_cast<std::size_t>(col);
        const bool is_frame = row < grid_.frame_rows && col < grid_.frame_cols;
        gradients_.residual()[i] = is_frame ? 1e6F * static_cast<float>(random() % 1000) : 0.0F;
        const bool is_held = is_frame && (row * grid_.frame_cols + col) % asked.every == 0;
        gradients_.slope()[i] =
            is_held ? static_cast<float>(asked.stiffness * stiffness_.largest()) : 0.0F;
        system.mean_slope += static_cast<double>(gradients_.slope()[i]) / grid_.cellCount();
        system.mean_residual += static_cast<double>(gradients_.residual()[i]) / grid_.cellCount();
      }
    }
    if (stiffness_.resistsMean()) system.mean_residual = 0.0;
    system.longest_move = 1.0;  // the law is straight: as exactly as it can
    residual_.assign(gradients_.residual(), gradients_.residual() + grid_.size());
    direction = gradients_.find(system);
  }

  /// Largest |r - K s - t' s|, without its mean where K resists none, over that of r.
  double error() {
    std::vector<float> traction(grid_.size());
    stiffness_.multiply(gradients_.step(), traction.data());
    std::vector<double> left;
    double largest = 0.0;
    double sum = 0.0;
    forEachCell([&](std::size_t i) {
      largest = std::max(largest, std::abs(static_cast<double>(residual_[i])));
      left.push_back(static_cast<double>(residual_[i]) - static_cast<double>(traction[i]) -
                     static_cast<double>(gradients_.slope()[i]) *
                         static_cast<double>(gradients_.step()[i]));
      sum += left.back();
    });
    const double mean = stiffness_.resistsMean() ? 0.0 : sum / grid_.cellCount();
    double error = 0.0;
    for (const double value : left) error = std::max(error, std::abs(value - mean));
    return error / largest;
  }

  /// Largest difference of K s as it came along and as it is, over the largest.
  double tractionError() {
    std::vector<float> traction(grid_.size());
    stiffness_.multiply(gradients_.step(), traction.data());
    double largest = 0.0;
    double error = 0.0;
    double mean = 0.0;  // it came along with the mean of the residual that nothing answers
    forEachCell([&](std::size_t i) {
      mean += static_cast<double>(gradients_.stepTraction()[i] - traction[i]) / grid_.cellCount();
    });
    forEachCell([&](std::size_t i) {
      largest = std::max(largest, std::abs(static_cast<double>(traction[i])));
      error = std::max(
          error, std::abs(static_cast<double>(gradients_.stepTraction()[i] - traction[i]) - mean));
    });
    return error / largest;
  }

  std::vector<float> step() const { return {gradients_.step(), gradients_.step() + grid_.size()}; }
  int products() const { return gradients_.products(); }

  ConjugateGradients::Direction direction;

 private:
  template <typename Work>
  void forEachCell(const Work& work) const {
    for (int row = 0; row < grid_.rows; ++row) {
      for (int col = 0; col < grid_.cols; ++col)
        work(grid_.offset(row) + static_cast<std::size_t>(col));
    }
  }

  HalfSpaceGrid grid_;
  SpectrumMemory memory_;
  StiffnessOperator<float> stiffness_;
  CoarseAnswer coarse_;
  ConjugateGradients gradients_;
  std::vector<float> residual_;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const HalfSpaceBoundary boundary :
       {HalfSpaceBoundary::kPeriodic, HalfSpaceBoundary::kFree}) {
    all.push_back({boundary, 540, 0.3});  // one contact: small
    all.push_back({boundary, 3, 0.1});
    all.push_back({boundary, 3, 30.0});
    all.push_back({boundary, 1, 3.0});
  }
  return all;
}

TEST(ConjugateGradients, TheStepSolvesItsEquation) {
  for (const Case& asked : cases()) {
    SCOPED_TRACE(testing::Message() << static_cast<int>(asked.boundary) << " " << asked.every << " "
                                    << asked.stiffness);
    for (const bool is_coarse : {false, true}) {
      SolvedCase solved(asked, 1, is_coarse);
      EXPECT_LT(solved.error(), 0.02)
          << is_coarse;  // a thousandth in the norm of the preconditioner
      EXPECT_LT(solved.tractionError(), 1e-4)
          << is_coarse;  // single precision over some dozen iterations
      EXPECT_GT(solved.direction.decrease, 0.0);
      EXPECT_FALSE(solved.direction.is_unstable);
    }
  }
}

TEST(ConjugateGradients, StiffContactsTakeFewProducts) {
  for (const HalfSpaceBoundary boundary :
       {HalfSpaceBoundary::kPeriodic, HalfSpaceBoundary::kFree}) {
    // a third of the frame held a thousand times as stiffly as the shortest waves
    const int of_all = SolvedCase({boundary, 3, 1000.0}, 1, false).products();
    EXPECT_LT(of_all, 40);
    // every second cell answers as well: K alone is left of an iteration's two products
    EXPECT_LT(SolvedCase({boundary, 3, 1000.0}).products(), 0.8 * of_all);
  }
}

TEST(ConjugateGradients, BitsDoNotDependOnTheThreads) {
  for (const Case& asked : cases())
    EXPECT_EQ(SolvedCase(asked, 1).step(), SolvedCase(asked, 3).step());
}

}  // namespace
}  // namespace mems_stiction
