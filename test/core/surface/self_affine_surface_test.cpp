#include "surface/self_affine_surface.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/roughness/areal_parameters.hpp"
#include "numeric/constants.hpp"
#include "roughness/power_spectrum.hpp"

namespace mems_stiction {
namespace {

TEST(SelfAffineSurface, hasTheHurstExponentThatWasAskedFor) {
  SelfAffineSurfaceOptions options;
  options.rows = 700;
  options.cols = 900;
  options.pitch_x = 6e-9;
  options.pitch_y = 9e-9;
  for (const double hurst : {0.3, 0.8, 1.0}) {
    options.hurst_exponent = hurst;
    const PowerSpectrum spectrum = powerSpectrum(selfAffineSurface(options), SpectrumWindow::kNone);
    const HurstFit fit = fitHurstExponent(spectrum, 45e-9, 900e-9);
    EXPECT_NEAR(fit.hurst_exponent, hurst, 0.02);  // 10^4 waves: the fit's own error is 0.005
  }
}

TEST(SelfAffineSurface, isFlatInItsSpectrumBeforeTheRollOffAndEmptyBeyondTheCutOff) {
  SelfAffineSurfaceOptions options;
  options.rows = options.cols = 1024;
  const PowerSpectrum spectrum = powerSpectrum(selfAffineSurface(options), SpectrumWindow::kNone);
  const double plateau = spectrum.rings[6].density;
  for (const SpectrumRing& ring : spectrum.rings) {
    if (ring.wave_number > 2.0 * kPi / (options.cutoff_wavelength * 0.98)) {
      EXPECT_LT(ring.density, 1e-12 * plateau);
    } else if (ring.count > 20 &&
               ring.wave_number < 2.0 * kPi / (options.rolloff_wavelength * 1.1)) {
      EXPECT_NEAR(ring.density / plateau, 1.0, 1.5);  // few waves
    }
  }
}

TEST(SelfAffineSurface, rmsHeightOrSlopeAreExact) {
  SelfAffineSurfaceOptions options;
  options.rms_height = 4e-9;
  EXPECT_NEAR(heightStatistics(selfAffineSurface(options)).rms_height, 4e-9, 1e-20);
  EXPECT_NEAR(heightStatistics(selfAffineSurface(options)).mean, 0.0, 1e-20);
  options.scale = RoughnessScale::kRmsSlope;
  options.rms_slope = 0.07;
  options.cutoff_wavelength = 200e-9;  // 20 pixels: central differences see the slope
  const HeightMap surface = selfAffineSurface(options);
  EXPECT_NEAR(std::sqrt(2.0 * powerSpectrum(surface, SpectrumWindow::kNone).moments.m2), 0.07,
              1e-12);
  EXPECT_NEAR(arealParameters(surface).sdq, 0.07, 0.01 * 0.07 * 2.0);
}

TEST(SelfAffineSurface, isTheSameForTheSameSeedOnly) {
  SelfAffineSurfaceOptions options;
  options.rows = options.cols = 128;
  const cv::Mat first = selfAffineSurface(options).heights();
  EXPECT_EQ(cv::countNonZero(first != selfAffineSurface(options).heights()), 0);
  options.seed = 2;
  EXPECT_GT(cv::countNonZero(first != selfAffineSurface(options).heights()), 16000);
}

TEST(SelfAffineSurface, refusesWhatTheGridCannotDraw) {
  SelfAffineSurfaceOptions options;
  options.cutoff_wavelength = 15e-9;   // below two pitches
  options.rolloff_wavelength = 10e-6;  // beyond the frame
  options.hurst_exponent = 1.5;
  try {
    selfAffineSurface(options);
    FAIL() << "was accepted";
  } catch (const OptionsError& error) {
    ASSERT_EQ(error.violations().size(), 3u);
    EXPECT_NE(error.violations()[0].find("self_affine/hurst_exponent: 1.5"), std::string::npos);
  }
}

}  // namespace
}  // namespace mems_stiction
