#include "height_map/scan_sanity.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"

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

/// The only line about a scan; empty if there is none, all of them where there are several.
std::string said(const HeightMap& scan) {
  std::string text;
  for (const std::string& line : scanWarnings(scan)) text += (text.empty() ? "" : "\n") + line;
  return text;
}

HeightMap rough(double pitch_x, double pitch_y, double rms_height,
                double correlation_pixels = 8.0) {
  GaussianSurfaceOptions options;
  options.rows = 64;
  options.cols = 96;
  options.pitch_x = pitch_x;
  options.pitch_y = pitch_y;
  options.rms_height = rms_height;
  options.correlation_length_x = correlation_pixels * pitch_x;
  options.correlation_length_y = correlation_pixels * pitch_y;
  return gaussianSurface(options);
}

HeightMap tilted(const HeightMap& scan, double slope) {
  cv::Mat heights = scan.asDouble().heights().clone();
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col)
      heights.at<double>(row, col) += slope * col * scan.pitchX();
  }
  return {heights, scan.pitchX(), scan.pitchY()};
}

TEST(ScanSanity, PlausibleScansGiveNoWarning) {
  EXPECT_EQ(said(wave(20e-9, 5e-9)), "");
  EXPECT_EQ(said(analytic::asSingle(wave(20e-9, 5e-9))), "");
  // from atoms on mica to a lapped part under an interferometer
  EXPECT_EQ(said(rough(2e-10, 2e-10, 3e-11)), "");
  EXPECT_EQ(said(rough(10e-9, 10e-9, 0.4e-9)), "");
  EXPECT_EQ(said(rough(10e-9, 10e-9, 20e-9)), "");
  EXPECT_EQ(said(rough(0.2e-6, 0.2e-6, 7e-9)), "");
  EXPECT_EQ(said(rough(5e-6, 5e-6, 50e-9)), "");
  EXPECT_EQ(said(rough(13e-6, 13e-6, 0.5e-6)), "");
  EXPECT_EQ(said(rough(2e-6, 100e-6, 0.5e-6)), "") << "lines of a profilometer";
  EXPECT_EQ(said(tilted(rough(20e-9, 20e-9, 3e-9), 0.3)), "") << "as it leaves the instrument";
}

TEST(ScanSanity, PitchOutsideOnePicometreToOneMillimetre) {
  EXPECT_TRUE(
      mentions(scanWarnings(wave(20.0, 5e-9)), "pitch_x 20 m is above 1 mm: probably nm or um"));
  EXPECT_TRUE(mentions(scanWarnings(wave(20.0, 5e-9)), "was 2e-08 m meant?"));
  EXPECT_TRUE(mentions(scanWarnings(wave(20e-15, 5e-24)),
                       "pitch_y 2e-14 m is below 1 pm: probably converted"));
  EXPECT_FALSE(mentions(scanWarnings(wave(1e-3, 5e-3)), "pitch"));
  EXPECT_FALSE(mentions(scanWarnings(wave(1e-12, 5e-13)), "pitch"));
}

TEST(ScanSanity, APitchThatIsAThousandTimesTooLargeOrSmall) {
  for (const double rms_height : {0.4e-9, 3e-9, 12e-9}) {
    const std::string large = said(rough(20e-6, 20e-6, rms_height));
    EXPECT_NE(large.find("at a pitch of 2e-05 m it is 0.002 to 10"), std::string::npos) << large;
    EXPECT_NE(large.find("the pitch of 2e-05 m (was 2e-08 m meant?)"), std::string::npos) << large;
    const std::string small = said(rough(20e-12, 20e-12, rms_height));
    EXPECT_NE(small.find("the pitch of 2e-11 m (was 2e-08 m meant?)"), std::string::npos) << small;
  }
  EXPECT_NE(said(tilted(rough(20e-6, 20e-6, 3e-9), 0.3)), "") << "a tilt is no roughness";
}

