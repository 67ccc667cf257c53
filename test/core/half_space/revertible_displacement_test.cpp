#include "half_space/revertible_displacement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace mems_stiction {
namespace {

constexpr int kRows = 3;
constexpr int kCols = 8;

class RevertibleDisplacementOf : public testing::TestWithParam<bool> {
 protected:
  /// One step that adds `by` to u, and twice as much to K u, everywhere.
  void step(float by) {
    const std::vector<float> move(kCols, by);
    const std::vector<float> traction(kCols, 2.0F * by);
    for (int row = 0; row < kRows; ++row)
      displacement_.step(row, {1.0, move.data(), traction.data()});
  }
  void begin(double share) {
    displacement_.begin(share, 0.25);
    const auto going_on = displacement_.takeShare();
    ASSERT_TRUE(going_on);
    EXPECT_FALSE(displacement_.takeShare());
    for (int row = 0; row < kRows; ++row) displacement_.goOn(row, *going_on);
  }
  double value() const { return displacement_.values()[grid_.offset(kRows - 1) + kCols - 1]; }
  double traction() const { return displacement_.traction()[grid_.offset(kRows - 1) + kCols - 1]; }

  HalfSpaceGrid grid_{kRows, kCols, 1e-8, 1e-8, HalfSpaceBoundary::kPeriodic};
  RevertibleDisplacement displacement_{grid_, GetParam(), 1, nullptr};
};
INSTANTIATE_TEST_SUITE_P(TracksTraction, RevertibleDisplacementOf, testing::Bool());

TEST_P(RevertibleDisplacementOf, GoesOnByAShareOfTheChangeBefore) {
  begin(0.0);
  step(4.0F);
  begin(0.5);
  EXPECT_EQ(value(), 6.0);
  EXPECT_EQ(traction(), GetParam() ? 12.0 : 8.0);
  EXPECT_EQ(displacement_.staleness(), GetParam() ? 0.25 : INFINITY);
}

TEST_P(RevertibleDisplacementOf, TakesBackWhatItWentOnByToo) {
  begin(0.0);
  step(4.0F);
  begin(0.5);
  step(1.0F);
  displacement_.takeBack();
  EXPECT_EQ(value(), 4.0);
  if (GetParam()) {
    EXPECT_EQ(traction(), 8.0);
  }
  begin(0.25);  // of the change before, not of the one that was taken back
  EXPECT_EQ(value(), 5.0);
}

TEST_P(RevertibleDisplacementOf, BeginsAgainWithAPartOfWhatWasTakenBack) {
  begin(0.0);
  step(4.0F);
  displacement_.takeBackForPart();
  EXPECT_EQ(value(), 0.0);
  begin(0.25);
  EXPECT_EQ(value(), 1.0);
}

TEST_P(RevertibleDisplacementOf, KnowsHowFarItsTractionMayBeOff) {
  begin(0.0);
  EXPECT_EQ(displacement_.staleness(), 0.0);
  displacement_.addStaleness(1.0);
  displacement_.noteFresh();
  EXPECT_EQ(displacement_.staleness(), 0.0);
  displacement_.takeBack();  // to where it had not been worked out afresh
  EXPECT_EQ(displacement_.staleness(), GetParam() ? 1.0 : INFINITY);
}

TEST_P(RevertibleDisplacementOf, ComesBackToAPlace) {
  begin(0.0);
  step(4.0F);
  displacement_.addStaleness(0.5);
  auto place = displacement_.place();
  begin(1.0);
  step(1.0F);
  displacement_.goTo(std::move(place));
  EXPECT_EQ(value(), 4.0);
  EXPECT_EQ(traction(), 8.0);
  EXPECT_EQ(displacement_.staleness(), 0.5);
  displacement_.reset();
  EXPECT_EQ(value(), 0.0);
  EXPECT_EQ(displacement_.staleness(), 0.0);
}

}  // namespace
}  // namespace mems_stiction
