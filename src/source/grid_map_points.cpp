#include "source/grid_map_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>

#include "errors/one_line.hpp"
#include "errors/short_number.hpp"
#include "import/file_bytes.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"
#include "source/cloud_points.hpp"

namespace mems_stiction {
namespace {

constexpr char kRowLabel[] = "row_index";
constexpr char kColumnLabel[] = "column_index";

/// Lengths are multiples of the resolution to this share of a cell.
constexpr double kCellTolerance = 0.1;

/// Element (row, col) of a layer is `data[first + row * row_step + col * col_step]`.
struct LayerLayout {
  std::uint64_t rows, cols, first, row_step, col_step;
};

std::string quoted(const std::string& text) {
  return "'" + shortened(oneLine(text), kLongestQuotation) + "'";
}

LayerLayout layoutOf(const std::string& name, const std_msgs::Float32MultiArray& array) {
  const auto& dims = array.layout.dim;
  const bool is_by_columns =
      dims.size() == 2 && dims[0].label == kColumnLabel && dims[1].label == kRowLabel;
  const bool is_by_rows =
      dims.size() == 2 && dims[0].label == kRowLabel && dims[1].label == kColumnLabel;
  if (!is_by_columns && !is_by_rows) {
    std::string labels;
    for (const auto& dim : dims) labels += (labels.empty() ? "" : ", ") + quoted(dim.label);
    throw SurfaceError("the layer " + quoted(name) + " has dimensions labelled " +
                       (labels.empty() ? "by nothing" : labels) +
                       ", must have column_index and row_index");
  }
  const std::uint64_t outer = dims[0].size, inner = dims[1].size;
  checkPixelCount(inner, outer);
  const std::uint64_t step = dims[1].stride == 0 ? inner : dims[1].stride;
  const std::uint64_t first = array.layout.data_offset;
  if (step < inner || first + (outer - 1) * step + inner > array.data.size()) {
    throw SurfaceError("the layer " + quoted(name) + " has " + std::to_string(array.data.size()) +
                       " heights, which are no " + std::to_string(outer) + " x " +
                       std::to_string(inner) + " with a stride of " + std::to_string(step) +
                       " behind an offset of " + std::to_string(first));
  }
  return is_by_columns ? LayerLayout{inner, outer, first, 1, step}
                       : LayerLayout{outer, inner, first, step, 1};
}

/// A layer, with the buffer's circle undone.
cv::Mat layerOf(const GridMapMessage& map, const std::string& name) {
  const auto found = std::find(map.layers.begin(), map.layers.end(), name);
  if (found == map.layers.end()) {
    const std::string names = shortened(oneLine(listed(map.layers)), kLongestQuotation);
    throw SurfaceError("the grid map has no layer " + quoted(name) + ", but " +
                       (names.empty() ? "none at all" : names));
  }
  const std_msgs::Float32MultiArray& array =
      map.data[static_cast<std::size_t>(found - map.layers.begin())];
  const LayerLayout layout = layoutOf(name, array);
  const auto mustStartWithin = [](const char* what, std::uint64_t index, std::uint64_t count) {
    if (index < count) return;
    throw SurfaceError(std::string(what) + " is " + std::to_string(index) + ", must be below " +
                       std::to_string(count));
  };
  mustStartWithin("outer_start_index", map.outer_start_index, layout.rows);
  mustStartWithin("inner_start_index", map.inner_start_index, layout.cols);
  cv::Mat heights(static_cast<int>(layout.rows), static_cast<int>(layout.cols), CV_64FC1);
  for (std::uint64_t row = 0; row < layout.rows; ++row) {
    auto* height = heights.ptr<double>(static_cast<int>(row));
    const std::uint64_t stored_row = (row + map.outer_start_index) % layout.rows;
    for (std::uint64_t col = 0; col < layout.cols; ++col) {
      const std::uint64_t stored_col = (col + map.inner_start_index) % layout.cols;
      height[col] =
          array.data[layout.first + stored_row * layout.row_step + stored_col * layout.col_step];
    }
  }
  return heights;
}

void checkLength(const char* name, double length, double resolution, int count) {
  const double own = count * resolution;
  if (std::abs(length - own) <= kCellTolerance * resolution) return;
  throw SurfaceError(std::string(name) + " is " + shortNumber(length) + " m, but " +
                     std::to_string(count) + " cells of " + shortNumber(resolution) + " m make " +
                     shortNumber(own) + " m");
}

geometry_msgs::Transform transformOf(const geometry_msgs::Pose& pose) {
  geometry_msgs::Transform transform;
  transform.translation.x = pose.position.x;
  transform.translation.y = pose.position.y;
  transform.translation.z = pose.position.z;
  transform.rotation = pose.orientation;
  const auto& turn = pose.orientation;
  // Nobody has filled it in.
  if (turn.x == 0.0 && turn.y == 0.0 && turn.z == 0.0 && turn.w == 0.0) transform.rotation.w = 1.0;
  return transform;
}

}  // namespace

cv::Mat gridMapPoints(const GridMapMessage& map, const std::string& layer, bool is_posed) {
  if (map.layers.size() != map.data.size()) {
    throw SurfaceError("the grid map names " + std::to_string(map.layers.size()) +
                       " layers and has data of " + std::to_string(map.data.size()));
  }
  if (map.basic_layers.size() > map.layers.size()) {
    throw SurfaceError("the grid map names " + std::to_string(map.basic_layers.size()) +
                       " basic layers, but has " + std::to_string(map.layers.size()) + " layers");
  }
  const cv::Mat heights = layerOf(map, layer);
  if (!(map.resolution > 0.0) || !std::isfinite(map.resolution)) {
    throw SurfaceError("the resolution is " + shortNumber(map.resolution) + " m, must be above 0");
  }
  checkLength("length_x", map.length_x, map.resolution, heights.rows);
  checkLength("length_y", map.length_y, map.resolution, heights.cols);
  cv::Mat points(heights.size(), CV_64FC3);
  for (int row = 0; row < points.rows; ++row) {
    auto* point = points.ptr<cv::Vec3d>(row);
    const double x = (0.5 * (heights.rows - 1) - row) * map.resolution;
    for (int col = 0; col < points.cols; ++col) {
      point[col] = {x, (0.5 * (heights.cols - 1) - col) * map.resolution,
                    heights.at<double>(row, col)};
    }
  }
  // one that is named a million times is looked at once
  const std::set<std::string> basic_layers(map.basic_layers.begin(), map.basic_layers.end());
  for (const std::string& basic : basic_layers) {
    if (basic == layer) continue;
    const cv::Mat needed = layerOf(map, basic);
    if (needed.size() != heights.size())
      throw SurfaceError("the layer " + quoted(basic) + " has another size than " + quoted(layer));
    for (int row = 0; row < points.rows; ++row) {
      for (int col = 0; col < points.cols; ++col) {
        if (!std::isfinite(needed.at<double>(row, col)))
          points.at<cv::Vec3d>(row, col)[2] = std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
  if (is_posed) transformPoints(transformOf(map.pose), points);
  return points;
}

}  // namespace mems_stiction
