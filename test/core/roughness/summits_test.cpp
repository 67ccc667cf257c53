#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "numeric/constants.hpp"
#include "roughness/power_spectrum.hpp"
#include "roughness/summits.hpp"
#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

/// What the formulas of summits.hpp say for the given moments; rms_height = sqrt(m0 (1 -
/// 0.8968/alpha)) (Bush, Gibson, Keogh, Mech. Res. Comm. 3 (1976) 169). `count` is 0. All 0 for a
/// constant surface.
SummitParameters summitsOfGaussianSurface(const SpectralMoments& moments) {
  SummitParameters expected;
  if (!(moments.m2 > 0.0)) return expected;
  expected.density = moments.m4 / moments.m2 / (6.0 * kPi * std::sqrt(3.0));
  expected.mean_curvature = 8.0 / 3.0 * std::sqrt(moments.m4 / kPi);
  expected.mean_radius = 1.0 / expected.mean_curvature;
  expected.rms_height = std::sqrt(moments.m0 * std::max(0.0, 1.0 - 0.8968 / moments.alpha));
  return expected;
}

TEST(Summits, ofAParaboloidAreOneOfItsRadius) {
  const HeightMap surface = analytic::paraboloid(41, 31, 5e-9, 8e-9, 300e-9);
  const SummitParameters found = summitParameters(surface);
  EXPECT_EQ(found.count, 1);
  EXPECT_NEAR(found.mean_radius, 300e-9, 1e-15);
  EXPECT_NEAR(found.density, 1.0 / (39 * 29 * 5e-9 * 8e-9), 1e3);
  EXPECT_EQ(found.rms_height, 0.0);
}

TEST(Summits, betweenTwoPixelsIsOneAllTheSame) {
  EXPECT_EQ(summitParameters(analytic::paraboloid(40, 30, 5e-9, 8e-9, 300e-9)).count, 1);
  EXPECT_EQ(summitParameters(analytic::flat(40, 30, 5e-9, 8e-9)).count, 0);
}

TEST(Summits, ofTwoRadiiHaveTheMeanOfTheirCurvatures) {
  const HeightMap surface = analytic::sphereArray(42, 84, 5e-9, 5e-9, {200e-9, 400e-9}, 4, 2);
  const SummitParameters found = summitParameters(surface);
  EXPECT_EQ(found.count, 8);
  EXPECT_NEAR(found.mean_curvature, 0.5 * (1.0 / 200e-9 + 1.0 / 400e-9), 1.0);
}

TEST(Summits, besideInvalidPixelsAreNotCounted) {
  const HeightMap surface = analytic::paraboloid(41, 31, 5e-9, 5e-9, 300e-9);
  const SummitParameters found = summitParameters(analytic::withInvalidPixel(surface, 20, 16));
  EXPECT_EQ(found.count, 0);
  EXPECT_EQ(found.mean_radius, 0.0);
}

TEST(Summits, ofGaussianSurfacesAreThoseOfRandomProcessTheory) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 1024;
  options.pitch_x = options.pitch_y = 5e-9;
  options.correlation_length_x = options.correlation_length_y = 80e-9;  // 16 pixels
  const double square = options.rms_height * options.rms_height;
  const SpectralMoments moments{square, 2.0 * square / std::pow(80e-9, 2),
                                12.0 * square / std::pow(80e-9, 4), 3.0};
  const SummitParameters expected = summitsOfGaussianSurface(moments);
  // m4/m2 = 6/l^2: density 6/(6 pi sqrt 3 l^2)
  EXPECT_NEAR(expected.density * 80e-9 * 80e-9, 1.0 / (kPi * std::sqrt(3.0)), 1e-12);
  const SummitParameters found = summitParameters(gaussianSurface(options));
  // 750 summits: 4 % by number, half of it by regular spacing; pixels of l/16 cost a few per cent
  // of the curvature
  EXPECT_NEAR(found.density / expected.density, 1.0, 0.07);
  EXPECT_NEAR(found.mean_curvature / expected.mean_curvature, 1.0, 0.07);
  EXPECT_NEAR(found.mean_radius / expected.mean_radius, 1.0, 0.07);
  EXPECT_NEAR(found.rms_height / expected.rms_height, 1.0, 0.1);
}

}  // namespace
}  // namespace mems_stiction
