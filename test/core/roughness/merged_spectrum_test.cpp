#include "roughness/merged_spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "mems_stiction/errors/errors.hpp"
#include "roughness/half_spectrum.hpp"
#include "support/holed_surfaces.hpp"
#include "surface/random_field.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 10e-9;

/// Periodic heights with the density C(q_x, q_y) [m^4].
template <typename Density>
cv::Mat surfaceOf(int side, int seed, const Density& density) {
  return filteredNoise(whiteNoise(side, side, seed), [&](int row, int col) {
    if (row == 0 && col == 0) return 0.0;
    return std::sqrt(density(waveNumber(col, side, kPitch), waveNumber(row, side, kPitch))) /
           kPitch;
  });
}

HeightMap part(const cv::Mat& heights, int row, int col, int side) {
  return {heights(cv::Rect(col, row, side, side)).clone(), kPitch, kPitch};
}

MergedSpectrum merged(const std::vector<HeightMap>& scans) {
  std::vector<ScanWaves> waves;
  for (const HeightMap& scan : scans) waves.emplace_back(scan);
  const std::vector<ScanTrust> trust = trustOf(waves);
  return mergedSpectrum(waves, trust, stretchOf(waves, trust));
}

double gaussianDensity(double q, double length, double rms) {
  return kPi * length * length * rms * rms * std::exp(-0.25 * q * q * length * length);
}

/// With 1 % missing the shortest band had 34 times its density.
TEST(MergedSpectrum, MissingPixelsLeaveItsBands) {
  const cv::Mat large =
      surfaceOf(512, 1, [](double x, double y) { return std::pow(std::hypot(x, y), -3.6); });
  const HeightMap whole = part(large, 0, 0, 512);
  const MergedSpectrum expected = merged({whole});
  for (const HeightMap& holed :
       {withScatteredHoles(whole, 0.05, 1), withRoundHoles(whole, 0.05, 2)}) {
    const MergedSpectrum found = merged({holed});
    ASSERT_EQ(found.bands.size(), expected.bands.size());
    for (std::size_t i = 0; i < found.bands.size(); ++i) {
      // long bands have a few waves, and five in a hundred of their pixels are others
      const double tolerance = 0.05 + 2.0 * std::sqrt(0.05 / expected.bands[i].freedom);
      EXPECT_NEAR(found.bands[i].density / expected.bands[i].density, 1.0, tolerance) << i;
    }
  }
}

TEST(MergedSpectrum, GaussianSurfaceHasItsClosedForm) {
  const double length = 150e-9;
  const double rms = 3e-9;
  const cv::Mat large = surfaceOf(
      2048, 1, [&](double x, double y) { return gaussianDensity(std::hypot(x, y), length, rms); });
  const MergedSpectrum spectrum =
      merged({part(large, 0, 0, 512), part(large, 900, 300, 512), part(large, 1500, 1500, 512),
              part(large, 100, 1400, 512)});
  double chi_square = 0.0;
  double freedom = 0.0;
  for (const SpectrumBand& band : spectrum.bands) {
    if (band.wave_number * length > 4.0) break;  // the density falls by orders within a band
    const double ratio = band.density / gaussianDensity(band.wave_number, length, rms);
    chi_square += 0.5 * band.freedom * (ratio - 1.0) * (ratio - 1.0);
    freedom += 1.0;
  }
  EXPECT_GT(freedom, 10.0);
  EXPECT_LT(chi_square, freedom + 4.0 * std::sqrt(2.0 * freedom));
  EXPECT_NEAR(
      spectrum.rootMean(0, spectrum.bands.front().wave_number, spectrum.largest_wave_number) / rms,
      1.0, 0.1);
  // <|grad z|^2> = 4 rms^2/length^2
  EXPECT_NEAR(spectrum.rootMean(1, 1.0, spectrum.largest_wave_number) / (2.0 * rms / length), 1.0,
              0.05);
}

/// What levelling and window do to the longest waves of steep spectra is taken off again: without
/// it they are 2 to 3 times too low.
TEST(MergedSpectrum, LongWavesOfASteepSpectrumAreNotTooLow) {
  const auto density = [](double x, double y) {
    return std::pow(std::max(std::hypot(x, y), 2.0 * kPi / 20e-6), -3.6);
  };
  double ratio = 0.0;
  int count = 0;
  for (int seed = 1; seed <= 3; ++seed) {
    const cv::Mat large = surfaceOf(2048, seed, density);
    std::vector<HeightMap> scans;
    for (int i = 0; i < 9; ++i) scans.push_back(part(large, 700 * (i / 3), 700 * (i % 3), 512));
    const MergedSpectrum spectrum = merged(scans);
    for (const SpectrumBand& band : spectrum.bands) {
      if (band.wave_number > 2.0 * kPi / 5.12e-6 * 4.0) break;
      ratio += std::log(band.density / density(band.wave_number, 0.0));
      ++count;
    }
  }
  EXPECT_NEAR(std::exp(ratio / count), 1.0, 0.2);
}

