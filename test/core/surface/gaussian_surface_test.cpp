#include "surface/gaussian_surface.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/roughness/areal_parameters.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// Mean of z(r, c) z(r + row_lag, c + col_lag) around the periodic frame, over the variance.
double autocorrelation(const HeightMap& surface, int row_lag, int col_lag) {
  const cv::Mat& heights = surface.heights();
  double products = 0.0;
  double squares = 0.0;
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      const double height = heights.at<double>(row, col);
      squares += height * height;
      products += height * heights.at<double>((row + row_lag) % heights.rows,
                                              (col + col_lag) % heights.cols);
    }
  }
  return products / squares;
}

GaussianSurfaceOptions anisotropic() {
  GaussianSurfaceOptions options;
  options.rows = 540;
  options.cols = 801;
  options.pitch_x = 5e-9;
  options.pitch_y = 8e-9;
  options.rms_height = 4.7e-9;
  options.correlation_length_x = 50e-9;  // 10 columns
  options.correlation_length_y = 96e-9;  // 12 rows
  options.seed = 3;
  return options;
}

TEST(GaussianSurface, hasTheSizeRmsHeightAndMeanThatWereAskedFor) {
  const GaussianSurfaceOptions options = anisotropic();
  const HeightMap surface = gaussianSurface(options);
  EXPECT_EQ(surface.rows(), options.rows);
  EXPECT_EQ(surface.cols(), options.cols);
  EXPECT_EQ(surface.pitchX(), options.pitch_x);
  EXPECT_EQ(surface.pitchY(), options.pitch_y);
  EXPECT_EQ(surface.heights().type(), CV_64FC1);
  const HeightStatistics statistics = heightStatistics(surface);
  EXPECT_EQ(statistics.valid_count, options.rows * options.cols);
  EXPECT_NEAR(statistics.rms_height, options.rms_height,
              1e-12 * options.rms_height);  // rescaled: round-off
  EXPECT_NEAR(statistics.mean, 0.0, 1e-12 * options.rms_height);
}

TEST(GaussianSurface, autocorrelationFallsToOneOverEAtTheCorrelationLengths) {
  const GaussianSurfaceOptions options = anisotropic();
  const HeightMap surface = gaussianSurface(options);
  // standard deviation of one sample's autocorrelation: sqrt(pi lx ly (1 + e^-2)/(2 area)) = 0.022;
  // 3 of them
  const double area = options.rows * options.cols * surface.cellArea();
  const double scatter =
      std::sqrt(kPi * options.correlation_length_x * options.correlation_length_y *
                (1.0 + std::exp(-2.0)) / (2.0 * area));
  EXPECT_LT(scatter, 0.025);
  EXPECT_NEAR(autocorrelation(surface, 0, 10), std::exp(-1.0), 3.0 * scatter);
  EXPECT_NEAR(autocorrelation(surface, 12, 0), std::exp(-1.0), 3.0 * scatter);
  EXPECT_NEAR(autocorrelation(surface, 12, 10), std::exp(-2.0), 3.0 * scatter);
  EXPECT_NEAR(autocorrelation(surface, 6, 0), std::exp(-0.25), 3.0 * scatter);
  EXPECT_NEAR(autocorrelation(surface, 0, 40), 0.0, 3.0 * scatter);
}

TEST(GaussianSurface, autocorrelationOfManySeedsConvergesOnTheFormula) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 128;
  options.correlation_length_x = options.correlation_length_y = 50e-9;  // 5 pixels
  const int seeds = 60;
  double mean = 0.0;
  for (options.seed = 0; options.seed < seeds; ++options.seed) {
    mean += autocorrelation(gaussianSurface(options), 0, 5) / seeds;
  }
  // one sample scatters by 0.052, sixty by 0.0067, 3 of them; taking the mean off lowers it by pi
  // l^2/area = 0.005
  EXPECT_NEAR(mean, std::exp(-1.0), 0.025);
}

