/// The picture of the prepared scan that the node publishes: which pixels it shows, and in which
/// shape.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "ros/display_conversion.hpp"

namespace mems_stiction {
namespace {

TEST(Preview, IsAPictureOfTheValidPixels) {
  cv::Mat heights(6, 10, CV_32FC1);
  for (int row = 0; row < 6; ++row) {
    for (int col = 0; col < 10; ++col)
      heights.at<float>(row, col) = static_cast<float>(1e-9 * (10 * row + col));
  }
  heights.at<float>(0, 0) = std::nanf("");
  heights.at<float>(5, 9) = HUGE_VALF;
  std_msgs::Header header;
  header.frame_id = "stage";
  DisplayOptions display;
  const HeightMap surface(heights, 1e-8, 1e-8);
  const sensor_msgs::Image image = previewImage(surface, header, display);
  EXPECT_EQ(image.encoding, "mono8");
  EXPECT_EQ(image.header.frame_id, "stage");
  ASSERT_EQ(image.data.size(), 60U);
  EXPECT_EQ(image.step, 10U);
  EXPECT_EQ(image.data[0], 0);   // not measured
  EXPECT_EQ(image.data[59], 0);  // not a number of metres
  EXPECT_EQ(image.data[1], 1);   // the lowest
  EXPECT_EQ(image.data[58], 255);
  for (int i = 2; i < 58; ++i) EXPECT_GT(image.data[i], image.data[i - 1]) << i;

  display.max_preview_size = 4;  // every third pixel
  const sensor_msgs::Image thinned = previewImage(surface, header, display);
  EXPECT_EQ(thinned.width, 4U);
  EXPECT_EQ(thinned.height, 2U);
  EXPECT_EQ(thinned.data.size(), 8U);
  EXPECT_EQ(thinned.data[0], 0);

  const cv::Mat nothing(4, 4, CV_32FC1, cv::Scalar(std::nanf("")));
  for (const std::uint8_t pixel :
       previewImage(HeightMap(nothing, 1e-8, 1e-8), header, display).data) {
    EXPECT_EQ(pixel, 0);
  }
}

/// Heights 0, 1, 2 ... nm from left to right.
HeightMap ramp(int rows, int cols) {
  cv::Mat heights(rows, cols, CV_64FC1);
  for (int col = 0; col < cols; ++col) heights.col(col).setTo(1e-9 * col);
  return {heights, 1e-8, 1e-8};
}

TEST(Preview, AStatedRangeIsTheSameForEveryScan) {
  DisplayOptions display;
  display.preview_range = 20e-9;
  for (const double lift : {0.0, 3e-6}) {
    const HeightMap surface(ramp(5, 5).heights() + lift, 1e-8, 1e-8);
    const sensor_msgs::Image image = previewImage(surface, {}, display);
    for (int col = 0; col < 5; ++col) {  // 2 nm on either side of the mean, of 10
      EXPECT_NEAR(image.data[static_cast<std::size_t>(col)], 128.0 + 12.7 * (col - 2), 0.6) << col;
    }
  }
  const sensor_msgs::Image beyond = previewImage(ramp(1, 101), {}, display);
  EXPECT_EQ(beyond.data[0], 1);
  EXPECT_EQ(beyond.data[100], 255);
}

TEST(Preview, ABarSaysWhichGreyIsWhichHeight) {
  DisplayOptions display;
  const sensor_msgs::Image alone = previewImage(ramp(100, 60), {}, display);
  display.preview_bar = true;
  const sensor_msgs::Image image = previewImage(ramp(100, 60), {}, display);
  ASSERT_EQ(image.height, 100U);
  ASSERT_GT(image.width, 60U + 12U);
  ASSERT_EQ(image.data.size(), static_cast<std::size_t>(image.step) * image.height);
  EXPECT_EQ(image.step, image.width);
  const auto at = [&](std::size_t row, std::size_t col) {
    return image.data[row * image.step + col];
  };
  for (std::size_t row = 0; row < 100; ++row) {
    for (std::size_t col = 0; col < 60; ++col) ASSERT_EQ(at(row, col), alone.data[row * 60 + col]);
    EXPECT_NEAR(at(row, 60 + 8), 255.0 - 254.0 * static_cast<double>(row) / 99.0, 0.6);
  }
  int text = 0;
  for (std::size_t row = 0; row < 100; ++row) {
    for (std::size_t col = 60 + 20; col < image.width; ++col) text += at(row, col) > 128 ? 1 : 0;
  }
  EXPECT_GT(text, 60) << "numbers at both ends and in the middle";
  EXPECT_GE(previewImage(ramp(3, 60), {}, display).height, 40U) << "room for the numbers";
}

/// A disc of height 1 nm and of the given diameter in the middle of a plane of 0.6 um.
HeightMap disc(double diameter, double pitch_x, double pitch_y) {
  const double size = 0.6e-6;
  cv::Mat heights(static_cast<int>(std::lround(size / pitch_y)),
                  static_cast<int>(std::lround(size / pitch_x)), CV_64FC1);
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      const double x = (col + 0.5) * pitch_x - 0.5 * size;
      const double y = (row + 0.5) * pitch_y - 0.5 * size;
      heights.at<double>(row, col) = std::hypot(x, y) < 0.5 * diameter ? 1e-9 : 0.0;
    }
  }
  return {heights, pitch_x, pitch_y};
}

