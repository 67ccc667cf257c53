/// Frames that took too many steps: soft ones, whose contacts close pixel by pixel, and those near bonding. Products are
/// counted, not timed: they are the same on every machine.

#include <gtest/gtest.h>

#include "mems_stiction/half_space/half_space_solver.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

HalfSpaceProblem gaussian(int size, double correlation_length, double rms_height, int seed = 1) {
  GaussianSurfaceOptions surface;
  surface.rows = surface.cols = size;
  surface.pitch_x = surface.pitch_y = 5e-9;
  surface.correlation_length_x = surface.correlation_length_y = correlation_length;
  surface.rms_height = rms_height;
  surface.seed = seed;
  HalfSpaceProblem problem;
  problem.surfaces.lower = gaussianSurface(surface);
  return problem;
}

TEST(HardFrames, SoftSurfacesThatCloseInOneJumpAreSolvedAndCalledUnresolved) {
  HalfSpaceProblem problem = gaussian(48, 100e-9, 1e-9);
  problem.lower_material.youngs_modulus = problem.upper_material.youngs_modulus = 0.3e9;
  HalfSpaceOptions options;
  options.flow = false;
  const SolvedHalfSpace solution = HalfSpaceSolver(options).solve(problem);
  EXPECT_EQ(solution.status, HalfSpaceStatus::kSolved) << solution.message;
  EXPECT_TRUE(solution.is_converged);
  EXPECT_FALSE(solution.is_resolved);
  EXPECT_GT(solution.hysteresis, 0.0);
}

TEST(HardFrames, FewSmallContactsTakeFewProducts) {
  const SolvedHalfSpace solution = HalfSpaceSolver(HalfSpaceOptions()).solve(gaussian(512, 100e-9, 3e-9));
  ASSERT_EQ(solution.status, HalfSpaceStatus::kSolved) << solution.message;
  EXPECT_LT(solution.products, 60);  // 49; 275 by Newton's method on the whole frame
}

TEST(HardFrames, LargerFramesTakeNoMoreProductsForTheirContacts) {
  const SolvedHalfSpace solution = HalfSpaceSolver(HalfSpaceOptions()).solve(gaussian(1024, 100e-9, 3e-9));
  ASSERT_EQ(solution.status, HalfSpaceStatus::kSolved) << solution.message;
  // 76 for five times the contacts of the frame above; 459 by Newton's method on the whole frame
  EXPECT_LT(solution.products, 95);
}

TEST(HardFrames, NearBondingTakesFewProducts) {
  const SolvedHalfSpace solution = HalfSpaceSolver(HalfSpaceOptions()).solve(gaussian(256, 300e-9, 1e-9));
  ASSERT_EQ(solution.status, HalfSpaceStatus::kSolved) << solution.message;
  EXPECT_LT(solution.products, 2700);  // 2142; 4641 with (K + shift)^-1 alone
  EXPECT_TRUE(solution.is_step_converged);
}

TEST(HardFrames, NoStepGoesOverTheJumpThatEndsTheBranchOfTheLargestForce) {
  const SolvedHalfSpace solution = HalfSpaceSolver(HalfSpaceOptions()).solve(gaussian(256, 300e-9, 1e-9, 3));
  ASSERT_EQ(solution.status, HalfSpaceStatus::kSolved) << solution.message;
  // with an eighth of the step; 16.3 uN where a step met a lower branch with the mean of its ends by chance
  EXPECT_NEAR(solution.pull_off_force / 17.796e-6, 1.0, 0.02);
}

}  // namespace
}  // namespace mems_stiction
