#include "separation/support_plane.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace mems_stiction {
namespace {

/// Exchanges before what has been found counts: each of them is a pass over the frame, and some ten
/// suffice.
constexpr int kMostExchanges = 1000;
/// The first three corners are none of the relief: so many frames from the middle, and so much
/// deeper than the relief is high.
constexpr double kFarCorner = 8.0;
constexpr double kDeepCorner = 1e6;
/// What sticks out by less than this share of the relief is rounding.
constexpr double kFlush = 1e-13;

/// A place of the relief over the frame's middle; lengths in halves of the frame's sides.
struct Corner {
  double x = 0.0;
  double y = 0.0;
  double height = 0.0;  ///< [m]
  bool is_place = false;
};
using Triangle = std::array<Corner, 3>;

/// Shares of the corners whose sum lies at a place.
std::array<double, 3> sharesOf(const Triangle& corners, double x, double y) {
  const auto [a, b, c] = corners;
  const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  const double of_b = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
  const double of_c = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
  return {1.0 - of_b - of_c, of_b, of_c};
}

struct Plane {
  double middle = 0.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
};

Plane planeOf(const Triangle& corners) {
  const auto at = [&](double x, double y) {
    const std::array<double, 3> shares = sharesOf(corners, x, y);
    return shares[0] * corners[0].height + shares[1] * corners[1].height +
           shares[2] * corners[2].height;
  };
  const double middle = at(0.0, 0.0);
  return {middle, at(1.0, 0.0) - middle, at(0.0, 1.0) - middle};
}

/// The place that is highest over a plane.
Corner highestOver(const Plane& plane, const GapField& field, std::vector<double>& line,
                   double& excess) {
  Corner highest;
  excess = -std::numeric_limits<double>::infinity();
  const double half_cols = 0.5 * field.cols();
  const double half_rows = 0.5 * field.rows();
  for (int row = 0; row < field.rows(); ++row) {
    field.gapsOfRow(row, line.data());
    const double y = (row - 0.5 * (field.rows() - 1)) / half_rows;
    for (int col = 0; col < field.cols(); ++col) {
      const double height = -line[static_cast<std::size_t>(col)];
      const double x = (col - 0.5 * (field.cols() - 1)) / half_cols;
      const double over = height - (plane.middle + plane.slope_x * x + plane.slope_y * y);
      if (!(over > excess)) continue;
      excess = over;
      highest = {x, y, height, true};
    }
  }
  return highest;
}

/// The corner that goes when another place comes in, so that the middle stays within.
std::size_t leavingCorner(const Triangle& corners, const Corner& entering) {
  const std::array<double, 3> of_middle = sharesOf(corners, 0.0, 0.0);
  const std::array<double, 3> of_entering = sharesOf(corners, entering.x, entering.y);
  std::size_t leaving = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!(of_entering[i] > 0.0)) continue;
    const double ratio = of_middle[i] / of_entering[i];
    if (!(ratio < least)) continue;
    least = ratio;
    leaving = i;
  }
  return leaving;
}

}  // namespace

std::optional<PlaneSlopes> supportPlane(const GapField& field) {
  const double relief = field.largestGap();
  const double deep = -kDeepCorner * (relief > 0.0 ? relief : 1.0);
  Triangle corners{Corner{-kFarCorner, -kFarCorner, deep, false},
                   Corner{kFarCorner, -0.97 * kFarCorner, deep, false},
                   Corner{0.03 * kFarCorner, kFarCorner, deep, false}};
  std::vector<double> line(static_cast<std::size_t>(field.cols()));
  for (int exchange = 0; exchange < kMostExchanges; ++exchange) {
    const Plane plane = planeOf(corners);
    double excess = 0.0;
    const Corner highest = highestOver(plane, field, line, excess);
    const bool is_placed = corners[0].is_place && corners[1].is_place && corners[2].is_place;
    if (excess <= kFlush * (is_placed ? relief : -deep)) break;
    corners[leavingCorner(corners, highest)] = highest;
  }
  if (!corners[0].is_place || !corners[1].is_place || !corners[2].is_place) return std::nullopt;
  const Plane plane = planeOf(corners);
  return PlaneSlopes{plane.slope_x / (0.5 * field.cols() * field.pitchX()),
                     plane.slope_y / (0.5 * field.rows() * field.pitchY())};
}

}  // namespace mems_stiction