/// Columns and rows of the picture over which bright pixels reach.
struct Reach {
  int cols = 0;
  int rows = 0;
};

Reach reachOf(const sensor_msgs::Image& image) {
  std::vector<int> cols(image.width), rows(image.height);
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    if (image.data[i] < 128) continue;
    cols[i % image.width] = 1;
    rows[i / image.width] = 1;
  }
  return {static_cast<int>(cv::countNonZero(cols)), static_cast<int>(cv::countNonZero(rows))};
}

TEST(Preview, ADiscIsRoundWhateverThePitches) {
  for (const auto& [pitch_x, pitch_y] :
       {std::pair(2e-9, 10e-9), std::pair(12e-9, 3e-9), std::pair(4e-9, 5e-9)}) {
    for (const int most : {1024, 120}) {
      DisplayOptions display;
      display.max_preview_size = most;
      const sensor_msgs::Image image = previewImage(disc(0.3e-6, pitch_x, pitch_y), {}, display);
      EXPECT_EQ(image.width, image.height) << "the frame is a square";
      EXPECT_LE(image.width, static_cast<std::uint32_t>(most));
      EXPECT_EQ(image.data.size(), image.width * image.height);
      const Reach reach = reachOf(image);
      const double pixel = 0.6e-6 / image.width;
      // the edge of the disc is known to a pixel of the scan, on both sides
      EXPECT_NEAR(reach.cols * pixel, 0.3e-6, 2.0 * std::max(pitch_x, pixel));
      EXPECT_NEAR(reach.rows * pixel, 0.3e-6, 2.0 * std::max(pitch_y, pixel));
    }
  }
}

TEST(Preview, AFrameOfOneLongLineKeepsItsSize) {
  DisplayOptions display;
  display.max_preview_size = 100;
  const HeightMap surface(cv::Mat::zeros(2, 1000, CV_64FC1), 1e-6, 1e-9);
  const sensor_msgs::Image image = previewImage(surface, {}, display);
  EXPECT_EQ(image.width, 100U);
  EXPECT_EQ(image.height, 1U);
  const sensor_msgs::Image slip =
      previewImage(HeightMap(cv::Mat::zeros(4, 4, CV_64FC1), 20.0, 1e-15), {}, display);
  EXPECT_EQ(slip.width, 100U);
  EXPECT_EQ(slip.height, 1U);
}

}  // namespace
}  // namespace mems_stiction
