#include "surface/tiled_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "numeric/constants.hpp"
#include "roughness/power_spectrum.hpp"
#include "surface/johnson_translation.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 10e-9;

/// Flat for waves longer than `longest` pixels, then C ~ q^-3.6 to waves of `shortest`; rms height
/// 3 nm.
SurfaceSpectrum selfAffine(double longest, double shortest = 1.0) {
  SurfaceSpectrum spectrum;
  spectrum.wave_number = {2.0 * kPi / (longest * kPitch), 2.0 * kPi / (shortest * kPitch)};
  spectrum.density = {1.0, std::pow(longest / shortest, -3.6)};
  const double scale = 9e-18 / spectrum.variance();
  for (double& density : spectrum.density) density *= scale;
  return spectrum;
}

/// Of the autocorrelation sigma^2 exp(-r^2/l^2), with sigma 1 nm.
SurfaceSpectrum gaussian(double correlation_length) {
  SurfaceSpectrum spectrum;
  for (double x = 0.05; x < 8.0; x *= 1.02) {  // l q; beyond 8 there is 1e-7 of the variance
    spectrum.wave_number.push_back(x / correlation_length);
    spectrum.density.push_back(kPi * correlation_length * correlation_length * 1e-18 *
                               std::exp(-0.25 * x * x));
  }
  return spectrum;
}

cv::Mat part(TiledSurface& surface, std::int64_t row, std::int64_t col, int rows, int cols,
             int type = CV_64FC1) {
  cv::Mat tile(rows, cols, type);
  surface.heights(row, col, tile);
  return tile;
}

/// Mean and its standard error, from independent values.
struct Mean {
  double value = 0.0;
  double error = 0.0;
};

Mean meanOf(const std::vector<double>& values) {
  Mean mean;
  for (const double value : values) mean.value += value / static_cast<double>(values.size());
  for (const double value : values) mean.error += (value - mean.value) * (value - mean.value);
  mean.error = std::sqrt(mean.error / static_cast<double>(values.size() * (values.size() - 1)));
  return mean;
}

/// Mean of f(z(r), z(r + lag)) over a square.
template <typename Function>
double pairMean(const cv::Mat& heights, int lag_row, int lag_col, Function f) {
  double sum = 0.0;
  int count = 0;
  for (int row = std::max(0, -lag_row); row < heights.rows - std::max(0, lag_row); ++row) {
    const double* const line = heights.ptr<double>(row);
    const double* const other = heights.ptr<double>(row + lag_row);
    for (int col = std::max(0, -lag_col); col < heights.cols - std::max(0, lag_col); ++col) {
      sum += f(line[col], other[col + lag_col]);
      ++count;
    }
  }
  return sum / count;
}

double product(double a, double b) { return a * b; }

// ---------------------------------------------------------------- the same bits

TEST(TiledSurface, isTheSameWhateverTilesAreAskedFor) {
  const SurfaceSpectrum spectrum = selfAffine(5000.0);
  TiledSurface surface(spectrum, 3000, 6000, kPitch, kPitch, 42);
  const cv::Size block = surface.tile();
  const cv::Mat whole = part(surface, 0, 0, 1600, 3200, CV_32FC1);
  ASSERT_LT(2 * block.height, whole.rows);  // seams of the blocks lie in it
  ASSERT_LT(2 * block.width, whole.cols);

  TiledSurface other(spectrum, 3000, 6000, kPitch, kPitch, 42);  // another process, so to speak
  for (const cv::Size& size : {cv::Size(700, 400), cv::Size(3200, 33), cv::Size(1, 1600)}) {
    const int step_row = size.width == 1 ? 1600 : 5 * size.height;
    const int step_col = size.width == 1 ? 1333 : size.width;
    for (int row = whole.rows - size.height; row >= 0; row -= step_row) {
      for (int col = 0; col + size.width <= whole.cols; col += step_col) {
        const cv::Mat tile = part(other, row, col, size.height, size.width, CV_32FC1);
        ASSERT_EQ(cv::countNonZero(tile != whole(cv::Rect(col, row, size.width, size.height))), 0)
            << size << " at " << row << ", " << col;
      }
    }
  }
  // of another type, into a part of a larger matrix
  cv::Mat frame(500, 500, CV_64FC1, cv::Scalar(7.0));
  cv::Mat inner = frame(cv::Rect(100, 50, 300, 400));
  surface.heights(1000, 2700, inner);
  cv::Mat expected;
  whole(cv::Rect(2700, 1000, 300, 400)).convertTo(expected, CV_64F);
  EXPECT_EQ(cv::countNonZero(inner != expected), 0);
  EXPECT_EQ(frame.at<double>(49, 100), 7.0);
  EXPECT_EQ(frame.at<double>(450, 399), 7.0);
}