TEST(GaussianSurface, rmsSlopeIsThatOfItsAutocorrelation) {
  // <|grad z|^2> = 2 sigma^2 (1/lx^2 + 1/ly^2)
  const GaussianSurfaceOptions options = anisotropic();
  const double expected =
      options.rms_height * std::sqrt(2.0 / std::pow(options.correlation_length_x, 2) +
                                     2.0 / std::pow(options.correlation_length_y, 2));
  // central differences lose pitch^2/l^2 = 1 %, half of it in the root at most; the sample scatters
  // by about 1 %
  EXPECT_NEAR(arealParameters(gaussianSurface(options)).sdq, expected, 0.03 * expected);
}

TEST(GaussianSurface, heightsAreGaussian) {
  const ArealParameters found = arealParameters(gaussianSurface(anisotropic()));
  // about 900 independent patches pi lx ly/2: skewness scatters by sqrt(6/900)/2, kurtosis by
  // sqrt(24/900)/2; 4 of them
  EXPECT_NEAR(found.ssk, 0.0, 0.17);
  EXPECT_NEAR(found.sku, 3.0, 0.33);
}

TEST(GaussianSurface, isPeriodic) {
  const HeightMap surface = gaussianSurface(anisotropic());
  // rms step between neighbouring columns, sigma sqrt(2 (1 - exp(-1/100))) = 0.141 sigma, also
  // across the seam: with 540 rows in 45 independent stretches the estimate scatters by 1/sqrt(90);
  // 4 of them
  double squares = 0.0;
  for (int row = 0; row < surface.rows(); ++row) {
    squares += std::pow(surface.height(row, 0) - surface.height(row, surface.cols() - 1), 2);
  }
  const double expected = 4.7e-9 * std::sqrt(2.0 * (1.0 - std::exp(-0.01)));
  EXPECT_NEAR(std::sqrt(squares / surface.rows()), expected, 0.42 * expected);
}

TEST(GaussianSurface, isTheSameForTheSameSeedAndAnotherForAnother) {
  GaussianSurfaceOptions options = anisotropic();
  const HeightMap first = gaussianSurface(options);
  const HeightMap again = gaussianSurface(options);
  EXPECT_EQ(cv::norm(first.heights(), again.heights(), cv::NORM_INF), 0.0);
  options.seed = 4;
  const HeightMap other = gaussianSurface(options);
  EXPECT_GT(cv::norm(first.heights(), other.heights(), cv::NORM_INF), options.rms_height);
}

TEST(GaussianSurface, scalesWithTheRmsHeightAndKeepsItsShape) {
  GaussianSurfaceOptions options = anisotropic();
  const HeightMap low = gaussianSurface(options);
  options.rms_height *= 8.0;
  const HeightMap high = gaussianSurface(options);
  EXPECT_NEAR(high.height(17, 311), 8.0 * low.height(17, 311), 1e-12 * options.rms_height);
  options.rms_height = 0.0;
  EXPECT_EQ(cv::norm(gaussianSurface(options).heights(), cv::NORM_INF), 0.0);
}

TEST(GaussianSurface, isWhiteNoiseBelowThePitch) {
  GaussianSurfaceOptions options;
  options.rows = 300;
  options.cols = 301;
  options.correlation_length_x = options.correlation_length_y = 0.1 * options.pitch_x;
  // 90300 independent pixels: 1/sqrt(90300) = 0.0033; 4 of them
  EXPECT_NEAR(autocorrelation(gaussianSurface(options), 0, 1), 0.0, 0.0134);
}

TEST(GaussianSurface, refusesOptionsOutOfRangeAndNamesEach) {
  GaussianSurfaceOptions options;
  options.rows = 1;
  options.pitch_x = 0.0;
  options.rms_height = -1e-9;
  options.seed = -1;
  try {
    gaussianSurface(options);
    FAIL() << "no error";
  } catch (const OptionsError& error) {
    const std::string text = error.what();
    for (const char* key :
         {"gaussian/rows", "gaussian/pitch_x", "gaussian/rms_height", "gaussian/seed"}) {
      EXPECT_NE(text.find(key), std::string::npos) << text;
    }
  }
  options = GaussianSurfaceOptions();
  options.correlation_length_y = 0.6 * options.rows * options.pitch_y;
  EXPECT_EQ(options.validate().size(), 1u);
  EXPECT_THROW(gaussianSurface(options), OptionsError);
  EXPECT_TRUE(GaussianSurfaceOptions().validate().empty());
}

}  // namespace
}  // namespace mems_stiction
