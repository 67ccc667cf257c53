#include "surface/translated_gaussian_surface.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/roughness/areal_parameters.hpp"
#include "roughness/autocorrelation.hpp"
#include "surface/gaussian_surface.hpp"
#include "surface/johnson_translation.hpp"

namespace mems_stiction {
namespace {

struct Shape {
  double skewness, kurtosis;
};

const std::vector<Shape> kShapes = {
    {0.0, 3.0},     // the identity
    {0.0, 1.8},     // bounded
    {0.0, 6.0},     // unbounded
    {0.5, 2.6},     // bounded
    {-1.0, 4.5},    // near the log-normal
    {1.0, 4.8299},  // nearer
    {-0.8, 5.0},    // unbounded: a worn surface
    {2.7, 16.0},    // particles
    {1.5, 3.6},     // close to two levels
};

/// Central moments of the translation over a fine grid of normal quantities: another quadrature
/// than its own.
Shape momentsOf(const JohnsonTranslation& translation) {
  const double step = 0.0037;
  double moments[5] = {};
  for (double g = -12.0; g < 12.0; g += step) {
    const double weight = std::exp(-0.5 * g * g);
    const double value = translation(g);
    double power = weight;
    for (double& moment : moments) {
      moment += power;
      power *= value;
    }
  }
  for (int order = 4; order >= 0; --order) moments[order] /= moments[0];
  EXPECT_NEAR(moments[1], 0.0, 1e-6);
  EXPECT_NEAR(moments[2], 1.0, 1e-5);
  return {moments[3], moments[4]};
}

TEST(JohnsonTranslation, hasTheSkewnessAndKurtosisThatWereAskedFor) {
  for (const Shape& shape : kShapes) {
    const Shape found = momentsOf(JohnsonTranslation(shape.skewness, shape.kurtosis));
    EXPECT_NEAR(found.skewness, shape.skewness, 2e-3 * (1.0 + std::fabs(shape.skewness)));
    EXPECT_NEAR(found.kurtosis, shape.kurtosis, 5e-3 * shape.kurtosis)
        << shape.skewness << ", " << shape.kurtosis;
  }
}

TEST(JohnsonTranslation, risesAndIsTheIdentityForAGaussian) {
  for (const Shape& shape : kShapes) {
    const JohnsonTranslation translation(shape.skewness, shape.kurtosis);
    for (double g = -5.0; g < 5.0; g += 0.1) EXPECT_LE(translation(g), translation(g + 0.1));
  }
  EXPECT_EQ(JohnsonTranslation(0.0, 3.0)(1.2345), 1.2345);
}

TEST(JohnsonTranslation, refusesWhatNoDistributionHas) {
  EXPECT_THROW(JohnsonTranslation(0.0, 1.0), OptionsError);
  EXPECT_THROW(JohnsonTranslation(2.0, 5.0), OptionsError);
  EXPECT_THROW(JohnsonTranslation(5.0, 40.0), OptionsError);
  EXPECT_THROW(JohnsonTranslation(0.0, 1e6), OptionsError);
}

TEST(TranslatedGaussianSurface, hasHeightsSkewnessAndKurtosis) {
  TranslatedGaussianOptions options;
  options.gaussian.rows = options.gaussian.cols = 1024;
  options.gaussian.rms_height = 4e-9;
  for (const Shape& shape : {Shape{-0.8, 4.2}, Shape{0.6, 2.8}, Shape{0.0, 5.0}}) {
    options.skewness = shape.skewness;
    options.kurtosis = shape.kurtosis;
    const ArealParameters found = arealParameters(translatedGaussianSurface(options));
    EXPECT_NEAR(found.sq, 4e-9, 1e-19);
    // about 10^4 independent patches; moments of higher order than the fourth make heavy tails
    // scatter more
    EXPECT_NEAR(found.ssk, shape.skewness, 0.15);
    EXPECT_NEAR(found.sku, shape.kurtosis, 0.12 * shape.kurtosis);
  }
}

TEST(TranslatedGaussianSurface, keepsTheCorrelationLengths) {
  TranslatedGaussianOptions options;
  options.gaussian.rows = options.gaussian.cols = 1024;
  options.gaussian.correlation_length_x = 80e-9;
  options.gaussian.correlation_length_y = 120e-9;
  options.skewness = 2.0;
  options.kurtosis = 10.0;
  const cv::Mat acf = autocorrelation(translatedGaussianSurface(options), FrameBoundary::kPeriodic);
  // one sample scatters by sqrt(pi lx ly/(2 area)) = 0.012, more with heavy tails
  EXPECT_NEAR(acf.at<double>(512, 512 + 8), std::exp(-1.0), 0.05);
  EXPECT_NEAR(acf.at<double>(512 + 12, 512), std::exp(-1.0), 0.05);
}

TEST(TranslatedGaussianSurface, isTheGaussianOneWithoutSkewness) {
  TranslatedGaussianOptions options;
  options.gaussian.rows = options.gaussian.cols = 64;
  options.gaussian.correlation_length_x = options.gaussian.correlation_length_y = 50e-9;
  const cv::Mat ours = translatedGaussianSurface(options).heights();
  EXPECT_EQ(cv::countNonZero(ours != gaussianSurface(options.gaussian).heights()), 0);
  options.kurtosis = 0.5;
  EXPECT_EQ(options.validate("counter_surface/gaussian").size(), 1u);
  EXPECT_THROW(translatedGaussianSurface(options), OptionsError);
}

}  // namespace
}  // namespace mems_stiction
