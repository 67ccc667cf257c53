#include "mems_stiction/approach/contact_patch.hpp"

#include <algorithm>

namespace mems_stiction {
namespace {

bool isDeeper(const ExtremeCell& cell, const ExtremeCell& other) {
  return comesBefore(cell.gap, cell.cell, other.gap, other.cell);
}

}  // namespace

void BoundarySums::addEdge(const GapField& field, int row, int col, int neighbour_row, int neighbour_col, int sign) {
  const int cell = row * field.cols() + col;
  const int neighbour = neighbour_row * field.cols() + neighbour_col;
  const double edge_x = col + neighbour_col;
  const double edge_y = row + neighbour_row;
  count += sign;
  x += sign * edge_x;
  y += sign * edge_y;
  xx += sign * edge_x * edge_x;
  xy += sign * edge_x * edge_y;
  yy += sign * edge_y * edge_y;
  const double edge_gap = sign * 0.5 * (field.gap(cell) + field.gap(neighbour));
  gap += edge_gap;
  x_gap += edge_x * edge_gap;
  y_gap += edge_y * edge_gap;
  if (field.upperIsFlat()) return;  // the lower surface is then the gap, turned over
  const double edge_lower = sign * 0.5 * (field.lowerHeight(cell) + field.lowerHeight(neighbour));
  lower += edge_lower;
  x_lower += edge_x * edge_lower;
  y_lower += edge_y * edge_lower;
}

void BoundarySums::addLowerEdges(const GapField& field, const GridCell& cell, const EdgeChanges& changes,
                                 std::size_t lane) {
  const int neighbours[4] = {cell.index - 1, cell.index + 1, cell.index - field.cols(), cell.index + field.cols()};
  const double cell_lower = field.lowerHeight(cell.index);
  double edges[4];
  for (std::size_t side = 0; side < 4; ++side) {
    const double sign = changes.signs[side][lane];
    edges[side] = sign == 0.0 ? 0.0 : sign * 0.5 * (cell_lower + field.lowerHeight(neighbours[side]));
  }
  const double edge_sum = edges[kLeft] + edges[kRight] + edges[kTop] + edges[kBottom];
  lower += edge_sum;
  x_lower += 2 * cell.col * edge_sum + (edges[kRight] - edges[kLeft]);
  y_lower += 2 * cell.row * edge_sum + (edges[kBottom] - edges[kTop]);
}

BoundarySums& BoundarySums::operator+=(const BoundarySums& other) {
  count += other.count;
  x += other.x;
  y += other.y;
  xx += other.xx;
  xy += other.xy;
  yy += other.yy;
  gap += other.gap;
  x_gap += other.x_gap;
  y_gap += other.y_gap;
  lower += other.lower;
  x_lower += other.x_lower;
  y_lower += other.y_lower;
  return *this;
}

void ContactPatch::merge(const ContactPatch& other) {
  const auto mergeSide = [&](Side side, std::int32_t& bound, std::int32_t other_bound, bool other_is_further) {
    if (other_is_further || (bound == other_bound && isDeeper(other.extreme[side], extreme[side]))) {
      bound = other_bound;
      extreme.set(side, other.extreme[side]);
    }
  };
  mergeSide(kLeft, min_col, other.min_col, other.min_col < min_col);
  mergeSide(kRight, max_col, other.max_col, other.max_col > max_col);
  mergeSide(kTop, min_row, other.min_row, other.min_row < min_row);
  mergeSide(kBottom, max_row, other.max_row, other.max_row > max_row);
  if (comesBefore(other.deepest_gap, other.deepest, deepest_gap, deepest)) {
    deepest = other.deepest;
    deepest_gap = other.deepest_gap;
  }
  area += other.area;
  latest_gap = std::max(latest_gap, other.latest_gap);
  boundary += other.boundary;
}

}  // namespace mems_stiction
