#include "mems_stiction/height_map/scan_sanity.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/analytic_surfaces.hpp"

namespace mems_stiction {
namespace {

bool mentions(const std::vector<std::string>& lines, const std::string& part) {
  for (const std::string& line : lines) {
    if (line.find(part) != std::string::npos) return true;
  }
  return false;
}

HeightMap wave(double pitch, double amplitude, double offset = 0.0) {
  return analytic::sum(analytic::sine(32, 48, pitch, pitch, amplitude, 3, 2),
                       analytic::flat(32, 48, pitch, pitch, offset));
}

TEST(ScanSanity, PlausibleScansGiveNoWarning) {
  EXPECT_TRUE(scanWarnings(wave(20e-9, 5e-9)).empty());
  EXPECT_TRUE(scanWarnings(analytic::asSingle(wave(20e-9, 5e-9))).empty());
  EXPECT_TRUE(scanWarnings(analytic::flat(8, 8, 1e-9, 1e-9)).empty());
}

TEST(ScanSanity, PitchOutsideOnePicometreToOneMillimetre) {
  EXPECT_TRUE(mentions(scanWarnings(wave(20.0, 5e-9)), "pitch_x 20 m is above 1 mm: probably nm or um"));
  EXPECT_TRUE(mentions(scanWarnings(wave(20e-15, 5e-24)), "pitch_y 2e-14 m is below 1 pm: probably converted"));
  EXPECT_FALSE(mentions(scanWarnings(wave(1e-3, 5e-9)), "pitch"));
  EXPECT_FALSE(mentions(scanWarnings(wave(1e-12, 5e-13)), "pitch"));
}

TEST(ScanSanity, HeightsInNanometresTakenForMetres) {
  EXPECT_TRUE(mentions(scanWarnings(wave(20e-9, 5.0)), "scan/height_scale"));
}

TEST(ScanSanity, StageOffsetThatSwallowsTheRoughness) {
  // float32 numbers near 5 mm are 0.47 nm apart; the sine's rms is 1 nm / sqrt(2).
  const HeightMap scan = wave(20e-9, 1e-9, 5e-3);
  EXPECT_TRUE(mentions(scanWarnings(analytic::asSingle(scan)), "stage offset"));
  EXPECT_TRUE(mentions(scanWarnings(analytic::asSingle(scan).asDouble()), "stage offset")) << "widened afterwards";
  EXPECT_TRUE(scanWarnings(scan).empty()) << "double all the way loses nothing";
}

TEST(ScanSanity, NoValidPixelIsLeftToThePrediction) {
  const HeightMap empty(cv::Mat(4, 4, CV_64FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN())), 1e-9, 1e-9);
  EXPECT_TRUE(scanWarnings(empty).empty());
}

}  // namespace
}  // namespace mems_stiction
