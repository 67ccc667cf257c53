#include "preprocess/low_pass.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "height_map/validity.hpp"
#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

LowPassOptions at(double cutoff_wavelength) {
  LowPassOptions options;
  options.cutoff_wavelength = cutoff_wavelength;
  return options;
}

TEST(LowPass, halvesASineOfTheCutoffWavelength) {
  // 20 periods of 300 columns: 15 pixels each. Along y 12 periods of 240 rows. dx != dy.
  const double dx = 4e-9;
  const double dy = 7e-9;
  const HeightMap along_x = analytic::sine(60, 300, dx, dy, 1e-9, 20, 0);
  const HeightMap along_y = analytic::sine(240, 60, dx, dy, 1e-9, 0, 12);
  const HeightMap low_x = lowPassed(along_x, at(15 * dx));
  const HeightMap low_y = lowPassed(along_y, at(20 * dy));
  // Beyond 4 cut-off wavelengths from the border nothing of it is left. Weights cut off at 1e-6.
  for (int index = 80; index < 100; ++index) {
    EXPECT_NEAR(low_x.height(30, index), 0.5 * along_x.height(30, index), 1e-5 * 1e-9);
    EXPECT_NEAR(low_y.height(index, 30), 0.5 * along_y.height(index, 30), 1e-5 * 1e-9);
  }
}

TEST(LowPass, transmitsOtherWavelengthsAsTheStandardSays) {
  const HeightMap wave = analytic::sine(40, 400, 5e-9, 5e-9, 1e-9, 20, 0);  // 100 nm
  const HeightMap low = lowPassed(wave, at(50e-9));                         // 2^-(1/4)
  EXPECT_NEAR(low.height(20, 205) / wave.height(20, 205), std::pow(2.0, -0.25), 1e-5);
}

TEST(LowPass, keepsConstantsUpToTheBorderAndAroundHoles) {
  HeightMap surface = analytic::withInvalidPixel(analytic::flat(30, 41, 5e-9, 8e-9, 2e-3), 10, 10);
  surface = analytic::withInvalidPixel(surface, 0, 0);
  const HeightMap low = lowPassed(surface, at(60e-9));
  EXPECT_EQ(heightStatistics(low).valid_count, 30 * 41 - 2);
  EXPECT_TRUE(std::isnan(low.height(10, 10)));
  EXPECT_NEAR(heightStatistics(low).max, 2e-3, 1e-17);
  EXPECT_NEAR(heightStatistics(low).min, 2e-3, 1e-17);
}

TEST(LowPass, aHoleDoesNotPullItsSurroundings) {
  const HeightMap wave = analytic::sine(80, 80, 5e-9, 5e-9, 1e-9, 1, 1);
  const HeightMap low = lowPassed(wave, at(30e-9));
  const HeightMap holed = lowPassed(analytic::withInvalidPixel(wave, 40, 20), at(30e-9));
  // One of some 20 pixels that count is missing; the others stand for it, up to the slope between
  // them.
  EXPECT_NEAR(holed.height(40, 21), low.height(40, 21), 0.01e-9);
}

TEST(LowPass, cutoffBelowThePitchChangesNothingAndBeyondTheFrameGivesTheMean) {
  GaussianSurfaceOptions options;
  options.rows = 64;
  options.cols = 90;
  const HeightMap surface = gaussianSurface(options);
  double largest = 0.0;
  cv::minMaxLoc(cv::abs(lowPassed(surface, at(5e-9)).heights() - surface.heights()), nullptr,
                &largest);
  EXPECT_LT(largest, 1e-20);
  EXPECT_LT(heightStatistics(lowPassed(surface, at(1.0))).rms_height, 1e-15);
}

}  // namespace
}  // namespace mems_stiction