TEST(TiledSurface, isACornerOfTheSameEndlessSurfaceWhateverItsSize) {
  const SurfaceSpectrum spectrum = selfAffine(300.0);
  TiledSurface small(spectrum, 64, 64, kPitch, kPitch, 5);
  TiledSurface large(spectrum, 1000000000, 1000000000, kPitch, kPitch, 5);
  const cv::Mat corner = part(small, 0, 0, 64, 64);
  EXPECT_EQ(cv::countNonZero(corner != part(large, 0, 0, 64, 64)), 0);
  small.reseed(6);
  EXPECT_GT(cv::countNonZero(part(small, 0, 0, 64, 64) != corner), 64 * 63);
  small.reseed(5);
  EXPECT_EQ(cv::countNonZero(part(small, 0, 0, 64, 64) != corner), 0);
  const cv::Mat end = part(large, 1000000000 - 64, 1000000000 - 64, 64, 64);
  EXPECT_EQ(cv::countNonZero(end != corner), 64 * 64);
  EXPECT_TRUE(cv::checkRange(end));
}

TEST(TiledSurface, seedsAreIndependent) {
  const SurfaceSpectrum spectrum = gaussian(20e-9);
  std::vector<double> correlations;
  TiledSurface surface(spectrum, 512, 512, kPitch, kPitch, 0);
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    surface.reseed(seed);
    const cv::Mat a = part(surface, 0, 0, 512, 512);
    // of neighbouring seeds, and of seeds that differ in their upper half alone
    surface.reseed(seed % 2 == 0 ? seed + 1 : seed + (std::uint64_t{1} << 32U));
    const cv::Mat b = part(surface, 0, 0, 512, 512);
    correlations.push_back(a.dot(b) / std::sqrt(a.dot(a) * b.dot(b)));
  }
  const Mean mean = meanOf(correlations);
  EXPECT_NEAR(mean.value, 0.0, 4.0 * mean.error);
  EXPECT_LT(mean.error, 0.005);  // 512^2/(2 pi 2^2) independent places in each
}

// ---------------------------------------------------------------- statistics

TEST(TiledSurface, hasTheRadialSpectrumThatWasAskedFor) {
  const SurfaceSpectrum spectrum = selfAffine(128.0);
  constexpr std::uint64_t kRealisations = 12;
  constexpr int kSide = 1024;
  constexpr std::array<double, 8> kEnds = {20,  30,  45,  68,
                                           102, 153, 230, 345};  // waves along the side
  std::array<std::vector<double>, kEnds.size() - 1> ratios;
  TiledSurface surface(spectrum, kSide, kSide, kPitch, kPitch, 0);
  for (std::uint64_t seed = 0; seed < kRealisations; ++seed) {
    surface.reseed(seed);
    const PowerSpectrum found = powerSpectrum(
        HeightMap(part(surface, 0, 0, kSide, kSide), kPitch, kPitch), SpectrumWindow::kHann);
    for (std::size_t band = 0; band < ratios.size(); ++band) {
      double sum = 0.0;
      double count = 0.0;
      for (const SpectrumRing& ring : found.rings) {
        const double wave = ring.wave_number * kSide * kPitch / (2.0 * kPi);
        if (wave < kEnds[band] || wave >= kEnds[band + 1]) continue;
        sum += ring.count * ring.density / spectrum.densityAt(ring.wave_number);
        count += ring.count;
      }
      ratios[band].push_back(sum / count);
    }
  }
  for (std::size_t band = 0; band < ratios.size(); ++band) {
    const Mean mean = meanOf(ratios[band]);
    EXPECT_NEAR(mean.value, 1.0, 4.0 * mean.error + 0.006)
        << kEnds[band];  // 2.2/20^2: what Hann's window adds to a power law
    EXPECT_LT(mean.error, 0.02) << kEnds[band];
  }
}