/// On frames that are not square, few waves share a band, and some have little power by chance.
/// What leaks into them through the window is no reason to take them down by decades, once a round.
TEST(MergedSpectrum, LongWavesOfNonSquareFramesDoNotFallByDecades) {
  const auto density = [](double x, double y) {
    return std::pow(std::max(std::hypot(x, y), 2.0 * kPi / 20e-6), -3.6);
  };
  double fall = 0.0;
  for (int seed = 1; seed <= 4; ++seed) {
    const cv::Mat large = surfaceOf(1024, seed, density);
    for (const cv::Rect& frame : {cv::Rect(100, 200, 256, 192), cv::Rect(500, 600, 192, 256)}) {
      const HeightMap scan(large(frame).clone(), kPitch, kPitch);
      const ScanWaves waves(scan);
      const MergedSpectrum spectrum = mergedSpectrum({waves}, trustOf({waves}), {});
      double least_power = std::numeric_limits<double>::infinity();
      waves.visit([&](const FrameWave& wave, double power, double) {
        const double q_x = waves.waveNumberX(wave.x);
        const double q_y = waves.waveNumberY(wave.y);
        if (wave.count() < 2.0 || wave.count() > 8.0) return;
        least_power = std::min(least_power, power / density(q_x, q_y));
      });
      for (const SpectrumBand& band : spectrum.bands) {
        if (band.wave_number > 2.0 * kPi / 2.56e-6 * 8.0) break;
        fall = std::max(fall, least_power / (band.density / density(band.wave_number, 0.0)));
      }
    }
  }
  // a band's density lies above the least power of a wave over the most that leaks in
  EXPECT_LT(fall, 20.0);
}

TEST(MergedSpectrum, CoarseAndFineScansGiveOneSpectrum) {
  const auto density = [](double x, double y) {
    return std::pow(std::max(std::hypot(x, y), 2.0 * kPi / 4e-6), -3.6);
  };
  const cv::Mat large = surfaceOf(2048, 3, density);
  cv::Mat coarse;
  cv::resize(large, coarse, cv::Size(256, 256), 0.0, 0.0, cv::INTER_AREA);
  const MergedSpectrum spectrum =
      merged({part(large, 300, 300, 512), HeightMap(coarse, 8 * kPitch, 8 * kPitch)});
  EXPECT_GT(2.0 * kPi / spectrum.bands.front().wave_number, 15e-6);
  double sum = 0.0;
  double weights = 0.0;
  for (const SpectrumBand& band : spectrum.bands) {
    if (2.0 * kPi / band.wave_number < 40e-9) break;  // near the pixels
    sum += band.freedom * std::log(band.density / density(band.wave_number, 0.0));
    weights += band.freedom;
  }
  EXPECT_NEAR(std::exp(sum / weights), 1.0, 0.1);
}

TEST(MergedSpectrum, DirectionAndRatioOfGroovesAreFound) {
  const double ratio = 4.0;
  const double direction = 0.5;
  const auto density = [&](double x, double y) {
    const double along = std::cos(direction) * x + std::sin(direction) * y;
    const double across = std::cos(direction) * y - std::sin(direction) * x;
    return gaussianDensity(std::sqrt(ratio * along * along + across * across / ratio), 150e-9,
                           3e-9);
  };
  const cv::Mat large = surfaceOf(1024, 5, density);
  const MergedSpectrum spectrum = merged({part(large, 0, 0, 512), part(large, 512, 512, 512)});
  EXPECT_NEAR(spectrum.stretch.ratio / ratio, 1.0, 0.2);
  EXPECT_NEAR(std::remainder(spectrum.stretch.direction - direction, kPi), 0.0, 0.05);
}

TEST(MergedSpectrum, RoundSurfaceHasNoDirection) {
  for (int seed = 1; seed <= 8; ++seed) {
    const cv::Mat large = surfaceOf(512, seed, [](double x, double y) {
      return gaussianDensity(std::hypot(x, y), 100e-9, 3e-9);
    });
    EXPECT_EQ(merged({part(large, 0, 0, 512)}).stretch.ratio, 1.0) << "seed " << seed;
  }
}

TEST(MergedSpectrum, FlatScansShowNoRoughness) {
  EXPECT_THROW(merged({HeightMap(cv::Mat::zeros(64, 64, CV_64FC1), kPitch, kPitch)}), SurfaceError);
}

TEST(MergedSpectrum, ScansThatContradictEachOtherAreTold) {
  const auto density = [](double x, double y) {
    return gaussianDensity(std::hypot(x, y), 100e-9, 3e-9);
  };
  const cv::Mat large = surfaceOf(1024, 7, density);
  const auto third = [&](double times) {
    const HeightMap scan(times * part(large, 512, 512, 512).heights(), kPitch, kPitch);
    return spectrumDifferences({ScanWaves(part(large, 0, 0, 512)),
                                ScanWaves(part(large, 512, 0, 512)), ScanWaves(scan)})
        .back();
  };
  const SpectrumDifference same = third(1.0);
  EXPECT_LT(std::abs(same.logarithm), 4.0 * same.deviation);
  const SpectrumDifference twice = third(2.0);
  EXPECT_NEAR(twice.logarithm, std::log(4.0) + same.logarithm, 1e-6);
  EXPECT_NEAR(twice.deviation, same.deviation, 1e-9);
}

TEST(WaveTransfer, ofARoundSpectrumGoesByTheLengthOfItsWavesAlone) {
  const WaveTransfer& transfer = waveTransfer();
  const auto density = [](double count) { return std::pow(1.0 + count * count, -1.8); };
  std::vector<double> by_place;
  for (const double y : transfer.sources) {
    for (const double x : transfer.sources) by_place.push_back(density(std::hypot(x, y)));
  }
  std::vector<double> by_length;
  for (const double length : transfer.lengths) by_length.push_back(density(length));
  EXPECT_LT(12 * by_length.size(), 2 * by_place.size());
  const cv::Mat whole = transfer.shares * cv::Mat(by_place);
  const cv::Mat round = transfer.round_shares * cv::Mat(by_length);
  EXPECT_LT(cv::norm(whole, round, cv::NORM_INF),
            1e-12 * cv::norm(whole, cv::NORM_INF));  // round-off of the sums
}

}  // namespace
}  // namespace mems_stiction
