#include "support/analytic_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace analytic {
namespace {

/// heightAt(row, col) at every pixel.
template <typename HeightAt>
HeightMap sampled(int rows, int cols, double pitch_x, double pitch_y, HeightAt heightAt) {
  cv::Mat heights(rows, cols, CV_64FC1);
  for (int row = 0; row < rows; ++row) {
    double* line = heights.ptr<double>(row);
    for (int col = 0; col < cols; ++col) line[col] = heightAt(row, col);
  }
  return {heights, pitch_x, pitch_y};
}

double fromMiddle(int index, int count, double pitch) {
  return (index - 0.5 * (count - 1)) * pitch;
}

/// Position within the tile, from the tile's middle; `tile` is set to the tile's number.
double fromTileMiddle(int index, int count, double pitch, int tiles, int& tile) {
  const double width = static_cast<double>(count) / tiles;
  tile = std::min(static_cast<int>((index + 0.5) / width), tiles - 1);
  return (index + 0.5 - (tile + 0.5) * width) * pitch;
}

}  // namespace

HeightMap flat(int rows, int cols, double pitch_x, double pitch_y, double height) {
  return sampled(rows, cols, pitch_x, pitch_y, [=](int, int) { return height; });
}

HeightMap paraboloid(int rows, int cols, double pitch_x, double pitch_y, double radius,
                     double centre_x, double centre_y) {
  return sampled(rows, cols, pitch_x, pitch_y, [=](int row, int col) {
    const double x = fromMiddle(col, cols, pitch_x) - centre_x;
    const double y = fromMiddle(row, rows, pitch_y) - centre_y;
    return -(x * x + y * y) / (2.0 * radius);
  });
}

HeightMap sphere(int rows, int cols, double pitch_x, double pitch_y, double radius, double centre_x,
                 double centre_y) {
  return sampled(rows, cols, pitch_x, pitch_y, [=](int row, int col) {
    const double x = fromMiddle(col, cols, pitch_x) - centre_x;
    const double y = fromMiddle(row, rows, pitch_y) - centre_y;
    const double square = x * x + y * y;
    return -square / (radius + std::sqrt(radius * radius -
                                         square));  // sqrt(R^2 - r^2) - R without its round-off
  });
}

HeightMap sphereArray(int rows, int cols, double pitch_x, double pitch_y,
                      const std::vector<double>& radii, int count_x, int count_y) {
  if (radii.empty()) throw std::invalid_argument("sphereArray needs at least one radius");
  return sampled(rows, cols, pitch_x, pitch_y, [&](int row, int col) {
    int tile_x = 0;
    int tile_y = 0;
    const double x = fromTileMiddle(col, cols, pitch_x, count_x, tile_x);
    const double y = fromTileMiddle(row, rows, pitch_y, count_y, tile_y);
    const double radius = radii[static_cast<std::size_t>(tile_y * count_x + tile_x) % radii.size()];
    return -(x * x + y * y) / (2.0 * radius);
  });
}

HeightMap tiltedPlane(int rows, int cols, double pitch_x, double pitch_y, double slope_x,
                      double slope_y, double offset) {
  return sampled(rows, cols, pitch_x, pitch_y, [=](int row, int col) {
    return offset + slope_x * fromMiddle(col, cols, pitch_x) +
           slope_y * fromMiddle(row, rows, pitch_y);
  });
}

HeightMap sine(int rows, int cols, double pitch_x, double pitch_y, double amplitude, int periods_x,
               int periods_y) {
  return sampled(rows, cols, pitch_x, pitch_y, [=](int row, int col) {
    const double phase =
        static_cast<double>(periods_x) * col / cols + static_cast<double>(periods_y) * row / rows;
    return amplitude * std::sin(2.0 * kPi * phase);
  });
}

HeightMap flatWithBump(int rows, int cols, double pitch_x, double pitch_y, double height,
                       int width) {
  const int first_row = (rows - width) / 2;
  const int first_col = (cols - width) / 2;
  return sampled(rows, cols, pitch_x, pitch_y, [=](int row, int col) {
    const bool on_bump =
        row >= first_row && row < first_row + width && col >= first_col && col < first_col + width;
    return on_bump ? height : 0.0;
  });
}

HeightMap sum(const HeightMap& first, const HeightMap& second) {
  cv::Mat heights = first.asDouble().heights() + second.asDouble().heights();
  return {heights, first.pitchX(), first.pitchY()};
}

HeightMap asSingle(const HeightMap& surface) {
  cv::Mat narrow;
  surface.heights().convertTo(narrow, CV_32F);
  return {narrow, surface.pitchX(), surface.pitchY()};
}

HeightMap withInvalidPixel(const HeightMap& surface, int row, int col) {
  cv::Mat heights = surface.heights().clone();
  if (heights.depth() == CV_32F) {
    heights.at<float>(row, col) = std::numeric_limits<float>::quiet_NaN();
  } else {
    heights.at<double>(row, col) = std::numeric_limits<double>::quiet_NaN();
  }
  return {heights, surface.pitchX(), surface.pitchY()};
}

}  // namespace analytic
}  // namespace mems_stiction
