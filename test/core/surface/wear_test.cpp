#include "surface/wear.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

HeightMap mapOf(const cv::Mat& heights) { return {heights, 1e-8, 1e-8}; }

TEST(Wear, theSameSurfacesAgainAreThoseThatWereLeftToTheBit) {
  const SurfacePair made(mapOf((cv::Mat_<double>(1, 3) << 0.1, 0.7, -0.3)));
  const cv::Mat lower = (cv::Mat_<double>(1, 3) << 0.1, 1.0 / 3.0, -0.3);
  const cv::Mat upper = (cv::Mat_<double>(1, 3) << 0.0, 1.0 / 7.0, 0.0);
  Wear wear;
  EXPECT_TRUE(wear.empty());
  EXPECT_TRUE(wear.on(made).upperIsPlane());
  wear.add(made, lower, upper);
  EXPECT_EQ(cv::norm(wear.on(made).lower.heights(), lower, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(wear.on(made).upper.heights(), upper, cv::NORM_INF), 0.0);
}

TEST(Wear, anotherScanLosesWhatWasPressedIn) {
  const SurfacePair made(mapOf((cv::Mat_<double>(1, 2) << 1.0, 5.0)));
  Wear wear;
  wear.add(made, (cv::Mat_<double>(1, 2) << 1.0, 4.0), cv::Mat::zeros(1, 2, CV_64FC1));
  const SurfacePair later = wear.on({mapOf((cv::Mat_<double>(1, 2) << 2.0, 6.0))});
  EXPECT_EQ(later.lower.height(0, 0), 2.0);
  EXPECT_EQ(later.lower.height(0, 1), 5.0);
  EXPECT_TRUE(later.upperIsPlane()) << "nothing has flowed there";
}

TEST(Wear, pixelsThatOneScanLacksKeepTheirMark) {
  const SurfacePair made(mapOf((cv::Mat_<double>(1, 3) << 1.0, 5.0, kNone)));
  Wear wear;
  wear.add(made, (cv::Mat_<double>(1, 3) << 1.0, 4.0, kNone), cv::Mat::zeros(1, 3, CV_64FC1));
  const SurfacePair holed(mapOf((cv::Mat_<double>(1, 3) << 1.0, kNone, 3.0)));
  EXPECT_TRUE(std::isnan(wear.on(holed).lower.height(0, 1)));
  EXPECT_EQ(wear.on(holed).lower.height(0, 2), 3.0) << "was never in contact";
  wear.add(holed, (cv::Mat_<double>(1, 3) << 0.5, kNone, 3.0), cv::Mat::zeros(1, 3, CV_64FC1));
  const SurfacePair whole = wear.on({mapOf((cv::Mat_<double>(1, 3) << 1.0, 5.0, 3.0))});
  EXPECT_EQ(whole.lower.height(0, 0), 0.5);
  EXPECT_EQ(whole.lower.height(0, 1), 4.0);
}

/// cv::compare() calls NaN equal to itself where it takes several pixels at once.
TEST(Wear, pixelsThatOneScanLacksKeepTheirHeightsInLongRowsToo) {
  cv::Mat heights(4, 100, CV_64FC1, cv::Scalar(5.0));
  cv::Mat left = heights.clone();
  left.at<double>(0, 0) = 4.0;
  left.row(2).setTo(kNone);
  cv::Mat as_made = heights.clone();
  as_made.row(2).setTo(kNone);
  Wear wear;
  wear.add({mapOf(as_made)}, left, cv::Mat::zeros(4, 100, CV_64FC1));
  const HeightMap worn = wear.on({mapOf(heights)}).lower;
  EXPECT_EQ(worn.height(0, 0), 4.0);
  for (int col = 0; col < 100; ++col) EXPECT_EQ(worn.height(2, col), 5.0) << "was never in contact";
}

TEST(Wear, anotherSizeIsAnotherSurface) {
  Wear wear;
  wear.add({mapOf(cv::Mat::ones(2, 2, CV_64FC1))}, cv::Mat::zeros(2, 2, CV_64FC1),
           cv::Mat::zeros(2, 2, CV_64FC1));
  EXPECT_EQ(wear.on({mapOf(cv::Mat::ones(3, 3, CV_32FC1))}).lower.height(0, 0), 1.0);
}

}  // namespace
}  // namespace mems_stiction
