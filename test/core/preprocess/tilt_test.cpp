#include "preprocess/tilt.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "preprocess/level.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 10e-9;
constexpr double kWave = 1e-9;  // height of the waves [m]

HeightMap waves(int rows, int cols, double tilt, int depth = CV_64F) {
  cv::Mat heights(rows, cols, CV_64FC1);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      heights.at<double>(row, col) =
          kWave * std::sin(1.3 * row) * std::cos(0.7 * col) + tilt * (col + 0.5 * row) * kPitch;
    }
  }
  cv::Mat converted;
  heights.convertTo(converted, depth);
  return {converted, kPitch, kPitch};
}

TEST(Tilt, LevelScansNeedNoAdvice) {
  for (const int size : {8, 63, 64, 65, 300})
    EXPECT_FALSE(tiltOf(waves(size, 2 * size, 0.0)).isLarge()) << size;
  EXPECT_FALSE(tiltOf(HeightMap(cv::Mat::zeros(64, 64, CV_64FC1), kPitch, kPitch)).isLarge());
}

/// A ridge on a third of a level ground, as the plane through all pixels leaves it.
HeightMap pulledByARidge() {
  cv::Mat heights = waves(300, 300, 0.0).heights().clone();
  heights.colRange(0, 100) += 50e-9;
  return levelled({heights, kPitch, kPitch});
}

TEST(TiltLeft, SaysWhatTallFeaturesHavePulledAslant) {
  const TiltLeft left = tiltLeft(pulledByARidge(), 1);
  EXPECT_TRUE(left.isLarge());
  // the least-squares slope of a step of height h on a third of the width is 4/3 h, the rms of a
  // slope its twelfth's root
  EXPECT_NEAR(left.rms_height, 4.0 / 3.0 * 50e-9 / std::sqrt(12.0), 0.5e-9);
  EXPECT_NE(left.advice().find("set preprocessing/level_robust to true"), std::string::npos);
  EXPECT_EQ(left.advice().find(','), std::string::npos);
}

TEST(TiltLeft, IsNothingWithoutFeatures) {
  for (const int size : {8, 63, 300})
    EXPECT_FALSE(tiltLeft(levelled(waves(size, 2 * size, 0.02)), 1).isLarge()) << size;
  EXPECT_FALSE(
      tiltLeft(levelled(HeightMap(cv::Mat::zeros(64, 64, CV_64FC1), kPitch, kPitch)), 2).isLarge());
  const HeightMap nothing(
      cv::Mat(9, 9, CV_64FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN())), kPitch,
      kPitch);
  EXPECT_EQ(tiltLeft(nothing, 1).rms_height, 0.0);
}

TEST(Tilt, ATiltedScanIsToldWhatItsPlaneTakes) {
  for (const int depth : {CV_32F, CV_64F}) {
    const Tilt tilt = tiltOf(waves(300, 200, 0.01, depth));
    EXPECT_TRUE(tilt.isLarge());
    EXPECT_NEAR(tilt.levelled_rms_height, 0.5 * kWave, 0.05 * kWave);
    const double plane = 0.01 * kPitch * std::hypot(200.0, 0.5 * 300.0) / std::sqrt(12.0);
    EXPECT_NEAR(tilt.rms_height, std::hypot(plane, tilt.levelled_rms_height), 0.02 * plane);
    EXPECT_NE(tilt.advice().find("set preprocessing/level to plane"), std::string::npos);
    EXPECT_EQ(tilt.advice().find(','), std::string::npos);
  }
}

TEST(Tilt, WhatIsNotMeasuredHasNoSay) {
  cv::Mat heights = waves(128, 128, 0.01).heights().clone();
  heights.rowRange(0, 60).setTo(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(tiltOf(HeightMap(heights, kPitch, kPitch)).isLarge());
  heights.setTo(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(tiltOf(HeightMap(heights, kPitch, kPitch)).isLarge());
  EXPECT_FALSE(tiltOf(HeightMap(cv::Mat::zeros(1, 1, CV_32FC1), kPitch, kPitch)).isLarge());
}

}  // namespace
}  // namespace mems_stiction
