#include "roughness/surface_spectrum.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

SurfaceSpectrum selfAffine() {
  SurfaceSpectrum spectrum;
  spectrum.wave_number = {3e5, 1e6, 3e8};
  spectrum.density = {1e-28, 1e-28, 1e-28 * std::pow(300.0, -3.6)};
  return spectrum;
}

TEST(SurfaceSpectrum, isFlatBelowAPowerLawBetweenAndNothingBeyond) {
  const SurfaceSpectrum spectrum = selfAffine();
  EXPECT_EQ(spectrum.densityAt(1.0), 1e-28);
  EXPECT_EQ(spectrum.densityAt(1e6), 1e-28);
  EXPECT_NEAR(spectrum.densityAt(1e7) / (1e-28 * std::pow(10.0, -3.6)), 1.0, 1e-12);
  EXPECT_NEAR(spectrum.densityAt(3e8) / spectrum.density.back(), 1.0, 1e-12);
  EXPECT_EQ(spectrum.densityAt(3.001e8), 0.0);
  EXPECT_EQ(spectrum.densityAt(0.0, 0.0), 0.0);
  EXPECT_EQ(spectrum.densityAt(3e6, 4e6), spectrum.densityAt(5e6));
}

TEST(SurfaceSpectrum, varianceIsTheIntegralOverAllWaves) {
  SurfaceSpectrum spectrum = selfAffine();
  spectrum.wave_number.push_back(4e8);  // C ~ q^-2, where the integral is a logarithm
  spectrum.density.push_back(spectrum.density.back() * std::pow(0.75, 2.0));
  double sum = 0.0;
  constexpr double kStep = 1e-4;
  for (double log_q = std::log(1e2); log_q < std::log(5e8); log_q += kStep) {
    const double q = std::exp(log_q + 0.5 * kStep);
    sum += spectrum.densityAt(q) * q * q * kStep / (2.0 * kPi);
  }
  EXPECT_NEAR(spectrum.variance() / sum, 1.0, 1e-4);
}

TEST(SurfaceSpectrum, stretchMakesWavesAlongItsDirectionLongerAndKeepsTheVariance) {
  SurfaceSpectrum spectrum = selfAffine();
  const double variance = spectrum.variance();
  spectrum.stretch = 4.0;
  spectrum.direction = 0.5;
  EXPECT_EQ(spectrum.variance(), variance);
  const double x = std::cos(0.5);
  const double y = std::sin(0.5);
  // half the length across, twice the length along it
  EXPECT_NEAR(spectrum.densityAt(1e7 * x, 1e7 * y) / spectrum.densityAt(2e7), 1.0, 1e-12);
  EXPECT_NEAR(spectrum.densityAt(-1e7 * y, 1e7 * x) / spectrum.densityAt(5e6), 1.0, 1e-12);
}

TEST(SurfaceSpectrum, saysWhichValuesAreNotAllowed) {
  EXPECT_TRUE(selfAffine().validate().empty());
  SurfaceSpectrum spectrum = selfAffine();
  spectrum.wave_number[1] = 3e5;
  spectrum.density[2] = 0.0;
  spectrum.stretch = 0.5;
  spectrum.direction = NAN;
  const std::vector<std::string> violations = spectrum.validate();
  ASSERT_EQ(violations.size(), 4u);
  EXPECT_EQ(violations[0], "spectrum/density[2]: 0 is not allowed; must be > 0 and finite");
  EXPECT_EQ(
      violations[1],
      "spectrum/wave_number[1]: 300000 is not allowed; must be above the one before it, 300000");
  EXPECT_EQ(violations[2], "spectrum/stretch: 0.5 is not allowed; must be >= 1");
  EXPECT_EQ(violations[3], "spectrum/direction: nan is not allowed; must be any finite number");
  EXPECT_EQ(SurfaceSpectrum().validate().size(), 1u);
  spectrum = selfAffine();
  spectrum.density.pop_back();
  EXPECT_EQ(spectrum.validate("scan 3/spectrum").at(0),
            "scan 3/spectrum/density: has 2 values; must have one for each wave number, 3");
}

}  // namespace
}  // namespace mems_stiction
