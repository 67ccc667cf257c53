/// The half-space on what instruments measured. The folder is named by the environment variable
/// MEMS_STICTION_SCANS.

#include <cmath>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "mems_stiction/half_space/half_space_solver.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "preprocess/level.hpp"

namespace mems_stiction {
namespace {

constexpr int kPart = 128;  // pixels

/// The middle of a scan, a plane removed.
HeightMap middleOf(const std::string& file) {
  const HeightMap whole = openScanFile(file).surface;
  const cv::Rect part((whole.cols() - kPart) / 2, (whole.rows() - kPart) / 2, kPart, kPart);
  return levelled(HeightMap(whole.heights()(part).clone(), whole.pitchX(), whole.pitchY()));
}

TEST(MeasuredScans, AreSolvedWithinWhatTheLawAllows) {
  const char* const folder = std::getenv("MEMS_STICTION_SCANS");
  if (folder == nullptr || *folder == '\0')
    GTEST_SKIP() << "MEMS_STICTION_SCANS is not set to a folder of vendor scans";
  for (const char* const name : {"di-3.di", "di-5.di", "di-6.di", "top-1.top", "example_ps.tiff"}) {
    SCOPED_TRACE(name);
    HalfSpaceProblem problem;
    problem.surfaces.lower = middleOf(std::string(folder) + "/" + name);
    const double work = problem.interface.work_of_adhesion;
    HalfSpaceOptions options;
    const SolvedHalfSpace usual = HalfSpaceSolver(options).solve(problem);
    ASSERT_EQ(usual.status, HalfSpaceStatus::kSolved) << usual.message;
    EXPECT_TRUE(usual.is_converged);
    EXPECT_GT(usual.pull_off_force, 0.0);
    const double area = kPart * kPart * problem.surfaces.lower.cellArea();
    EXPECT_LT(usual.pull_off_force,
              1.026 * work / usual.range * area);  // the largest traction everywhere
    EXPECT_GT(usual.work_of_adhesion, 0.0);
    EXPECT_LE(usual.work_of_adhesion, work);
    EXPECT_GE(usual.hysteresis,
              -1e-3 * usual.work_of_adhesion);  // a cycle gains nothing but for the residual
    options.step *= 0.5;
    const SolvedHalfSpace half = HalfSpaceSolver(options).solve(problem);
    ASSERT_EQ(half.status, HalfSpaceStatus::kSolved) << half.message;
    EXPECT_NEAR(half.pull_off_force / usual.pull_off_force, 1.0, 0.02);
    EXPECT_NEAR(half.work_of_adhesion / usual.work_of_adhesion, 1.0, 0.03);
  }
}

}  // namespace
}  // namespace mems_stiction
