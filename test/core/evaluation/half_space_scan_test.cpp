/// What the half-space is asked about a prepared scan, and its contact map on the scan's own
/// pixels.

#include "mems_stiction/evaluation/half_space_scan.hpp"

#include <gtest/gtest.h>

#include "mems_stiction/half_space/half_space_solver.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

constexpr int kSide = 48;
constexpr double kPitch = 5e-9;

HeightMap roughSurface() {
  GaussianSurfaceOptions options;
  options.rows = options.cols = kSide;
  options.pitch_x = options.pitch_y = kPitch;
  options.correlation_length_x = options.correlation_length_y = 30e-9;
  options.rms_height = 2e-9;
  return gaussianSurface(options);
}

Configuration configuration() {
  Configuration configuration;
  configuration.model.load.mechanical_load = 1e-6;
  return configuration;
}

int cellsOf(const cv::Mat& map, Regime regime) {
  return cv::countNonZero(map == static_cast<int>(regime));
}

TEST(HalfSpaceScan, TheMapShowsTheContactArea) {
  const Configuration settings = configuration();
  const PreparedScan prepared = ScanPreparer(settings).prepare(roughSurface());
  const HalfSpaceProblem problem = halfSpaceProblem(prepared, settings.model);
  const SolvedHalfSpace solved = HalfSpaceSolver(settings.half_space).solve(problem);
  ASSERT_EQ(solved.status, HalfSpaceStatus::kSolved) << solved.message;
  const cv::Mat map =
      halfSpaceContactMap(solved, problem, settings.half_space, prepared.refinement);
  EXPECT_EQ(map.size(), cv::Size(kSide, kSide));
  const int cells = cv::countNonZero(map);
  EXPECT_GT(cells, 0);
  EXPECT_NEAR(cells * kPitch * kPitch, solved.contact_area,
              1e-9 * solved.contact_area);  // round-off
}

TEST(HalfSpaceScan, CellsAtTheHardnessArePlastic) {
  Configuration settings = configuration();
  settings.model.lower.hardness = 2e9;  // soft: the tops flow
  const PreparedScan prepared = ScanPreparer(settings).prepare(roughSurface());
  const HalfSpaceProblem problem = halfSpaceProblem(prepared, settings.model);
  const SolvedHalfSpace soft = HalfSpaceSolver(settings.half_space).solve(problem);
  ASSERT_GT(soft.flowed_volume, 0.0) << soft.message;
  const cv::Mat map = halfSpaceContactMap(soft, problem, settings.half_space, prepared.refinement);
  EXPECT_GT(cellsOf(map, Regime::kPlastic), 0);
  EXPECT_EQ(cellsOf(map, Regime::kElastoPlastic), 0);
  settings.half_space.flow = false;
  const SolvedHalfSpace elastic = HalfSpaceSolver(settings.half_space).solve(problem);
  EXPECT_EQ(
      cellsOf(halfSpaceContactMap(elastic, problem, settings.half_space, 1), Regime::kPlastic), 0);
}

TEST(HalfSpaceScan, OfARefinedScanTheMapHasTheScansPixels) {
  Configuration settings = configuration();
  settings.preprocessing.refine.factor = 2;
  const PreparedScan prepared = ScanPreparer(settings).prepare(roughSurface());
  const HalfSpaceProblem problem = halfSpaceProblem(prepared, settings.model);
  const SolvedHalfSpace solved = HalfSpaceSolver(settings.half_space).solve(problem);
  ASSERT_EQ(solved.pressure.rows, 2 * kSide);
  const cv::Mat map =
      halfSpaceContactMap(solved, problem, settings.half_space, prepared.refinement);
  ASSERT_EQ(map.size(), cv::Size(kSide, kSide));
  int touching = 0;
  for (int row = 0; row < kSide; ++row) {
    for (int col = 0; col < kSide; ++col) {
      const cv::Mat pixel = solved.pressure(cv::Rect(2 * col, 2 * row, 2, 2));
      EXPECT_EQ(map.at<std::uint8_t>(row, col) != 0, cv::countNonZero(pixel > 0.0) > 0)
          << row << " " << col;
      touching += map.at<std::uint8_t>(row, col) != 0 ? 1 : 0;
    }
  }
  EXPECT_GT(touching, 0);
}

TEST(HalfSpaceScan, WithoutAStateAtRestThereIsNoMap) {
  EXPECT_TRUE(
      halfSpaceContactMap(SolvedHalfSpace(), HalfSpaceProblem(), HalfSpaceOptions(), 1).empty());
}

}  // namespace
}  // namespace mems_stiction
