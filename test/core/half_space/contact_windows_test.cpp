/// Contacts relaxed one by one against the equilibrium of the whole frame.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include <gtest/gtest.h>

#include "half_space/contact_minimiser.hpp"
#include "half_space/contact_windows.hpp"
#include "support/rough_relief.hpp"

namespace mems_stiction {
namespace {

constexpr double kModulus = 88.8e9;
constexpr double kPitch = 5e-9;

TractionLaw law() { return TractionLaw(TractionLawOptions()); }

/// Gap at first touch of a rough surface and a plane.
LargePageVector<double> rough(int rows, int cols, double rms_height) {
  GaussianSurfaceOptions options;
  options.rows = rows;
  options.cols = cols;
  options.pitch_x = options.pitch_y = kPitch;
  options.correlation_length_x = options.correlation_length_y = 60e-9;
  options.rms_height = rms_height;
  options.seed = 3;
  return roughRelief(options);
}

/// A frame whose surfaces have not answered yet: u = 0.
class Undeformed {
 public:
  Undeformed(const HalfSpaceGrid& grid, LargePageVector<double> relief, double height,
             int threads = 1)
      : grid_(grid),
        law_(law()),
        stiffness_(grid, kModulus, 1, memory_),
        relief_(std::move(relief)),
        height_(height),
        zeros_(grid.size(), 0.0),
        residual_(grid.size(), 0.0F),
        change(grid.size(), 0.0F) {
    forEachCell([&](std::size_t cell, std::size_t in_frame) {
      residual_[cell] = static_cast<float>(law_.at(height_ + relief_[in_frame]).traction);
    });
    MinimiserSettings settings;
    settings.threads = threads;
    ContactWindows windows(grid_, law_, ElasticResponse{kModulus}, settings);
    largest_before = largest(residual_);
    did_relax = windows.relax({height_, relief_.data(), zeros_.data(), zeros_.data(),
                               residual_.data(), mean(residual_), largest_before},
                              stiffness_, change.data());
  }

  /// Largest residual after u has answered the changes.
  double largestAfter() {
    LargePageVector<double> displacement(change.begin(), change.end());
    stiffness_.displace(displacement.data(), displacement.data());
    LargePageVector<float> after(grid_.size(), 0.0F);
    for (std::size_t i = 0; i < after.size(); ++i) after[i] = -change[i];
    forEachCell([&](std::size_t cell, std::size_t in_frame) {
      after[cell] +=
          static_cast<float>(law_.at(height_ + relief_[in_frame] - displacement[cell]).traction);
    });
    return largest(after);
  }

 private:
  template <typename Work>
  void forEachCell(const Work& work) const {
    for (int row = 0; row < grid_.frame_rows; ++row) {
      for (int col = 0; col < grid_.frame_cols; ++col) {
        work(grid_.offset(row) + static_cast<std::size_t>(col),
             static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.frame_cols) +
                 static_cast<std::size_t>(col));
      }
    }
  }
  /// What K cannot resist.
  double mean(const LargePageVector<float>& values) const {
    if (grid_.boundary == HalfSpaceBoundary::kFree) return 0.0;
    double sum = 0.0;
    forEachCell([&](std::size_t cell, std::size_t) { sum += static_cast<double>(values[cell]); });
    return sum / grid_.cellCount();
  }
  double largest(const LargePageVector<float>& values) const {
    const double level = mean(values);
    double most = 0.0;
    forEachCell([&](std::size_t cell, std::size_t) {
      most = std::max(most, std::abs(static_cast<double>(values[cell]) - level));
    });
    return most;
  }

  HalfSpaceGrid grid_;
  TractionLaw law_;
  SpectrumMemory memory_;
  StiffnessOperator<double> stiffness_;
  LargePageVector<double> relief_;
  double height_;
  LargePageVector<double> zeros_;
  LargePageVector<float> residual_;

