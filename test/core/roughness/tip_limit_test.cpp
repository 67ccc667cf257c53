#include "roughness/tip_limit.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

constexpr double kPitch = 2e-9;
constexpr double kWavelength = 100e-9;
constexpr double kAmplitude = 5e-9;

HeightMap waves(int rows = 20, int cols = 400) {
  cv::Mat heights(rows, cols, CV_64FC1);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      heights.at<double>(row, col) =
          kAmplitude * std::cos(2.0 * CV_PI * col * kPitch / kWavelength);
    }
  }
  return {heights, kPitch, kPitch};
}

/// The sharpest summit of the waves over a stencil of this length [1/m].
double curvatureOver(double length) {
  const double reach = 0.5 * length;
  return 2.0 * kAmplitude * (1.0 - std::cos(2.0 * CV_PI * reach / kWavelength)) / (reach * reach);
}

TEST(TipLimit, IsWhereTheSummitsOfAWaveHaveHalfTheCurvatureOfTheTip) {
  for (const double length : {21e-9, 40e-9, 73e-9}) {
    const double radius = 0.5 / curvatureOver(length);
    EXPECT_NEAR(tipLimit(waves(), radius), length, 0.01 * length)
        << length;  // between pixels by a straight line
  }
}

TEST(TipLimit, IsNothingForASharpTipAndTheWidthForABluntOne) {
  EXPECT_EQ(tipLimit(waves(), 0.4 / curvatureOver(2.0 * kPitch)), 0.0);
  cv::Mat bowl(5, 40, CV_64FC1);
  for (int col = 0; col < 40; ++col)
    bowl.col(col).setTo(-0.5 * std::pow((col - 20) * kPitch, 2) / 1e-6);
  EXPECT_EQ(tipLimit({bowl, kPitch, kPitch}, 0.4e-6), 0.0);
  EXPECT_DOUBLE_EQ(tipLimit({bowl, kPitch, kPitch}, 0.6e-6), 40 * kPitch);
}

TEST(TipLimit, LeavesPitsAndMissingPixelsOut) {
  cv::Mat pits = waves().heights() * 0.01;
  pits.at<double>(3, 40) = -1e-6;
  pits.at<double>(5, 50) = std::numeric_limits<double>::quiet_NaN();
  const double with_pits = tipLimit({pits, kPitch, kPitch}, 10e-9);
  EXPECT_GT(with_pits, 0.0);  // the pit's rim is sharp
  pits.row(3).setTo(0.0);
  EXPECT_EQ(tipLimit({pits, kPitch, kPitch}, 10e-9), 0.0);
}

TEST(TipLimit, NeedsThreePixelsInARow) {
  EXPECT_TRUE(std::isnan(tipLimit(waves(20, 7), 1e-6)));
  const cv::Mat nothing(9, 9, CV_64FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(std::isnan(tipLimit({nothing, kPitch, kPitch}, 1e-6)));
}

}  // namespace
}  // namespace mems_stiction
