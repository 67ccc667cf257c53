/// A sphere on a flat under the 9-3 law, from stiff and small to soft and large.

#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/jkr.hpp"
#include "mechanics/transition.hpp"
#include "mems_stiction/half_space/half_space_solver.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/half_space_cases.hpp"
#include "support/reference_contacts.hpp"

namespace mems_stiction {
namespace {

constexpr double kRadius = 50e-9;
constexpr double kWork = 0.05;
constexpr double kRange = 1.608e-10;

/// Contact modulus that gives Tabor's parameter.
double modulusOf(double tabor) {
  return std::sqrt(kRadius * kWork * kWork / std::pow(tabor * kRange, 3.0));
}

/// Over pi Gamma R.
double pullOff(double tabor, int pixels, double pitch) {
  const HalfSpaceProblem problem = half_space_cases::onRigidPlane(
      analytic::paraboloid(pixels, pixels, pitch, pitch, kRadius), modulusOf(tabor), kWork);
  const HalfSpaceOptions options = half_space_cases::elastic(kRange);
  const SolvedHalfSpace solution = HalfSpaceSolver(options).solve(problem);
  EXPECT_EQ(solution.status, HalfSpaceStatus::kSolved) << solution.message;
  EXPECT_TRUE(solution.is_resolved);
  return solution.pull_off_force / (kPi * kWork * kRadius);
}

TEST(SpherePullOff, StiffSphereIsBradleys) {
  // 2 at Tabor's parameter 0; Maugis' exact value at 0.05 is within 1 % of it. Attraction beyond
  // the frame of 32 nm: 1 %
  const double maugis = maugis::pullOffPrefactor(maugis::transitionParameter(0.05));
  EXPECT_NEAR(pullOff(0.05, 64, 0.5e-9) / maugis, 1.0, 0.02);
}

TEST(SpherePullOff, FallsFromBradleysToJohnsonKendallAndRoberts) {
  // values of an independent solver of the same equations, about 2 % for pitch and step
  const struct {
    double tabor;
    double pull_off;
  } known[] = {{0.16, 1.94}, {0.32, 1.86}, {0.67, 1.73}, {1.06, 1.67}, {1.96, 1.60}};
  double last = 2.0;
  for (const auto& point : known) {
    const double found = pullOff(point.tabor, 128, 0.5e-9);
    EXPECT_NEAR(found / point.pull_off, 1.0, 0.02) << point.tabor;
    EXPECT_LT(found, last);
    last = found;
  }
}

TEST(SpherePullOff, SoftSphereIsJohnsonKendallAndRoberts) {
  // the limit is 1.5; at Tabor's parameter 3 it is neared from above, by 5.5 % under this law
  EXPECT_NEAR(pullOff(3.0, 128, 0.26e-9) / 1.5, 1.055, 0.02);
}

TEST(SpherePullOff, ConvergesWithThePitch) {
  const double coarse = pullOff(0.67, 32, 2e-9);
  const double middle = pullOff(0.67, 64, 1e-9);
  const double fine = pullOff(0.67, 128, 0.5e-9);
  EXPECT_LT(std::abs(fine - middle), std::abs(middle - coarse));
  EXPECT_NEAR(fine / middle, 1.0, 0.01);
}

}  // namespace
}  // namespace mems_stiction
