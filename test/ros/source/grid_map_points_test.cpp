/// Maps of the package grid_map become the surface that they are of, whatever their order in
/// memory and wherever their buffers begin; what does not agree with itself is named.

#include "source/grid_map_points.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "ros/bounded_stream.hpp"
#include "ros/source/cloud_cases.hpp"
#include "source/cloud_grid.hpp"

namespace mems_stiction {
namespace {

constexpr double kResolution = 20e-6;  // [m]
constexpr int kAlongX = 9, kAlongY = 14;
constexpr float kNoHeight = std::numeric_limits<float>::quiet_NaN();

/// Of a cell, counted from the corner with the largest x and the largest y, as grid_map does.
float gridHeight(int row, int col) {
  return static_cast<float>(clouds::surfaceAt((0.5 * (kAlongX - 1) - row) * kResolution,
                                              (0.5 * (kAlongY - 1) - col) * kResolution));
}

struct Buffer {
  int start_row = 0, start_col = 0;
  bool is_by_rows = false;
};

std_msgs::Float32MultiArray layerArray(const Buffer& buffer,
                                       const std::function<float(int, int)>& height) {
  std_msgs::Float32MultiArray array;
  array.layout.dim.resize(2);
  auto& outer = array.layout.dim[0];
  auto& inner = array.layout.dim[1];
  outer.label = buffer.is_by_rows ? "row_index" : "column_index";
  inner.label = buffer.is_by_rows ? "column_index" : "row_index";
  outer.size = buffer.is_by_rows ? kAlongX : kAlongY;
  inner.size = inner.stride = buffer.is_by_rows ? kAlongY : kAlongX;
  outer.stride = kAlongX * kAlongY;
  array.data.resize(kAlongX * kAlongY);
  for (int row = 0; row < kAlongX; ++row) {
    for (int col = 0; col < kAlongY; ++col) {
      const int stored_row = (row + buffer.start_row) % kAlongX;
      const int stored_col = (col + buffer.start_col) % kAlongY;
      const int place =
          buffer.is_by_rows ? stored_row * kAlongY + stored_col : stored_col * kAlongX + stored_row;
      array.data[static_cast<std::size_t>(place)] = height(row, col);
    }
  }
  return array;
}

GridMapMessage gridMap(const Buffer& buffer = {}) {
  GridMapMessage map;
  map.header.frame_id = "map";
  map.resolution = kResolution;
  map.length_x = kAlongX * kResolution;
  map.length_y = kAlongY * kResolution;
  map.layers = {"variance", "elevation"};
  map.data = {layerArray(buffer, [](int, int) { return 9.0F; }), layerArray(buffer, gridHeight)};
  map.outer_start_index = static_cast<std::uint16_t>(buffer.start_row);
  map.inner_start_index = static_cast<std::uint16_t>(buffer.start_col);
  return map;
}

/// Row 0 has the largest y, x grows along the columns.
cv::Mat surfaceOfGrid() {
  cv::Mat heights(kAlongY, kAlongX, CV_64FC1);
  for (int row = 0; row < kAlongY; ++row) {
    for (int col = 0; col < kAlongX; ++col)
      heights.at<double>(row, col) = gridHeight(kAlongX - 1 - col, row);
  }
  return heights;
}

std::string refusalOfGrid(const GridMapMessage& map) {
  try {
    gridMapPoints(map, "elevation", false);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(GridMapPoints, EveryOrderInMemoryAndEveryBeginningOfTheBufferMakeOneSurface) {
  for (const Buffer& buffer :
       {Buffer{}, {0, 0, true}, {4, 0, false}, {0, 5, false}, {8, 13, false}, {3, 7, true}}) {
    const CloudMap map = mapOfPoints(gridMapPoints(gridMap(buffer), "elevation", false), {});
    EXPECT_TRUE(map.notes.empty());
    EXPECT_NEAR(map.surface.pitchX(), kResolution, 1e-12 * kResolution);
    EXPECT_NEAR(map.surface.pitchY(), kResolution, 1e-12 * kResolution);
    ASSERT_EQ(map.surface.heights().size(), surfaceOfGrid().size());
    EXPECT_EQ(cv::norm(map.surface.heights(), surfaceOfGrid(), cv::NORM_INF), 0.0)
        << buffer.start_row << " " << buffer.start_col << " " << buffer.is_by_rows;
  }
}

TEST(GridMapPoints, ACellCountsWhereItsLayerAndAllBasicLayersAreFinite) {
  GridMapMessage map = gridMap({2, 3, false});
  map.data[0] = layerArray(
      {2, 3, false}, [](int row, int col) { return row == 1 && col == 2 ? kNoHeight : 1.0F; });
  const auto heightAt = [&](int row, int col) {
    return gridMapPoints(map, "elevation", false).at<cv::Vec3d>(row, col)[2];
  };
  EXPECT_EQ(heightAt(1, 2), gridHeight(1, 2));
  map.basic_layers = {"elevation", "variance"};
  EXPECT_TRUE(std::isnan(heightAt(1, 2)));
  EXPECT_EQ(heightAt(2, 1), gridHeight(2, 1));
}

TEST(GridMapPoints, ThePoseOfTheMapPlacesThePointsInTheFrameOfTheHeader) {
  GridMapMessage map = gridMap();
  map.pose.position.x = 2.0;
  map.pose.position.z = 0.5;  // its orientation is all 0, as nobody has filled it in
  cv::Vec3d corner = gridMapPoints(map, "elevation", true).at<cv::Vec3d>(0, 0);
  EXPECT_NEAR(corner[0], 2.0 + 4.0 * kResolution, 1e-12);
  EXPECT_NEAR(corner[1], 6.5 * kResolution, 1e-12);
  EXPECT_NEAR(corner[2], 0.5 + gridHeight(0, 0), 1e-12);
  map.pose.orientation.x = 1.0;  // half a turn about x
  corner = gridMapPoints(map, "elevation", true).at<cv::Vec3d>(0, 0);
  EXPECT_NEAR(corner[1], -6.5 * kResolution, 1e-12);
  EXPECT_NEAR(corner[2], 0.5 - gridHeight(0, 0), 1e-12);
}

TEST(GridMapPoints, AStrideAndAnOffsetAreFollowed) {
  GridMapMessage map = gridMap();
  std_msgs::Float32MultiArray& array = map.data[1];
  std::vector<float> padded(5, -1.0F);
  for (int col = 0; col < kAlongY; ++col) {
    const auto first = array.data.begin() + col * kAlongX;
    padded.insert(padded.end(), first, first + kAlongX);
    padded.insert(padded.end(), 3, -1.0F);
  }
  array.data = padded;
  array.layout.data_offset = 5;
  array.layout.dim[1].stride = kAlongX + 3;
  const CloudMap found = mapOfPoints(gridMapPoints(map, "elevation", false), {});
  EXPECT_EQ(cv::norm(found.surface.heights(), surfaceOfGrid(), cv::NORM_INF), 0.0);
}

TEST(GridMapPoints, WhatDoesNotAgreeWithItselfIsNamed) {
  const auto refused = [](const std::function<void(GridMapMessage&)>& spoil) {
    GridMapMessage map = gridMap();
    spoil(map);
    return refusalOfGrid(map);
  };
  const auto expect = [&](const char* words, const std::function<void(GridMapMessage&)>& spoil) {
    const std::string said = refused(spoil);
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  expect("no layer 'elevation', but variance, height", [](auto& map) { map.layers[1] = "height"; });
  expect("2 layers and has data of 1", [](auto& map) { map.data.pop_back(); });
  expect("labelled by nothing", [](auto& map) { map.data[1].layout.dim.clear(); });
  expect("labelled 'x', 'row_index'", [](auto& map) { map.data[1].layout.dim[0].label = "x"; });
  expect("has 125 heights", [](auto& map) { map.data[1].data.pop_back(); });
  expect("stride of 4", [](auto& map) { map.data[1].layout.dim[1].stride = 4; });
  expect("offset of 4294967295", [](auto& map) { map.data[1].layout.data_offset = 0xFFFFFFFFU; });
  expect("pixels", [](auto& map) {
    map.data[1].layout.dim[0].size = map.data[1].layout.dim[1].size = 0xFFFFFFFFU;
  });
  expect("outer_start_index is 9", [](auto& map) { map.outer_start_index = kAlongX; });
  expect("inner_start_index is 14", [](auto& map) { map.inner_start_index = kAlongY; });
  expect("resolution is 0 m", [](auto& map) { map.resolution = 0.0; });
  expect("length_x is", [](auto& map) { std::swap(map.length_x, map.length_y); });
  expect("names 1000000 basic layers, but has 2 layers",
         [](auto& map) { map.basic_layers.assign(1000000, "variance"); });
  expect("no layer 'normal_z'", [](auto& map) { map.basic_layers = {"normal_z"}; });
}

TEST(GridMapPoints, AMessageThatIsCutOffIsRefusedBeforeItIsBelieved) {
  GridMapMessage map = gridMap();
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(map));
  ros::serialization::OStream out(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  out.next(map);
  GridMapMessage back;
  readMessage(bytes.data(), static_cast<std::uint32_t>(bytes.size()), back);
  EXPECT_EQ(back.layers, map.layers);
  EXPECT_EQ(back.data[1].data, map.data[1].data);
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    EXPECT_THROW(readMessage(bytes.data(), static_cast<std::uint32_t>(size), back), MessageError);
  }
}

}  // namespace
}  // namespace mems_stiction