// Wavelengths from 2048 pixels to 2: the longer ones of means over 16 x 16 pixels, the shorter ones
// of parts.
TEST(TiledSurfaceEvidence, hasTheSpectrumOverThreeDecades) {
  constexpr int kSide = 8192;
  constexpr int kCell = 16;
  const SurfaceSpectrum spectrum = selfAffine(kSide / 4.0, 2.0);
  const auto bandMean = [&](const cv::Mat& heights, double pitch, double shortest, double longest,
                            bool of_cells) {
    double sum = 0.0;
    double count = 0.0;
    for (const SpectrumRing& ring :
         powerSpectrum(HeightMap(heights, pitch, pitch), SpectrumWindow::kHann).rings) {
      const double length = 2.0 * kPi / (ring.wave_number * kPitch);
      if (length < shortest || length >= longest) continue;
      // a mean over a square leaves sinc^2 along each axis; to fourth order in q that is exp(-(q
      // a)^2/24)^2 in every direction
      const double smoothed =
          of_cells ? std::exp(-std::pow(ring.wave_number * pitch, 2.0) / 12.0) : 1.0;
      sum += ring.count * ring.density / (smoothed * spectrum.densityAt(ring.wave_number));
      count += ring.count;
    }
    return sum / count;
  };
  std::vector<double> squares;
  std::vector<std::vector<double>> ratios(5);
  TiledSurface surface(spectrum, kSide, kSide, kPitch, kPitch, 0);
  EXPECT_NEAR(surface.variance() / spectrum.variance(), 1.0, 2e-3);
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    surface.reseed(seed);
    const cv::Size block = surface.tile();
    cv::Mat means(kSide / kCell, kSide / kCell, CV_64FC1, cv::Scalar(0.0));
    double square = 0.0;
    for (int row = 0; row < kSide; row += block.height) {
      for (int col = 0; col < kSide; col += block.width) {
        const cv::Mat tile = part(surface, row, col, std::min(block.height, kSide - row),
                                  std::min(block.width, kSide - col));
        for (int y = 0; y < tile.rows; ++y) {
          double* const line = means.ptr<double>((row + y) / kCell);
          for (int x = 0; x < tile.cols; ++x)
            line[(col + x) / kCell] += tile.at<double>(y, x) / (kCell * kCell);
        }
        square += tile.dot(tile) / (static_cast<double>(kSide) * kSide);
      }
    }
    squares.push_back(square / surface.variance());
    ratios[0].push_back(bandMean(means, kCell * kPitch, 250.0, 700.0, true));
    ratios[1].push_back(bandMean(means, kCell * kPitch, 90.0, 250.0, true));
    for (int place = 0; place < 4; ++place) {
      const cv::Mat square_part = part(surface, 2000 * place, 1000 + 1500 * place, 1024, 1024);
      ratios[2].push_back(bandMean(square_part, kPitch, 25.0, 60.0, false));
      ratios[3].push_back(bandMean(square_part, kPitch, 8.0, 25.0, false));
      ratios[4].push_back(bandMean(square_part, kPitch, 2.1, 8.0, false));
    }
  }
  // 500 waves in the first band, more in the others; in the mean square the longest count most,
  // some 50 of them
  for (std::size_t band = 0; band < ratios.size(); ++band)
    EXPECT_NEAR(meanOf(ratios[band]).value, 1.0, band == 0 ? 0.1 : 0.05) << band;
  EXPECT_NEAR(meanOf(squares).value, 1.0, 0.45);
}

