#include "height_map/unmeasured.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mems_stiction {
namespace {

TEST(Sentinels, FiniteNumbersBeyondAHeightAreInvalid) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const int type : {CV_32FC1, CV_64FC1}) {
    const cv::Mat_<float> single =
        (cv::Mat_<float>(2, 4) << 1e-9F, 1e21F, -1e38F, NAN, 9e19F, -9e19F, infinity, -infinity);
    cv::Mat heights;
    single.convertTo(heights, type);
    const HeightMap surface = withoutSentinels(HeightMap(heights, 2e-9, 3e-9));
    EXPECT_EQ(cv::countNonZero(sentinelMask(heights)), 2);  // the pixels that came are as they were
    EXPECT_TRUE(std::isnan(surface.height(0, 1)) && std::isnan(surface.height(0, 2)));
    EXPECT_EQ(surface.height(0, 0), static_cast<double>(1e-9F));
    EXPECT_EQ(surface.height(1, 0), static_cast<double>(9e19F));
    EXPECT_EQ(surface.height(1, 1), static_cast<double>(-9e19F));
    EXPECT_EQ(heightStatistics(surface).valid_count, 3);
    EXPECT_EQ(surface.pitchX(), 2e-9);
    EXPECT_EQ(surface.pitchY(), 3e-9);
  }
}

TEST(Sentinels, ASurfaceWithoutThemIsShared) {
  const HeightMap whole(cv::Mat(2, 3, CV_32FC1, cv::Scalar(1e-9)), 1e-9, 1e-9);
  EXPECT_EQ(withoutSentinels(whole).heights().data, whole.heights().data);
  const HeightMap missing(cv::Mat(2, 3, CV_64FC1, cv::Scalar(NAN)), 1e-9, 1e-9);
  EXPECT_EQ(withoutSentinels(missing).heights().data, missing.heights().data);
}

}  // namespace
}  // namespace mems_stiction
