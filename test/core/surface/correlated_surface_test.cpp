/// Made surfaces that fit a scan: what is between both, band by band, against the formula.

#include "surface/correlated_surface.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/sample_frames.hpp"
#include "surface/counter_surface.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 10e-9;

HeightMap scanned(int rows = 256, int cols = 256, double rms_height = 4e-9) {
  return samples::gaussian(rows, cols, kPitch, kPitch, rms_height, 80e-9, 21);
}

CounterSurfaceOptions madeLike(CounterSurfaceType type, double correlation, double length = 0.0) {
  CounterSurfaceOptions options;
  options.type = type;
  options.gaussian.gaussian.rms_height = 3e-9;
  options.gaussian.gaussian.correlation_length_x = 50e-9;
  options.gaussian.gaussian.correlation_length_y = 50e-9;
  options.self_affine.rms_height = 3e-9;
  options.correlation = correlation;
  options.correlation_length = length;
  return options;
}

/// Mean squares of two surfaces and of their difference, in a band of waves of a frame that goes on
/// by its reflections [m^2].
struct BandSquares {
  double lower = 0.0;
  double upper = 0.0;
  double between = 0.0;

  double between_by(double rho) const {
    return lower + upper - 2.0 * rho * std::sqrt(lower * upper);
  }
};

BandSquares bandOf(const HeightMap& lower, const HeightMap& upper, double shortest,
                   double longest) {
  cv::Mat waves[2];
  cv::dct(lower.heights(), waves[0]);
  cv::dct(upper.heights(), waves[1]);
  BandSquares band;
  for (int row = 0; row < lower.rows(); ++row) {
    for (int col = 0; col < lower.cols(); ++col) {
      const double wave_number =
          std::hypot(kPi * row / (lower.rows() * kPitch), kPi * col / (lower.cols() * kPitch));
      if (!(wave_number > 2.0 * kPi / longest) || wave_number > 2.0 * kPi / shortest) continue;
      const double one = waves[0].at<double>(row, col);
      const double other = waves[1].at<double>(row, col);
      const double cells = static_cast<double>(lower.heights().total());
      band.lower += one * one / cells;
      band.upper += other * other / cells;
      band.between += (one - other) * (one - other) / cells;
    }
  }
  return band;
}

TEST(CorrelatedSurface, whatIsBetweenFollowsTheFormulaInEveryBand) {
  const HeightMap scan = scanned();
  for (const CounterSurfaceType type :
       {CounterSurfaceType::kGaussian, CounterSurfaceType::kSelfAffine}) {
    for (const double rho : {0.3, 0.8, 0.95}) {
      const HeightMap upper = generatedCounterSurface(scan, madeLike(type, rho));
      EXPECT_NEAR(heightStatistics(upper).rms_height, 3e-9, 1e-15);
      for (const double longest : {2.56e-6, 640e-9, 320e-9, 160e-9}) {
        const BandSquares band = bandOf(scan, upper, 0.5 * longest, longest);
        double expected = 0.0;  // of bands over which spectra hardly fall
        for (double part = longest; part > 0.51 * longest; part *= std::exp2(-0.25)) {
          expected += bandOf(scan, upper, part * std::exp2(-0.25), part).between_by(rho);
        }
        // some 50 to 3000 waves, whose own parts happen to be alike by the root of their number
        const double chance = longest > 1e-6 ? 0.3 : longest > 400e-9 ? 0.15 : 0.07;
        EXPECT_NEAR(std::sqrt(band.between / expected), 1.0,
                    chance * (0.2 + std::sqrt(1.0 - rho * rho)))
            << rho << " " << longest;
      }
    }
  }
}

TEST(CorrelatedSurface, keepsItsOwnSpectrum) {
  const HeightMap scan = scanned();
  const auto type = CounterSurfaceType::kGaussian;
  const HeightMap own = generatedCounterSurface(scan, madeLike(type, 0.0));
  const HeightMap fitting = generatedCounterSurface(scan, madeLike(type, 0.9));
  for (const double longest : {640e-9, 320e-9, 160e-9}) {
    const BandSquares band = bandOf(own, fitting, 0.5 * longest, longest);
    EXPECT_NEAR(std::sqrt(band.upper / band.lower), 1.0, 0.1) << longest;
  }
}