TEST(TiledSurface, hasTheVarianceAndTheAutocorrelationThatWereAskedFor) {
  constexpr int kSide = 768;
  constexpr double kLength = 30.0;  // pixels: over levels 0, 1 and 2
  const SurfaceSpectrum spectrum = gaussian(kLength * kPitch);
  constexpr std::uint64_t kRealisations = 12;
  const std::array<std::pair<int, int>, 7> lags = {
      {{0, 0}, {0, 10}, {10, 0}, {20, 20}, {20, -20}, {0, 40}, {60, 0}}};
  std::array<std::vector<double>, lags.size()> found;
  TiledSurface surface(spectrum, kSide, kSide, kPitch, kPitch, 0);
  EXPECT_NEAR(surface.variance() / 1e-18, 1.0, 1e-3);
  for (std::uint64_t seed = 100; seed < 100 + kRealisations; ++seed) {
    surface.reseed(seed);
    const cv::Mat heights = part(surface, 0, 0, kSide, kSide);
    for (std::size_t i = 0; i < lags.size(); ++i) {
      found[i].push_back(pairMean(heights, lags[i].first, lags[i].second, product) / 1e-18);
    }
  }
  for (std::size_t i = 0; i < lags.size(); ++i) {
    const double distance = std::hypot(lags[i].first, lags[i].second) / kLength;
    const Mean mean = meanOf(found[i]);
    EXPECT_NEAR(mean.value, std::exp(-distance * distance), 4.0 * mean.error + 1e-3) << distance;
    EXPECT_LT(mean.error, 0.045);
  }
}

// exp(-(along^2/s + across^2 s)/l^2), on pixels that are longer along y.
TEST(TiledSurface, isStretchedAlongItsDirectionOnPixelsOfAnyShape) {
  constexpr double kLength = 150e-9;
  constexpr double kPitchX = 8e-9;
  constexpr double kPitchY = 14e-9;
  SurfaceSpectrum spectrum = gaussian(kLength);
  spectrum.stretch = 3.0;
  spectrum.direction = 0.6;
  constexpr std::uint64_t kRealisations = 6;
  const std::array<std::pair<int, int>, 8> lags = {
      {{0, 0}, {0, 10}, {0, 25}, {6, 0}, {14, 0}, {7, 17}, {14, 34}, {8, -12}}};
  std::array<std::vector<double>, lags.size()> found;
  TiledSurface surface(spectrum, 512, 800, kPitchX, kPitchY, 0);
  for (std::uint64_t seed = 7; seed < 7 + kRealisations; ++seed) {
    surface.reseed(seed);
    const cv::Mat heights = part(surface, 0, 0, 512, 800);
    for (std::size_t i = 0; i < lags.size(); ++i) {
      found[i].push_back(pairMean(heights, lags[i].first, lags[i].second, product) / 1e-18);
    }
  }
  for (std::size_t i = 0; i < lags.size(); ++i) {
    const double x = lags[i].second * kPitchX;
    const double y = lags[i].first * kPitchY;
    const double along = x * std::cos(0.6) + y * std::sin(0.6);
    const double across = y * std::cos(0.6) - x * std::sin(0.6);
    const double wanted =
        std::exp(-(along * along / 3.0 + across * across * 3.0) / (kLength * kLength));
    const Mean mean = meanOf(found[i]);
    EXPECT_NEAR(mean.value, wanted, 4.0 * mean.error + 1e-3) << x << ", " << y;
    EXPECT_LT(mean.error, 0.02);
  }
}

TEST(TiledSurface, isNormal) {
  std::vector<double> skewness;
  std::vector<double> kurtosis;
  TiledSurface surface(gaussian(4.0 * kPitch), 1024, 1024, kPitch, kPitch, 0);
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    surface.reseed(seed);
    const cv::Mat heights = part(surface, 0, 0, 1024, 1024);
    const double variance = surface.variance();
    skewness.push_back(pairMean(heights, 0, 0, [&](double z, double) { return z * z * z; }) /
                       std::pow(variance, 1.5));
    kurtosis.push_back(pairMean(heights, 0, 0, [&](double z, double) { return z * z * z * z; }) /
                       (variance * variance));
  }
  EXPECT_NEAR(meanOf(skewness).value, 0.0, 4.0 * meanOf(skewness).error);
  EXPECT_NEAR(meanOf(kurtosis).value, 3.0, 4.0 * meanOf(kurtosis).error);
  EXPECT_LT(meanOf(kurtosis).error, 0.02);
}

