#include "roughness/power_spectrum.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/roughness/areal_parameters.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/holed_surfaces.hpp"
#include "surface/gaussian_surface.hpp"
#include "surface/self_affine_surface.hpp"

namespace mems_stiction {
namespace {

void expectRelative(double found, double expected, double tolerance) {
  EXPECT_NEAR(found / expected, 1.0, tolerance) << found << " instead of " << expected;
}

TEST(PowerSpectrum, momentsOfASineAreItsMeanSquares) {
  // z = a sin(k r), wave vector (kx, ky) of any direction: m0 = a^2/2, m2 = a^2 k^2/4, m4 = 3 a^2
  // k^4/16
  const double dx = 3e-9;
  const double dy = 5e-9;
  const double a = 2e-9;
  const HeightMap surface = analytic::sine(75, 101, dx, dy, a, 7, 4);
  const double k = std::hypot(2.0 * kPi * 7 / (101 * dx), 2.0 * kPi * 4 / (75 * dy));
  const SpectralMoments moments = powerSpectrum(surface, SpectrumWindow::kNone).moments;
  expectRelative(moments.m0, 0.5 * a * a, 1e-12);
  expectRelative(moments.m2, 0.25 * a * a * k * k, 1e-12);
  expectRelative(moments.m4, 3.0 / 16.0 * a * a * std::pow(k, 4), 1e-12);
  expectRelative(moments.alpha, 1.5, 1e-12);
}

TEST(PowerSpectrum, momentsOfGaussianSurfacesAreThoseOfTheirAutocorrelation) {
  // m0 = sigma^2, m2 = 2 sigma^2/l^2, m4 = 12 sigma^2/l^4, alpha = 3
  GaussianSurfaceOptions options;
  options.rows = 512;
  options.cols = 600;
  options.pitch_x = 8e-9;
  options.pitch_y = 10e-9;
  options.correlation_length_x = options.correlation_length_y = 60e-9;
  const double l = 60e-9;
  double m0 = 0.0;
  double m2 = 0.0;
  double m4 = 0.0;
  double alpha = 0.0;
  const int seeds = 8;
  for (options.seed = 0; options.seed < seeds; ++options.seed) {
    const SpectralMoments moments =
        powerSpectrum(gaussianSurface(options), SpectrumWindow::kNone).moments;
    m0 += moments.m0 / seeds;
    m2 += moments.m2 / seeds;
    m4 += moments.m4 / seeds;
    alpha += moments.alpha / seeds;
  }
  const double square = options.rms_height * options.rms_height;
  expectRelative(m0, square, 1e-12);  // exact by construction
  // some 1000 independent patches per sample; eight samples
  expectRelative(m2, 2.0 * square / (l * l), 0.02);
  expectRelative(m4, 12.0 * square / std::pow(l, 4), 0.04);
  expectRelative(alpha, 3.0, 0.04);
}

TEST(PowerSpectrum, ringsOfAGaussianSurfaceFollowItsFormula) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 1024;
  const double l = options.correlation_length_x;
  const PowerSpectrum spectrum = powerSpectrum(gaussianSurface(options), SpectrumWindow::kNone);
  int checked = 0;
  for (const SpectrumRing& ring : spectrum.rings) {
    const double q = ring.wave_number;
    if (ring.count < 400 || q * l > 6.0) continue;
    const double formula =
        kPi * l * l * options.rms_height * options.rms_height * std::exp(-0.25 * q * q * l * l);
    // count/2 independent exponential numbers, 4.5 standard deviations
    expectRelative(ring.density, formula, 4.5 * std::sqrt(2.0 / ring.count));
    ++checked;
  }
  EXPECT_GT(checked, 30);
}

TEST(PowerSpectrum, secondMomentIsHalfTheMeanSquareGradient) {
  GaussianSurfaceOptions options;
  options.rows = 300;
  options.cols = 400;
  options.pitch_y = 14e-9;
  options.correlation_length_x = 100e-9;
  options.correlation_length_y = 150e-9;
  const HeightMap surface = gaussianSurface(options);
  const double sdq = arealParameters(surface).sdq;
  // central differences lose up to (pitch/l)^2 = 1 % of the square
  expectRelative(2.0 * powerSpectrum(surface, SpectrumWindow::kNone).moments.m2, sdq * sdq, 0.025);
}

TEST(PowerSpectrum, windowTakesTheJumpAtTheBorderAway) {
  // 7.5 periods: the frame's borders do not fit together.
  const double pitch = 2e-9;
  cv::Mat heights(200, 200, CV_64FC1);
  for (int row = 0; row < 200; ++row) {
    for (int col = 0; col < 200; ++col)
      heights.at<double>(row, col) = 1e-9 * std::sin(2.0 * kPi * 7.5 * col / 200.0);
  }
  const HeightMap surface(heights, pitch, pitch);
  const double k = 2.0 * kPi * 7.5 / (200 * pitch);
  const double m4 = 3.0 / 16.0 * 1e-18 * std::pow(k, 4);
  expectRelative(powerSpectrum(surface, SpectrumWindow::kHann).moments.m4, m4,
                 0.05);  // (1/7.5)^2 of the window's own
  EXPECT_GT(powerSpectrum(surface, SpectrumWindow::kNone).moments.m4, 2.0 * m4);
}

TEST(PowerSpectrum, doesNotDependOnOffsetPrecisionOrASingleHole) {
  GaussianSurfaceOptions options;
  options.rows = 128;
  options.cols = 96;
  const HeightMap surface = gaussianSurface(options);
  const SpectralMoments moments = powerSpectrum(surface, SpectrumWindow::kHann).moments;
  const HeightMap lifted(surface.heights() + 1e-3, surface.pitchX(), surface.pitchY());
  expectRelative(powerSpectrum(lifted, SpectrumWindow::kHann).moments.m4, moments.m4, 1e-6);
  const HeightMap holed = analytic::withInvalidPixel(surface, 10, 90);
  expectRelative(powerSpectrum(holed, SpectrumWindow::kHann).moments.m0, moments.m0, 1e-3);
}

/// Missing pixels as zeros spread power over all waves: H fell from 0.80 to 0.65, m4 rose up to 190
/// times.
TEST(PowerSpectrum, missingPixelsLeaveMomentsSlopeAndShortestWaves) {
  SelfAffineSurfaceOptions options;
  options.rows = options.cols = 512;
  options.hurst_exponent = 0.8;
  options.cutoff_wavelength = 2.0 * options.pitch_x;
  const HeightMap surface = selfAffineSurface(options);
  const double pitch = surface.pitchX();
  const auto hurst = [&](const PowerSpectrum& spectrum) {
    return fitHurstExponent(spectrum, 8.0 * pitch, 128.0 * pitch).hurst_exponent;
  };
  const PowerSpectrum whole = powerSpectrum(surface, SpectrumWindow::kHann);
  for (const double share : {0.01, 0.05}) {
    for (const HeightMap& holed :
         {withScatteredHoles(surface, share, 1), withRoundHoles(surface, share, 2)}) {
      const PowerSpectrum found = powerSpectrum(holed, SpectrumWindow::kHann);
      EXPECT_NEAR(hurst(found), hurst(whole), 0.01) << share;
      expectRelative(found.moments.m0, whole.moments.m0, 0.02);
      expectRelative(found.moments.m2, whole.moments.m2, 0.02);
      expectRelative(found.moments.m4, whole.moments.m4, 0.04);
      expectRelative(found.rings.back().density, whole.rings.back().density, 0.1);
    }
  }
}

TEST(PowerSpectrum, ofAConstantSurfaceIsZeroAndOfALineIsRefused) {
  const SpectralMoments moments =
      powerSpectrum(analytic::flat(20, 30, 1e-9, 1e-9, 0.1), SpectrumWindow::kHann).moments;
  EXPECT_EQ(moments.m0, 0.0);
  EXPECT_EQ(moments.m4, 0.0);
  EXPECT_EQ(moments.alpha, 0.0);
  EXPECT_THROW(powerSpectrum(analytic::flat(1, 30, 1e-9, 1e-9), SpectrumWindow::kNone),
               SurfaceError);
}

TEST(HurstFit, readsAPowerLawBack) {
  PowerSpectrum spectrum;
  for (int index = 1; index < 60; ++index) {
    const double q = 1e7 * index;
    spectrum.rings.push_back({q, 3e-30 * std::pow(q / 1e7, -2.0 - 2.0 * 0.7), index});
  }
  const HurstFit fit = fitHurstExponent(spectrum, 2.0 * kPi / 5e8, 2.0 * kPi / 3e7);
  EXPECT_NEAR(fit.hurst_exponent, 0.7, 1e-12);
  EXPECT_EQ(fit.rings, 48);
}

TEST(HurstFit, namesTheRangeThatTheSpectrumHas) {
  const PowerSpectrum spectrum =
      powerSpectrum(gaussianSurface(GaussianSurfaceOptions()), SpectrumWindow::kNone);
  EXPECT_THROW(fitHurstExponent(spectrum, 1e-7, 1e-8), OptionsError);
  try {
    fitHurstExponent(spectrum, 1e-10, 2e-10);
    FAIL() << "a range without a ring was accepted";
  } catch (const SurfaceError& error) {
    EXPECT_NE(std::string(error.what()).find("the spectrum has wavelengths of"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace mems_stiction
