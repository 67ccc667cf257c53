#include "mems_stiction/height_map/raw_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

ScanOptions options(double scale = 1.0, double offset = 0.0) {
  ScanOptions result;
  result.pitch_x = 2e-9;
  result.pitch_y = 3e-9;
  result.height_scale = scale;
  result.height_offset = offset;
  return result;
}

TEST(RawScan, FloatPixelsInMetresAreShared) {
  const cv::Mat single(3, 4, CV_32FC1, cv::Scalar(1e-9));
  const cv::Mat wide(3, 4, CV_64FC1, cv::Scalar(1e-9));
  EXPECT_EQ(heightMapFromPixels(single, options()).heights().data, single.data);
  EXPECT_EQ(heightMapFromPixels(wide, options()).heights().data, wide.data);
}

TEST(RawScan, PitchIsThatOfColumnsAndRows) {
  const HeightMap map = heightMapFromPixels(cv::Mat::zeros(3, 4, CV_32FC1), options());
  EXPECT_EQ(map.rows(), 3);
  EXPECT_EQ(map.cols(), 4);
  EXPECT_EQ(map.pitchX(), 2e-9);
  EXPECT_EQ(map.pitchY(), 3e-9);
}

TEST(RawScan, EveryAcceptedTypeIsScaledInDouble) {
  for (const int type : {CV_32FC1, CV_64FC1, CV_16UC1, CV_16SC1, CV_8UC1}) {
    cv::Mat pixels(2, 3, CV_64FC1);
    for (int row = 0; row < 2; ++row) {
      for (int col = 0; col < 3; ++col) pixels.at<double>(row, col) = 10 * row + col;
    }
    pixels.convertTo(pixels, type);
    const HeightMap map = heightMapFromPixels(pixels, options(0.5e-9, 7e-9));
    ASSERT_EQ(map.heights().type(), CV_64FC1);
    for (int row = 0; row < 2; ++row) {
      // Exactly the formula, so exactly its value.
      for (int col = 0; col < 3; ++col)
        EXPECT_EQ(map.height(row, col), (10 * row + col) * 0.5e-9 + 7e-9) << type;
    }
  }
}

TEST(RawScan, NegativeCountsStayNegative) {
  const cv::Mat pixels(2, 2, CV_16SC1, cv::Scalar(-32768));
  EXPECT_EQ(heightMapFromPixels(pixels, options(1e-9)).height(1, 1), -32768 * 1e-9);
}

TEST(RawScan, InvalidValueIsTheRawPixelNotTheHeight) {
  cv::Mat pixels = (cv::Mat_<std::uint16_t>(1, 3) << 0, 5, 65535);
  ScanOptions with_invalid = options(2e-9, 1e-9);
  with_invalid.invalid_value = 65535;
  const HeightMap map = heightMapFromPixels(pixels, with_invalid);
  EXPECT_EQ(map.height(0, 0), 1e-9);
  EXPECT_TRUE(std::isnan(map.height(0, 2)));
}

TEST(RawScan, InvalidValueMeetsItsFloat32Neighbour) {
  cv::Mat pixels = (cv::Mat_<float>(1, 2) << -9999.9F, 1e-9F);
  ScanOptions with_invalid = options();
  with_invalid.invalid_value = -9999.9;  // no float32
  const HeightMap map = heightMapFromPixels(pixels, with_invalid);
  EXPECT_TRUE(std::isnan(map.height(0, 0)));
  EXPECT_EQ(map.height(0, 1), static_cast<double>(1e-9F));
}

TEST(RawScan, InvalidValueOutsideThePixelTypeMatchesNothing) {
  ScanOptions with_invalid = options();
  with_invalid.invalid_value = -1e300;
  EXPECT_EQ(heightMapFromPixels(cv::Mat::ones(2, 2, CV_8UC1), with_invalid).height(0, 0), 1.0);
  EXPECT_EQ(heightMapFromPixels(cv::Mat::ones(2, 2, CV_32FC1), with_invalid).height(0, 0), 1.0);
}

TEST(RawScan, QualityChannelOnlyCountsWhenNotANumber) {
  cv::Mat pixels(1, 2, CV_32FC2);
  pixels.at<cv::Vec2f>(0, 0) = {1e-9F, 0.1F};
  pixels.at<cv::Vec2f>(0, 1) = {2e-9F, std::nanf("")};
  const HeightMap map = heightMapFromPixels(pixels, options());
  EXPECT_EQ(map.height(0, 0), static_cast<double>(1e-9F));
  EXPECT_TRUE(std::isnan(map.height(0, 1)));
}

TEST(RawScan, RowsWithPaddingAreRead) {
  cv::Mat wide(4, 8, CV_16UC1);
  for (int row = 0; row < 4; ++row) {
    for (int col = 0; col < 8; ++col)
      wide.at<std::uint16_t>(row, col) = static_cast<std::uint16_t>(10 * row + col);
  }
  const HeightMap map = heightMapFromPixels(wide(cv::Rect(2, 1, 3, 2)), options());
  EXPECT_EQ(map.height(0, 0), 12.0);
  EXPECT_EQ(map.height(1, 2), 24.0);
}

TEST(RawScan, OtherTypesAreRefusedWithTheList) {
  for (const int type : {CV_8UC3, CV_32SC1, CV_32FC3, CV_64FC2, CV_8SC1}) {
    try {
      heightMapFromPixels(cv::Mat::zeros(2, 2, type), options());
      FAIL() << "type " << type << " was accepted";
    } catch (const SurfaceError& error) {
      EXPECT_NE(std::string(error.what()).find("32FC1, 64FC1"), std::string::npos) << error.what();
    }
  }
}

TEST(RawScan, EmptyImageAndMissingPitchAreRefused) {
  EXPECT_THROW(heightMapFromPixels(cv::Mat(), options()), SurfaceError);
  for (const double pitch : {0.0, -1e-9, std::nan(""), HUGE_VAL}) {
    ScanOptions bad = options();
    bad.pitch_y = pitch;
    EXPECT_THROW(heightMapFromPixels(cv::Mat::zeros(2, 2, CV_32FC1), bad), SurfaceError) << pitch;
  }
}

}  // namespace
}  // namespace mems_stiction
