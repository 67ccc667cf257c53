/// Points of messages in every layout.

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "ros/source/cloud_cases.hpp"
#include "source/cloud_points.hpp"

namespace mems_stiction {
namespace {

TEST(CloudPoints, EveryLayoutGivesThePoints) {
  const cv::Mat points = clouds::orderedPoints(false, true, false);
  // x, y, z alone; PCL's PointXYZ and PointXYZI; double; behind other fields; rows with padding
  for (const clouds::Layout& layout :
       {clouds::Layout{false, false, 0, 0, 0}, clouds::Layout{false, false, 0, 16, 0},
        clouds::Layout{false, true, 0, 32, 0}, clouds::Layout{true, false, 0, 0, 0},
        clouds::Layout{true, true, 5, 40, 7}, clouds::Layout{false, false, 3, 16, 13}}) {
    cv::Mat expected = points;
    if (!layout.is_double) {
      points.convertTo(expected, CV_32F);
      expected.convertTo(expected, CV_64F);
    }
    const cv::Mat read = cloudPoints(clouds::message(points, layout));
    EXPECT_EQ(cv::norm(read, expected, cv::NORM_INF), 0.0)
        << layout.first << " " << layout.point_step;
  }
}

TEST(CloudPoints, OtherFieldsBeforeAndBetweenDoNotMatter) {
  sensor_msgs::PointCloud2 cloud =
      clouds::message(clouds::orderedPoints(false, false, false), {false, false, 4, 24, 0});
  sensor_msgs::PointField intensity;
  intensity.name = "intensity";
  intensity.offset = 0;
  intensity.datatype = sensor_msgs::PointField::UINT16;
  cloud.fields.insert(cloud.fields.begin(), intensity);
  std::swap(cloud.fields[1], cloud.fields[3]);
  EXPECT_DOUBLE_EQ(cloudPoints(cloud).at<cv::Vec3d>(3, 4)[0], static_cast<float>(clouds::xOf(4)));
}

TEST(CloudPoints, RefusesMessagesThatContradictThemselves) {
  const sensor_msgs::PointCloud2 good = clouds::message(clouds::orderedPoints(false, false, false));
  const auto refused = [&](auto&& spoil, const std::string& word) {
    sensor_msgs::PointCloud2 cloud = good;
    spoil(cloud);
    try {
      cloudPoints(cloud);
      ADD_FAILURE() << "not refused: " << word;
    } catch (const std::exception& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  using Cloud = sensor_msgs::PointCloud2;
  refused([](Cloud& cloud) { cloud.fields.pop_back(); }, "'z'");
  refused([](Cloud& cloud) { cloud.fields.clear(); }, "none at all");
  refused([](Cloud& cloud) { cloud.fields[1].datatype = sensor_msgs::PointField::INT16; }, "'y'");
  refused([](Cloud& cloud) { cloud.fields[2].offset = 9; }, "point_step");
  refused([](Cloud& cloud) { cloud.data.pop_back(); }, "data");
  refused([](Cloud& cloud) { cloud.row_step -= 1; }, "row_step");
  refused([](Cloud& cloud) { cloud.point_step = 0; }, "point_step");
  refused([](Cloud& cloud) { cloud.width = 0; }, "points");
  refused([](Cloud& cloud) { cloud.width = cloud.height = 1u << 31; }, "");
}

}  // namespace
}  // namespace mems_stiction
