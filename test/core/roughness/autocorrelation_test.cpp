#include "roughness/autocorrelation.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

GaussianSurfaceOptions anisotropic() {
  GaussianSurfaceOptions options;
  options.rows = 700;
  options.cols = 900;
  options.pitch_x = 5e-9;
  options.pitch_y = 8e-9;
  options.correlation_length_x = 60e-9;
  options.correlation_length_y = 120e-9;
  options.seed = 2;
  return options;
}

/// Direct sum over pairs of valid pixels.
double pairMean(const HeightMap& surface, int row_lag, int col_lag) {
  const double mean = heightStatistics(surface).mean;
  double products = 0.0;
  int pairs = 0;
  for (int row = 0; row + row_lag < surface.rows(); ++row) {
    for (int col = 0; col + col_lag < surface.cols(); ++col) {
      const double product =
          (surface.height(row, col) - mean) * (surface.height(row + row_lag, col + col_lag) - mean);
      if (!std::isfinite(product)) continue;
      products += product;
      ++pairs;
    }
  }
  return products / pairs;
}

TEST(Autocorrelation, isTheMeanOverPairsOfValidPixels) {
  GaussianSurfaceOptions options;
  options.rows = 33;
  options.cols = 46;
  const HeightMap surface = analytic::withInvalidPixel(gaussianSurface(options), 10, 12);
  const cv::Mat acf = autocorrelation(surface);
  ASSERT_EQ(acf.size(), cv::Size(47, 33));
  EXPECT_NEAR(acf.at<double>(16, 23), 1.0, 1e-12);
  for (const auto& [row, col] : {std::pair{0, 1}, {3, 5}, {16, 0}, {7, 23}}) {
    EXPECT_NEAR(acf.at<double>(16 + row, 23 + col),
                pairMean(surface, row, col) / pairMean(surface, 0, 0), 1e-12);
    EXPECT_NEAR(acf.at<double>(16 - row, 23 - col), acf.at<double>(16 + row, 23 + col), 1e-12);
  }
}

TEST(Autocorrelation, ofAPeriodicSineIsACosine) {
  const cv::Mat acf =
      autocorrelation(analytic::sine(30, 40, 2e-9, 3e-9, 1e-9, 4), FrameBoundary::kPeriodic);
  for (int lag = -20; lag <= 20; ++lag) {
    EXPECT_NEAR(acf.at<double>(15, 20 + lag), std::cos(2.0 * kPi * lag / 10.0), 1e-12);
    EXPECT_NEAR(acf.at<double>(0, 20 + lag), std::cos(2.0 * kPi * lag / 10.0), 1e-12);
  }
}

TEST(SpatialParameters, ofAGaussianSurfaceAreThoseOfItsFormula) {
  // exp(-x^2/l^2) = 0.2 at x = l sqrt(ln 5) = 1.2686 l
  const GaussianSurfaceOptions options = anisotropic();
  const double reach = std::sqrt(std::log(5.0));
  for (const FrameBoundary boundary : {FrameBoundary::kOpen, FrameBoundary::kPeriodic}) {
    const SpatialParameters found = spatialParameters(gaussianSurface(options), boundary);
    // the sample's autocorrelation scatters by 0.02; its slope at 0.2 is 0.5/l: 4 % of l, two of
    // them for the extremes
    EXPECT_NEAR(found.sal, 60e-9 * reach, 0.08 * 60e-9 * reach);
    EXPECT_NEAR(found.longest, 120e-9 * reach, 0.08 * 120e-9 * reach);
    EXPECT_NEAR(found.str, 0.5, 0.06);
    EXPECT_TRUE(found.decayed);
  }
}

TEST(SpatialParameters, ofASineAreALayThatDoesNotDecay) {
  // cos(2 pi x/L) = 0.2 at x = 0.2180 L; along y it never falls
  const double pitch = 2e-9;
  const SpatialParameters found =
      spatialParameters(analytic::sine(80, 400, pitch, pitch, 1e-9, 4), FrameBoundary::kPeriodic);
  const double wavelength = 100 * pitch;
  // straight lines between pixels of a hundredth of the wavelength: (2 pi/100)^2/8
  EXPECT_NEAR(found.sal, std::acos(0.2) / (2.0 * kPi) * wavelength, 1e-3 * wavelength);
  EXPECT_FALSE(found.decayed);
  // within the frame's 80 nm; the lay itself would give 0
  EXPECT_LT(found.str, 0.55);
}

TEST(SpatialParameters, holesDoNotBiasThem) {
  const GaussianSurfaceOptions options = anisotropic();
  const HeightMap whole = gaussianSurface(options);
  cv::Mat heights = whole.heights().clone();
  for (int hole = 0; hole < 40; ++hole) {
    heights(cv::Rect(20 * hole, (37 * hole) % 660, 20, 30))
        .setTo(std::numeric_limits<double>::quiet_NaN());
  }
  const SpatialParameters found =
      spatialParameters(HeightMap(heights, options.pitch_x, options.pitch_y));
  EXPECT_NEAR(found.sal, spatialParameters(whole).sal,
              0.02 * found.sal);  // 4 % of the pixels are gone
}

TEST(SpatialParameters, ofAConstantSurfaceAreZeroAndABadLevelIsRefused) {
  const HeightMap flat = analytic::flat(20, 30, 1e-9, 1e-9, 0.0123);
  EXPECT_EQ(spatialParameters(flat).sal, 0.0);
  EXPECT_EQ(spatialParameters(flat).str, 0.0);
  EXPECT_THROW(spatialParameters(flat, FrameBoundary::kOpen, 1.0), OptionsError);
}

}  // namespace
}  // namespace mems_stiction