 public:
  LargePageVector<float> change;
  double largest_before = 0.0;
  bool did_relax = false;
};

class WindowsOfFrame : public testing::TestWithParam<HalfSpaceBoundary> {};
INSTANTIATE_TEST_SUITE_P(Boundaries, WindowsOfFrame,
                         testing::Values(HalfSpaceBoundary::kPeriodic, HalfSpaceBoundary::kFree),
                         [](const auto& tested) {
                           return tested.param == HalfSpaceBoundary::kFree ? "free" : "periodic";
                         });

TEST_P(WindowsOfFrame, OneProductBringsContactsIntoEquilibrium) {
  // summits overlap by up to a fifth of z0, where the law repels with six times its constant
  const HalfSpaceGrid grid(241, 303, kPitch, kPitch, GetParam());
  Undeformed frame(grid, rough(241, 303, 4e-9), 0.8 * law().range());
  ASSERT_TRUE(frame.did_relax);
  EXPECT_GT(frame.largest_before, 5.0 * law().stress());
  EXPECT_LT(frame.largestAfter(), 0.05 * frame.largest_before);
}

TEST_P(WindowsOfFrame, PixelsWithoutAHeightDoNotTouch) {
  const HalfSpaceGrid grid(241, 303, kPitch, kPitch, GetParam());
  LargePageVector<double> relief = rough(241, 303, 4e-9);
  const auto summit = std::min_element(relief.begin(), relief.end());
  *(summit + 2) = std::numeric_limits<double>::infinity();
  Undeformed frame(grid, relief, 0.8 * law().range());
  ASSERT_TRUE(frame.did_relax);
  EXPECT_LT(frame.largestAfter(), 0.05 * frame.largest_before);
}

TEST(ContactWindows, FramesThatTouchAllOverAreLeftToNewton) {
  const HalfSpaceGrid grid(128, 128, kPitch, kPitch, HalfSpaceBoundary::kPeriodic);
  const Undeformed frame(grid, rough(128, 128, 0.02e-9), 0.9 * law().range());
  EXPECT_FALSE(frame.did_relax);
  EXPECT_EQ(
      cv::norm(cv::Mat(1, static_cast<int>(frame.change.size()), CV_32F,
                       const_cast<float*>(
                           frame.change.data()))),  // NOLINT(cppcoreguidelines-pro-type-const-cast)
      0.0);
}

TEST(ContactWindows, WindowsGoOnBeyondTheEdgesOfAPeriodicFrame) {
  const int rows = 240, cols = 304;
  const HalfSpaceGrid grid(rows, cols, kPitch, kPitch, HalfSpaceBoundary::kPeriodic);
  const LargePageVector<double> relief = rough(rows, cols, 4e-9);
  const auto summit =
      static_cast<int>(std::min_element(relief.begin(), relief.end()) - relief.begin());
  // the highest summit to the corner, by whole blocks, so that windows lie about contacts as before
  const int down = rows - summit / cols / 8 * 8;
  const int right = cols - summit % cols / 8 * 8;
  const auto place = [&](int row, int col) {
    const int turned_place = (row + down) % rows * cols + (col + right) % cols;
    return static_cast<std::size_t>(turned_place);
  };
  const auto inFrame = [&](int row, int col) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) +
           static_cast<std::size_t>(col);
  };
  LargePageVector<double> turned(relief.size());
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) turned[place(row, col)] = relief[inFrame(row, col)];
  }
  const Undeformed inside(grid, relief, 0.8 * law().range());
  const Undeformed corner(grid, turned, 0.8 * law().range());
  ASSERT_TRUE(inside.did_relax);
  double difference = 0.0;
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const std::size_t there = place(row, col);
      const std::size_t cell =
          grid.offset(static_cast<int>(there) / cols) + there % static_cast<std::size_t>(cols);
      const float here = inside.change[grid.offset(row) + static_cast<std::size_t>(col)];
      difference = std::max(difference, std::abs(static_cast<double>(here - corner.change[cell])));
    }
  }
  EXPECT_LT(difference, 1e-4 * inside.largest_before);  // sums run in another order
}

TEST(ContactWindows, BitsDoNotDependOnTheThreads) {
  const HalfSpaceGrid grid(241, 303, kPitch, kPitch, HalfSpaceBoundary::kPeriodic);
  const Undeformed one(grid, rough(241, 303, 4e-9), 0.8 * law().range());
  const Undeformed three(grid, rough(241, 303, 4e-9), 0.8 * law().range(), 3);
  EXPECT_EQ(one.change, three.change);
}

/// One state after the other, with windows and without; and what products these took.
/// - @p share that the windows may take of the products without
void expectTheSameStates(const HalfSpaceGrid& grid, const ElasticResponse& response, double share) {
  MinimiserSettings settings;
  // what is left of a long wave's residual moves a thin body the more
  if (response.layers != nullptr) settings.tolerance *= 0.1;
  const LargePageVector<double> relief = rough(grid.frame_rows, grid.frame_cols, 4e-9);
  ContactMinimiser with_windows(grid, law(), response, relief, settings);
  ContactMinimiser alone(grid, law(), response, relief, {}, settings);
  double largest_force = 0.0;
  int products_with = 0;
  int products_alone = 0;
  for (const double height : {4.0, 2.0, 1.5, 1.2, 1.0, 0.8, 0.6, 0.4, 0.6, 0.8, 1.2, 2.0}) {
    with_windows.moveOn(0.0);
    alone.moveOn(0.0);
    const ContactState one = with_windows.solve(height * law().range());
    const ContactState other = alone.solve(height * law().range());
    ASSERT_TRUE(one.is_converged);
    ASSERT_TRUE(other.is_converged);
    largest_force = std::max(largest_force, std::abs(other.force));
    EXPECT_NEAR(one.force, other.force,
                1e-3 * (response.layers == nullptr ? std::abs(other.force) : largest_force))
        << height;
    EXPECT_NEAR(one.energy, other.energy, 1e-3 * std::abs(other.energy)) << height;
    EXPECT_EQ(one.contact_area, other.contact_area) << height;
    products_with += one.products;
    products_alone += other.products;
  }
  EXPECT_LT(products_with, share * products_alone);
}

TEST_P(WindowsOfFrame, StatesAreThoseOfNewtonsMethodAlone) {
  expectTheSameStates(HalfSpaceGrid(241, 303, kPitch, kPitch, GetParam()),
                      ElasticResponse{kModulus}, 0.5);
}

TEST_P(WindowsOfFrame, PlatesAndFilmsAreRelaxedToo) {
  Material lower, upper;
  lower.youngs_modulus = kModulus;
  lower.poisson_ratio = 0.3;
  upper.youngs_modulus = 1e30;
  for (const double thickness : {8.0 * kPitch, 40.0 * kPitch}) {
    for (const Backing backing : {Backing::kBonded, Backing::kFree}) {
      if (backing == Backing::kFree && GetParam() == HalfSpaceBoundary::kFree) continue;
      lower.thickness = thickness;
      lower.backing = backing;
      const WaveStiffness layers(lower, upper);
      SCOPED_TRACE(thickness / kPitch);
      expectTheSameStates(
          HalfSpaceGrid(241, 303, kPitch, kPitch, GetParam()),
          ElasticResponse{ContactPair(lower, upper).contact_modulus, nullptr, &layers},
          backing == Backing::kFree ? 0.9 : 0.5);
    }
  }
}

}  // namespace
}  // namespace mems_stiction
