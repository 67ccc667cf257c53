/// Memory of the last frame is written over, but never under somebody's hands.

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "height_map/shared_pixels.hpp"

namespace mems_stiction {
namespace {

TEST(SharedPixels, OnesOwnMemoryIsUsedAgain) {
  cv::Mat pixels(3, 4, CV_64FC1, cv::Scalar(1.0));
  const uchar* const before = pixels.data;
  EXPECT_FALSE(isShared(pixels));
  makeWritable(pixels, 3, 4, CV_64FC1);
  EXPECT_EQ(pixels.data, before);
}

TEST(SharedPixels, WhatSomebodyHoldsStaysAsItIs) {
  cv::Mat pixels(3, 4, CV_64FC1, cv::Scalar(1.0));
  const cv::Mat held = pixels;
  EXPECT_TRUE(isShared(pixels));
  makeWritable(pixels, 3, 4, CV_64FC1);
  EXPECT_FALSE(isShared(pixels));
  pixels.setTo(2.0);
  EXPECT_EQ(cv::countNonZero(held != 1.0), 0);
}

TEST(SharedPixels, AnotherSizeOrTypeIsMade) {
  cv::Mat pixels;
  makeWritable(pixels, 3, 4, CV_64FC1);
  makeWritable(pixels, 5, 2, CV_8UC1);
  EXPECT_EQ(pixels.size(), cv::Size(2, 5));
  EXPECT_EQ(pixels.type(), CV_8UC1);
}

}  // namespace
}  // namespace mems_stiction