TEST(ScanSanity, PixelsFarLongerThanWide) {
  const std::string tall = said(rough(20e-9, 20e-6, 3e-9));
  EXPECT_NE(tall.find("pitch_x 2e-08 m and pitch_y 2e-05 m: pixels 1000 times as long as wide"),
            std::string::npos)
      << tall;
  EXPECT_NE(tall.find("instead of 2e-05 m was 2e-08 m meant?"), std::string::npos) << tall;
  const std::string wide = said(rough(2e-12, 2e-9, 1e-9));
  EXPECT_NE(wide.find("instead of 2e-12 m was 2e-09 m meant?"), std::string::npos) << wide;
}

TEST(ScanSanity, HeightsInNanometresTakenForMetres) {
  EXPECT_TRUE(mentions(scanWarnings(wave(20e-9, 5.0)), "scan/height_scale"));
  EXPECT_TRUE(mentions(scanWarnings(rough(20e-9, 20e-9, 3e-6)), "heights range over"));
  const std::string steep = said(rough(2e-7, 2e-7, 15e-6, 4.0));  // as wide as high: not more
  EXPECT_NE(steep.find("scan/height_scale"), std::string::npos) << steep;
}

TEST(ScanSanity, HeightsInMetresThatWereScaledAgain) {
  for (const double factor : {1e-3, 1e-6, 1e-9}) {
    const std::string line = said(rough(20e-9, 20e-9, 5e-9 * factor));
    EXPECT_NE(line.find("rms slope"), std::string::npos) << line;
    EXPECT_NE(line.find("times as large (scan/height_scale on heights in metres)"),
              std::string::npos)
        << line;
  }
  EXPECT_NE(said(rough(20e-9, 20e-9, 5e-18)).find("1e+09 times as large"), std::string::npos);
}

TEST(ScanSanity, FramesThatSayNothingAboutRoughness) {
  for (const cv::Size size :
       {cv::Size(1, 1), cv::Size(512, 1), cv::Size(1, 512), cv::Size(512, 7)}) {
    const HeightMap frame(cv::Mat::eye(size, CV_64FC1) * 1e-9, 20e-9, 20e-9);
    const std::string line = said(frame);
    EXPECT_NE(line.find("a frame of " + std::to_string(size.width) + " x " +
                        std::to_string(size.height) + " pixels"),
              std::string::npos)
        << line;
  }
  EXPECT_NE(said(analytic::flat(64, 64, 1e-9, 1e-9, 3e-9))
                .find("every height is 3e-09 m says nothing about roughness"),
            std::string::npos);
  EXPECT_NE(said(tilted(analytic::flat(64, 64, 20e-9, 20e-9), 0.1)).find("rms slope"),
            std::string::npos)
      << "a plane";
}

TEST(ScanSanity, NoCommaStandsInAWarning) {  // `rostopic echo -p` puts commas between fields
  for (const HeightMap& scan :
       {wave(20.0, 5.0), wave(20e-15, 5e-9), wave(20e-6, 5e-9), rough(2e-8, 2e-5, 3e-9),
        analytic::flat(4, 4, 1e-9, 1e-9), analytic::asSingle(wave(20e-9, 1e-9, 5e-3))}) {
    EXPECT_NE(said(scan), "");
    EXPECT_EQ(said(scan).find(','), std::string::npos) << said(scan);
  }
}

TEST(ScanSanity, StageOffsetThatSwallowsTheRoughness) {
  // float32 numbers near 5 mm are 0.47 nm apart; the sine's rms is 1 nm / sqrt(2).
  const HeightMap scan = wave(20e-9, 1e-9, 5e-3);
  EXPECT_TRUE(mentions(scanWarnings(analytic::asSingle(scan)), "stage offset"));
  EXPECT_TRUE(mentions(scanWarnings(analytic::asSingle(scan).asDouble()), "stage offset"))
      << "widened afterwards";
  EXPECT_TRUE(scanWarnings(scan).empty()) << "double all the way loses nothing";
}

TEST(ScanSanity, NoValidPixelIsLeftToThePrediction) {
  const HeightMap empty(
      cv::Mat(4, 4, CV_64FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN())), 1e-9, 1e-9);
  EXPECT_TRUE(scanWarnings(empty).empty());
}

}  // namespace
}  // namespace mems_stiction
