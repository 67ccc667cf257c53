/// A device whose counter-surface fits its scans: so do the surfaces that are made of it.

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "evaluation/device_scans.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/constants.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

constexpr int kSide = 192;
constexpr double kPitch = 10e-9;

HeightMap scanned(int seed) {
  return samples::gaussian(kSide, kSide, kPitch, kPitch, 4e-9, 60e-9, seed);
}

Configuration fitting(double correlation, double length = 0.0) {
  Configuration configuration;
  configuration.counter_surface.type = CounterSurfaceType::kGaussian;
  configuration.counter_surface.gaussian.gaussian.rms_height = 3e-9;
  configuration.counter_surface.gaussian.gaussian.correlation_length_x = 60e-9;
  configuration.counter_surface.gaussian.gaussian.correlation_length_y = 60e-9;
  configuration.counter_surface.correlation = correlation;
  configuration.counter_surface.correlation_length = length;
  configuration.device.contact_area = kSide * kSide * kPitch * kPitch;
  return configuration;
}

DeviceScans scansOf(const Configuration& configuration) {
  ScanPreparer preparer(configuration);
  DeviceScans scans(configuration);
  for (const int seed : {1, 2, 3, 4})
    scans.add("scan " + std::to_string(seed), preparer.prepare(scanned(seed)));
  return scans;
}

/// Mean square of the waves of a band, of a frame that goes on by its reflections [m^2].
double squareOf(const cv::Mat& heights, double shortest, double longest) {
  cv::Mat waves;
  heights.convertTo(waves, CV_64F);
  cv::dct(waves, waves);
  double sum = 0.0;
  for (int row = 0; row < waves.rows; ++row) {
    for (int col = 0; col < waves.cols; ++col) {
      const double wave_number = kPi * std::hypot(row, col) / (kSide * kPitch);
      if (wave_number > 2.0 * kPi / longest && wave_number <= 2.0 * kPi / shortest)
        sum += std::pow(waves.at<double>(row, col), 2.0);
    }
  }
  return sum / static_cast<double>(waves.total());
}

/// The same of the surfaces that are made of a device, on average.
double madeSquare(const DeviceScans& scans, double shortest, double longest) {
  constexpr int kSurfaces = 6;
  double sum = 0.0;
  for (int number = 0; number < kSurfaces; ++number) {
    DividedSurface divided = scans.surface(number, std::nullopt);
    cv::Mat relief(kSide, kSide, CV_32FC1);
    divided.surface().heights(0, 0, relief);
    sum += squareOf(relief, shortest, longest) / kSurfaces;
  }
  return sum;
}

TEST(CorrelatedDevice, madeSurfacesHaveTheCorrelationByBand) {
  const double length = 200e-9;
  const DeviceScans apart = scansOf(fitting(0.0));
  const DeviceScans fit = scansOf(fitting(0.8, length));
  // of one law: each band of both is that of s1^2 + s2^2, or of s1^2 + s2^2 - 2 rho s1 s2
  const double share = (16.0 + 9.0 - 2.0 * 0.8 * 12.0) / (16.0 + 9.0);
  EXPECT_NEAR(std::sqrt(madeSquare(fit, length, 600e-9) / madeSquare(apart, length, 600e-9)),
              std::sqrt(share), 0.12);
  EXPECT_NEAR(
      std::sqrt(madeSquare(fit, 100e-9, 0.7 * length) / madeSquare(apart, 100e-9, 0.7 * length)),
      1.0, 0.12);
}

TEST(CorrelatedDevice, eachScanHasACounterSurfaceThatFitsIt) {
  ScanPreparer preparer(fitting(0.9));
  for (const int seed : {1, 2, 1}) {
    const PreparedScan prepared = preparer.prepare(scanned(seed));
    const cv::Mat between = prepared.surfaces.lower.heights() - prepared.surfaces.upper.heights();
    EXPECT_NEAR(heightStatistics(HeightMap(between, kPitch, kPitch)).rms_height,
                std::sqrt(16.0 + 9.0 - 2.0 * 0.9 * 12.0) * 1e-9, 0.25e-9)
        << seed;
  }
}

TEST(CorrelatedDevice, aMeasuredCounterSurfaceIsNotMadeToFit) {
  Configuration configuration = fitting(0.8);
  configuration.counter_surface.facing = CounterSurfaceFacing::kDown;
  DeviceScans scans(configuration);
  try {
    scans.addCounterSurface("upper", scanned(5));
    FAIL() << "no error";
  } catch (const OptionsError& error) {
    EXPECT_NE(std::string(error.what()).find("counter_surface/correlation: 0.8 is not allowed"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace mems_stiction