// A step, a kink or a change of the statistics where blocks meet would show in the differences
// across.
TEST(TiledSurface, hasNoSeamWhereBlocksMeet) {
  const SurfaceSpectrum spectrum = selfAffine(2000.0);
  TiledSurface surface(spectrum, 20000, 20000, kPitch, kPitch, 3);
  const int cols = surface.tile().width;
  const int rows = surface.tile().height;
  constexpr int kAround = 48;
  constexpr int kLength = 4096;
  // columns around four seams, across which blocks lie side by side; the same for rows; and the
  // middles, where the halves meet
  for (const bool along_rows : {false, true}) {
    for (const int order : {1, 2}) {
      std::vector<double> elsewhere;
      std::vector<double> at_seams;
      for (int seam = 1; seam <= 4; ++seam) {
        for (const int middle :
             {seam * (along_rows ? rows : cols),
              seam * (along_rows ? rows : cols) - (along_rows ? rows : cols) / 2}) {
          cv::Mat strip = along_rows ? part(surface, middle - kAround, 0, 2 * kAround, kLength).t()
                                     : part(surface, 0, middle - kAround, kLength, 2 * kAround);
          for (int col = order; col < 2 * kAround; ++col) {
            double sum = 0.0;
            for (int row = 0; row < kLength; ++row) {
              const double* const z = strip.ptr<double>(row) + col;
              const double difference = order == 1 ? z[0] - z[-1] : z[0] - 2.0 * z[-1] + z[-2];
              sum += difference * difference;
            }
            (std::abs(col - kAround) < 2 ? at_seams : elsewhere).push_back(sum / kLength);
          }
        }
      }
      const Mean rest = meanOf(elsewhere);
      const double deviation = rest.error * std::sqrt(static_cast<double>(elsewhere.size()));
      const double error =
          deviation / std::sqrt(8.0);  // eight places, whose neighbouring columns are alike
      EXPECT_NEAR(meanOf(at_seams).value / rest.value, 1.0, 4.0 * error / rest.value)
          << along_rows << ", " << order;
      EXPECT_LT(error / rest.value, 0.05);
    }
  }
}

// ---------------------------------------------------------------- other distributions

TEST(TiledSurface, hasTheDistributionOfItsTranslation) {
  const JohnsonTranslation johnson(-1.0, 4.5);
  const HeightTranslation translation([&](double g) { return 3e-9 * johnson(g); });
  std::array<std::vector<double>, 6> below;
  const std::array<double, below.size()> quantiles = {-3.0, -1.5, -0.5, 0.5, 1.5, 3.0};
  TiledSurface surface(gaussian(4.0 * kPitch), 1024, 1024, kPitch, kPitch, 0, translation);
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    surface.reseed(seed);
    const cv::Mat heights = part(surface, 0, 0, 1024, 1024);
    for (std::size_t i = 0; i < quantiles.size(); ++i) {
      below[i].push_back(cv::countNonZero(heights < 3e-9 * johnson(quantiles[i])) /
                         (1024.0 * 1024.0));
    }
  }
  for (std::size_t i = 0; i < quantiles.size(); ++i) {
    EXPECT_NEAR(meanOf(below[i]).value, 0.5 * std::erfc(-quantiles[i] / std::sqrt(2.0)),
                4.0 * meanOf(below[i]).error);
    EXPECT_LT(meanOf(below[i]).error, 1e-3);
  }
}

TEST(TiledSurface, translatesEachHeightByItself) {
  const SurfaceSpectrum spectrum = selfAffine(300.0);
  TiledSurface plain(spectrum, 100, 100, kPitch, kPitch, 9);
  TiledSurface translated(spectrum, 100, 100, kPitch, kPitch, 9,
                          HeightTranslation([](double g) { return 1e-9 * std::exp(g); }));
  const cv::Mat z = part(plain, 0, 0, 100, 100);
  const cv::Mat found = part(translated, 0, 0, 100, 100);
  for (int i = 0; i < 100; ++i) {
    EXPECT_NEAR(found.at<double>(i, 99 - i),
                1e-9 * std::exp(z.at<double>(i, 99 - i) / std::sqrt(plain.variance())), 1e-14);
  }
}

