#include "height_map/unmeasured.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "height_map/scan_sanity.hpp"

namespace mems_stiction {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

cv::Mat rough(int rows, int cols) {
  cv::Mat heights(rows, cols, CV_64FC1);
  cv::RNG(7).fill(heights, cv::RNG::NORMAL, 5e-9, 1e-9);
  return heights;
}

HeightMap mapOf(const cv::Mat& heights) { return {heights, 1e-8, 1e-8}; }

/// Pixels that were valid and are none now.
int leftOut(const cv::Mat& heights) {
  return cv::countNonZero(heights == heights) -
         cv::countNonZero(measuredPart(mapOf(heights)).heights() ==
                          measuredPart(mapOf(heights)).heights());
}

bool isShared(const cv::Mat& heights) {
  return measuredPart(mapOf(heights)).heights().data == heights.data;
}

TEST(StoppedLines, WhatAStoppedScanIsFilledWithIsMissing) {
  for (const int type : {CV_32FC1, CV_64FC1}) {
    for (const double filler : {0.0, -3.2e-5, 4e-9}) {
      cv::Mat heights;
      rough(48, 32).convertTo(heights, type);
      heights.rowRange(31, 48).setTo(filler);
      const HeightMap measured = measuredPart(mapOf(heights));
      EXPECT_EQ(leftOut(heights), 17 * 32);
      EXPECT_TRUE(std::isnan(measured.height(31, 0)) && std::isfinite(measured.height(30, 0)));
      EXPECT_EQ(
          heights.depth() == CV_32F ? static_cast<double>(heights.at<float>(47, 0))
                                    : heights.at<double>(47, 0),
          heights.depth() == CV_32F ? static_cast<double>(static_cast<float>(filler)) : filler)
          << "the pixels that came are as they were";
    }
  }
}

TEST(StoppedLines, TheLineThatItStoppedInKeepsWhatWasMeasured) {
  for (const int measured : {3, 10, 31}) {
    cv::Mat heights = rough(48, 32);
    heights.rowRange(31, 48).setTo(0.0);
    heights(cv::Range(30, 31), cv::Range(measured, 32)).setTo(0.0);
    EXPECT_EQ(leftOut(heights), 17 * 32 + (measured < 24 ? 32 - measured : 0)) << measured;
  }
}

TEST(StoppedLines, TheSlowAxisMayLieAlongXOrBeginAtEitherEnd) {
  cv::Mat heights = rough(20, 40);
  heights.colRange(0, 25).setTo(0.0);
  EXPECT_EQ(leftOut(heights), 25 * 20);
  heights = rough(20, 40);
  heights.row(0).setTo(-79e-6);
  EXPECT_EQ(leftOut(heights), 40);
}

TEST(StoppedLines, LinesLostInTheMiddleAreMissingToo) {
  cv::Mat heights = rough(40, 20);
  heights.row(7).setTo(2e-9);
  heights.rowRange(20, 23).setTo(0.0);
  EXPECT_EQ(leftOut(heights), 4 * 20);
}

TEST(StoppedLines, MissingPixelsAndLinesBetweenDoNotHideThem) {
  cv::Mat heights = rough(40, 20);
  heights.row(0).setTo(0.0);
  heights.rowRange(1, 3).setTo(kNone);
  heights.at<double>(0, 5) = kNone;
  EXPECT_EQ(leftOut(heights), 19);
}

TEST(StoppedLines, AMostlyEmptyScanIsFoundToo) {
  cv::Mat heights = rough(64, 64);
  heights.rowRange(3, 64).setTo(0.0);
  EXPECT_EQ(leftOut(heights), 61 * 64);
}

TEST(StoppedLines, QuantisedHeightsThatHoldTheFillerHereAndThereAreRough) {
  cv::Mat heights = rough(48, 64);
  for (auto pixel = heights.begin<double>(); pixel != heights.end<double>(); ++pixel)
    *pixel = std::round(*pixel / 0.5e-9) * 0.5e-9;
  heights.rowRange(40, 48).setTo(5e-9);  // the mean: one pixel of five has it
  EXPECT_EQ(leftOut(heights), 8 * 64);
}

TEST(StoppedLines, FlatFramesOfGeneratorsStayWhole) {
  EXPECT_TRUE(isShared(cv::Mat(20, 30, CV_64FC1, cv::Scalar(1e-9)))) << "constant";
  cv::Mat grating(40, 40, CV_64FC1);
  cv::Mat tilt(40, 40, CV_64FC1);
  cv::Mat cap(41, 41, CV_64FC1, cv::Scalar(0.0));
  cv::Mat step = cv::Mat::zeros(40, 40, CV_64FC1);
  step.rowRange(0, 13).setTo(1e-8);
  for (int i = 0; i < 41; ++i) {
    for (int j = 0; j < 41; ++j) {
      if (i < 40 && j < 40) grating.at<double>(i, j) = i / 5 % 2 == 0 ? 0.0 : 1e-8;
      if (i < 40 && j < 40) tilt.at<double>(i, j) = i * 1e-9;
      cap.at<double>(i, j) =
          std::max(0.0, 2e-8 - 1e-10 * ((i - 20) * (i - 20) + (j - 20) * (j - 20)));
    }
  }
  EXPECT_TRUE(isShared(grating) && isShared(grating.t()));
  EXPECT_TRUE(isShared(tilt) && isShared(tilt.t()));
  EXPECT_TRUE(isShared(step) && isShared(step.t()));
  EXPECT_TRUE(isShared(cap)) << "its plane goes on beside it";
  EXPECT_TRUE(isShared(cap(cv::Range(0, 20), cv::Range(0, 20)).clone())) << "a cap in the corner";
  EXPECT_TRUE(isShared(rough(1, 50)) && isShared(rough(50, 1)) &&
              isShared(cv::Mat(1, 50, CV_64FC1, cv::Scalar(1e-9))));
}

TEST(StoppedLines, FewPixelsOfOneValueAreChance) {
  cv::Mat heights = rough(40, kFewestStoppedPixels - 1);
  heights.row(39).setTo(0.0);
  EXPECT_TRUE(isShared(heights));
}

TEST(StoppedLines, ASoundScanIsShared) { EXPECT_TRUE(isShared(rough(64, 64))); }

TEST(StoppedLines, WhatWasNotMeasuredIsSaid) {
  cv::Mat heights = rough(48, 32);
  heights.rowRange(31, 48).setTo(0.0);
  const auto warnings = scanWarnings(measuredPart(mapOf(heights)));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].find("17 of 48 rows were not measured"), 0u) << warnings[0];
}

}  // namespace
}  // namespace mems_stiction
