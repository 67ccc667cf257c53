/// The force between two states.

#include "half_space/force_step.hpp"

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

ForcePoint pointOf(double height, double force, double energy) {
  ForcePoint point;
  point.height = height;
  point.force = force;
  point.energy = energy;
  return point;
}

/// Of the force 3 - (h - summit)^2, between heights 1 and 3.
StepParabola aboutSummit(double summit) {
  const auto at = [&](double height) {
    const double from = height - summit;
    return pointOf(height, 3.0 - from * from, 3.0 * height - from * from * from / 3.0);
  };
  return StepParabola(at(1.0), at(3.0));
}

TEST(StepParabola, IsTheParabolaThatItsEndsAndItsWorkAreOf) {
  const StepParabola parabola = aboutSummit(1.5);
  EXPECT_NEAR(parabola.at(0.5), 2.75, 1e-12);                        // at 2
  EXPECT_NEAR(2.0 * parabola.workTo(0.5), 2.75 + 1.0 / 6.0, 1e-12);  // 3 - (0.125 + 0.125)/3
}

TEST(StepParabola, IsHighestAtItsSummitOrAtAnEnd) {
  EXPECT_NEAR(aboutSummit(1.5).summit(), 0.25, 1e-12);
  EXPECT_EQ(aboutSummit(0.5).summit(), 0.0);
  EXPECT_EQ(aboutSummit(4.0).summit(), 1.0);
  // a dale is highest at an end
  EXPECT_EQ(StepParabola(pointOf(0.0, 1.0, 0.0), pointOf(1.0, 2.0, 0.5)).summit(), 1.0);
  EXPECT_EQ(StepParabola(pointOf(0.0, 2.0, 0.0), pointOf(1.0, 1.0, 0.5)).summit(), 0.0);
}

TEST(StepParabola, SagIsWhatALineWouldMiss) {
  EXPECT_NEAR(aboutSummit(2.0).curvatureError(), 2.0 / 3.0,
              1e-12);  // the mean of 3 - x^2 over [-1, 1] is 8/3, that of its ends 2
}

}  // namespace
}  // namespace mems_stiction
