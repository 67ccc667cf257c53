#include "surface/counter_surface.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "support/analytic_surfaces.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitchX = 10e-9;
constexpr double kPitchY = 25e-9;

HeightMap unsymmetrical() {
  return analytic::sum(analytic::paraboloid(6, 9, kPitchX, kPitchY, 1e-6, 15e-9, -20e-9),
                       analytic::tiltedPlane(6, 9, kPitchX, kPitchY, 0.1, 0.2));
}

TEST(CounterSurface, facingDownIsTakenAsItIs) {
  const HeightMap measured = unsymmetrical();
  const HeightMap mounted = mountedCounterSurface(measured, CounterSurfaceFacing::kDown);
  EXPECT_EQ(mounted.heights().data, measured.heights().data);  // shared, not copied
}

TEST(CounterSurface, facingUpIsTurnedOverAboutItsYAxis) {
  const HeightMap measured = unsymmetrical();
  const HeightMap mounted = mountedCounterSurface(measured, CounterSurfaceFacing::kUp);
  ASSERT_EQ(mounted.rows(), measured.rows());
  ASSERT_EQ(mounted.cols(), measured.cols());
  EXPECT_EQ(mounted.pitchX(), kPitchX);
  EXPECT_EQ(mounted.pitchY(), kPitchY);
  for (int row = 0; row < measured.rows(); ++row) {
    for (int col = 0; col < measured.cols(); ++col) {
      EXPECT_EQ(mounted.height(row, col), -measured.height(row, measured.cols() - 1 - col));
    }
  }
}

TEST(CounterSurface, turningOverTwiceGivesItBack) {
  for (const HeightMap& measured : {unsymmetrical(), analytic::asSingle(unsymmetrical())}) {
    const HeightMap once = mountedCounterSurface(measured, CounterSurfaceFacing::kUp);
    const HeightMap twice = mountedCounterSurface(once, CounterSurfaceFacing::kUp);
    EXPECT_EQ(twice.heights().type(), measured.heights().type());
    EXPECT_EQ(cv::norm(twice.heights(), measured.heights(), cv::NORM_INF), 0.0);
  }
}

TEST(CounterSurface, turningOverLeavesTheMeasurementAloneAndMovesItsInvalidPixels) {
  const HeightMap measured = analytic::withInvalidPixel(unsymmetrical(), 2, 1);
  const double before = measured.height(0, 0);
  const HeightMap mounted = mountedCounterSurface(measured, CounterSurfaceFacing::kUp);
  EXPECT_EQ(measured.height(0, 0), before);
  EXPECT_TRUE(std::isnan(mounted.height(2, measured.cols() - 2)));
  EXPECT_FALSE(std::isnan(mounted.height(2, 1)));
}

TEST(CounterSurface, aMeasuredPeakPointsTowardsTheLowerSurface) {
  // the apex of a cap is its highest point as measured and its lowest when mounted
  const HeightMap cap = analytic::paraboloid(7, 9, kPitchX, kPitchY, 1e-6);
  const HeightMap mounted = mountedCounterSurface(cap, CounterSurfaceFacing::kUp);
  EXPECT_EQ(heightStatistics(mounted).min, 0.0);
  EXPECT_EQ(mounted.height(3, 4), 0.0);
}

TEST(CounterSurfaceOptions, defaultsAreValid) {
  CounterSurfaceOptions options;
  OptionValidator validator;
  options.describe(validator);
  EXPECT_TRUE(validator.violations().empty());
  EXPECT_EQ(options.type, CounterSurfaceType::kFlat);
  EXPECT_EQ(options.facing, CounterSurfaceFacing::kUnstated) << "what a measured one must say";
}

}  // namespace
}  // namespace mems_stiction