TEST(HeightTranslation, isStraightBetweenItsHeightsAndBeyondThem) {
  const HeightTranslation translation(-1.0, 1.0, {0.0, 1.0, 4.0});
  EXPECT_EQ(translation(-1.0), 0.0);
  EXPECT_EQ(translation(-0.5), 0.5);
  EXPECT_EQ(translation(0.0), 1.0);
  EXPECT_EQ(translation(0.5), 2.5);
  EXPECT_EQ(translation(1.0), 4.0);
  EXPECT_EQ(translation(2.0), 7.0);
  EXPECT_EQ(translation(-3.0), -2.0);
}

// ---------------------------------------------------------------- what is refused

/// The lines of the error that `make` throws.
template <typename Make>
std::vector<std::string> refusals(Make make) {
  try {
    make();
  } catch (const OptionsError& error) {
    return error.violations();
  }
  return {};
}

TEST(TiledSurface, namesEachValueThatItRefuses) {
  SurfaceSpectrum spectrum = selfAffine(300.0);
  spectrum.stretch = 0.0;
  EXPECT_EQ(refusals([&] { TiledSurface(spectrum, 0, 2000000000, -1.0, NAN, 1); }),
            (std::vector<std::string>{"spectrum/stretch: 0 is not allowed; must be >= 1",
                                      "rows: 0 is not allowed; must be in [1, 1e+09]",
                                      "cols: 2000000000 is not allowed; must be in [1, 1e+09]",
                                      "pitch_x: -1 is not allowed; must be > 0",
                                      "pitch_y: nan is not allowed; must be > 0"}));
  spectrum.stretch = 200.0;
  std::vector<std::string> lines =
      refusals([&] { TiledSurface(spectrum, 10, 10, kPitch, kPitch, 1); });
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].find("spectrum/stretch: 200 with pixels of 1e-08 m by 1e-08 m is not allowed"),
            0u);
  spectrum.stretch = 1.0;
  spectrum.wave_number[0] = 1e-12;
  lines = refusals([&] { TiledSurface(spectrum, 10, 10, kPitch, kPitch, 1); });
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].find("spectrum/wave_number[0]: 1e-12 is not allowed; must be at least "), 0u);
  lines = refusals([] { TiledSurface(SurfaceSpectrum(), 10, 10, kPitch, kPitch, 1); });
  ASSERT_EQ(lines.size(), 1u);
}

TEST(TiledSurface, refusesTilesThatAreNotOfTheSurface) {
  TiledSurface surface(selfAffine(300.0), 100, 200, kPitch, kPitch, 1);
  const auto asked = [&](std::int64_t row, std::int64_t col, int rows, int cols, int type) {
    return refusals([&] { part(surface, row, col, rows, cols, type); });
  };
  EXPECT_TRUE(asked(0, 0, 100, 200, CV_64FC1).empty());
  EXPECT_EQ(asked(-1, 150, 50, 51, CV_8UC1),
            (std::vector<std::string>{
                "tile: its type is CV_8UC1; must be CV_32FC1 or CV_64FC1",
                "tile: rows -1 to 48 are not all of the surface; must be in [0, 99]",
                "tile: columns 150 to 200 are not all of the surface; must be in [0, 199]"}));
  EXPECT_EQ(asked(60, 0, 41, 10, CV_32FC1).size(), 1u);
}

TEST(HeightTranslation, namesWhatItRefuses) {
  EXPECT_EQ(refusals([] {
              HeightTranslation(1.0, 1.0, {0.0, 2.0, 1.0, NAN});
            }),
            (std::vector<std::string>{
                "translation/highest: 1 is not allowed; must be above lowest, 1",
                "translation/heights[2]: 1 is not allowed; must be at least the one before it, 2",
                "translation/heights[3]: nan is not allowed; must be any finite number"}));
  EXPECT_EQ(refusals([] { HeightTranslation(0.0, 1.0, {0.0}); }),
            (std::vector<std::string>{"translation/heights: has 1 values; must have at least 2"}));
}

}  // namespace
}  // namespace mems_stiction
