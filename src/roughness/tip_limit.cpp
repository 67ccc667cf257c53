#include "roughness/tip_limit.hpp"

#include <cmath>
#include <limits>

namespace mems_stiction {
namespace {

constexpr double kShare = 0.5;  ///< of the tip's curvature
constexpr int kFewestColumns = 8;

/// Smallest h(x - d) - 2 h(x) + h(x + d) over all rows; infinite if no three such pixels are valid.
double smallestBend(const cv::Mat& heights, int distance) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int row = 0; row < heights.rows; ++row) {
    const double* height = heights.ptr<double>(row);
    for (int col = distance; col + distance < heights.cols; ++col) {
      const double bend = height[col - distance] - 2.0 * height[col] + height[col + distance];
      if (bend < smallest) smallest = bend;  // never where a pixel is missing
    }
  }
  return smallest;
}

}  // namespace

double tipLimit(const HeightMap& surface, double tip_radius) {
  if (surface.cols() < kFewestColumns) return std::numeric_limits<double>::quiet_NaN();
  const cv::Mat heights = surface.asDouble().heights();
  const double pitch = surface.pitchX();
  // Below 0 where the tip has a part in it.
  const auto excess = [&](int distance) {
    const double reach = distance * pitch;
    return smallestBend(heights, distance) / (reach * reach) + kShare / tip_radius;
  };
  int inside = 1;
  double at_inside = excess(inside);
  if (std::isinf(at_inside)) return std::numeric_limits<double>::quiet_NaN();
  if (at_inside >= 0.0) return 0.0;
  int outside = surface.cols() / 4;
  double at_outside = excess(outside);
  if (at_outside < 0.0) return surface.cols() * pitch;
  while (outside - inside > 1) {
    const int middle = (inside + outside) / 2;
    const double at_middle = excess(middle);
    (at_middle < 0.0 ? inside : outside) = middle;
    (at_middle < 0.0 ? at_inside : at_outside) = at_middle;
  }
  const double share = std::isinf(at_outside) ? 0.0 : at_inside / (at_inside - at_outside);
  return 2.0 * (inside + share) * pitch;
}

}  // namespace mems_stiction