TEST(CorrelatedSurface, shorterWavesAreItsOwn) {
  const HeightMap scan = scanned();
  const double length = 250e-9;
  const auto type = CounterSurfaceType::kSelfAffine;
  const HeightMap own = generatedCounterSurface(scan, madeLike(type, 0.0));
  const HeightMap upper = generatedCounterSurface(scan, madeLike(type, 0.9, length));
  const BandSquares longer = bandOf(scan, upper, length, 640e-9);
  EXPECT_NEAR(std::sqrt(longer.between / longer.between_by(0.9)), 1.0, 0.1);
  const BandSquares shorter = bandOf(own, upper, 20e-9, length);
  // but for the factor that keeps the rms height
  EXPECT_LT(shorter.between, 0.02 * shorter.lower);
}

TEST(CorrelatedSurface, nothingIsAnotherWithoutACorrelation) {
  const HeightMap scan = scanned(64, 48);
  CounterSurfaceOptions plain = madeLike(CounterSurfaceType::kGaussian, 0.0);
  const HeightMap own = generatedCounterSurface(scan, plain);
  plain.correlation_length = 100e-9;
  EXPECT_EQ(cv::norm(generatedCounterSurface(scan, plain).heights(), own.heights(), cv::NORM_INF),
            0.0);
  const HeightMap flat = analytic::flat(64, 48, kPitch, kPitch);
  EXPECT_EQ(cv::norm(correlatedWith(flat, own, {0.9, 0.0}).heights(), own.heights(), cv::NORM_INF),
            0.0)
      << "a scan without relief has nothing to share";
}

TEST(CorrelatedSurface, aWholeCorrelationFitsIntoTheScan) {
  const HeightMap scan = scanned(75, 96);  // an odd side, too
  CounterSurfaceOptions same = madeLike(CounterSurfaceType::kGaussian, 1.0);
  same.gaussian.gaussian.rms_height = heightStatistics(scan).rms_height;
  same.gaussian.gaussian.correlation_length_x = same.gaussian.gaussian.correlation_length_y = 80e-9;
  const HeightMap upper = generatedCounterSurface(scan, same);
  const cv::Mat between = upper.heights() - scan.heights();
  // spectra of one law are alike but for chance: s1 - s2 of each band is left
  EXPECT_LT(heightStatistics(HeightMap(between, kPitch, kPitch)).rms_height,
            0.35 * heightStatistics(scan).rms_height);
  // of one spectrum nothing is left
  const HeightMap fitted = correlatedWith(scan, turnedOver(turnedOver(scan)), {1.0, 0.0});
  const cv::Mat left = fitted.heights() - (scan.heights() - cv::mean(scan.heights()));
  EXPECT_LT(cv::norm(left, cv::NORM_INF), 1e-6 * heightStatistics(scan).rms_height);
}

TEST(CorrelatedSurface, takesScansWithHoles) {
  HeightMap scan = samples::withHoles(scanned(96, 96), 0.05, 4);
  cv::Mat heights = scan.heights().clone();
  heights.rowRange(0, 3) = std::numeric_limits<double>::quiet_NaN();  // lines at the border, too
  scan = HeightMap(heights, kPitch, kPitch);
  const HeightMap upper =
      generatedCounterSurface(scan, madeLike(CounterSurfaceType::kGaussian, 0.9));
  ASSERT_EQ(upper.rows(), 96);
  EXPECT_TRUE(cv::checkRange(upper.heights()));
  const HeightMap whole =
      generatedCounterSurface(scanned(96, 96), madeLike(CounterSurfaceType::kGaussian, 0.9));
  EXPECT_LT(cv::norm(upper.heights() - whole.heights(), cv::NORM_L2),
            0.15 * cv::norm(whole.heights(), cv::NORM_L2));
}

TEST(CounterSurfaceOptions, refuseACorrelationThatIsNone) {
  for (const double wrong : {-0.1, 1.01, std::numeric_limits<double>::quiet_NaN()}) {
    CounterSurfaceOptions options;
    options.correlation = wrong;
    const std::vector<std::string> violations = rangeViolations(options);
    ASSERT_EQ(violations.size(), 1u);
    EXPECT_NE(violations[0].find("counter_surface/correlation"), std::string::npos);
    EXPECT_NE(violations[0].find("[0, 1]"), std::string::npos) << violations[0];
  }
  CounterSurfaceOptions options;
  options.correlation_length = -1e-9;
  EXPECT_EQ(rangeViolations(options).size(), 1u);
}

}  // namespace
}  // namespace mems_stiction
