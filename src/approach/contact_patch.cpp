#include "mems_stiction/approach/contact_patch.hpp"

#include <algorithm>

namespace mems_stiction {
namespace {

bool isDeeper(double gap, std::int32_t cell, double other_gap, std::int32_t other) {
  return gap < other_gap || (gap == other_gap && cell < other);
}

bool isDeeper(const ExtremeCell& cell, const ExtremeCell& other) {
  return isDeeper(cell.gap, cell.cell, other.gap, other.cell);
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

void BoundarySums::addEdges(const GapField& field, const GridCell& cell, double cell_gap, const double (&gaps)[4],
                            const double (&signs)[4]) {
  // all edges are half a pixel pitch, one unit, from the cell's centre: their sums follow from few products
  const double center_x = 2 * cell.col;
  const double center_y = 2 * cell.row;
  const double total = signs[kLeft] + signs[kRight] + signs[kTop] + signs[kBottom];
  const double horizontal = signs[kRight] - signs[kLeft];
  const double vertical = signs[kBottom] - signs[kTop];
  count += total;
  x += total * center_x + horizontal;
  y += total * center_y + vertical;
  xx += (total * center_x + 2 * horizontal) * center_x + signs[kLeft] + signs[kRight];
  yy += (total * center_y + 2 * vertical) * center_y + signs[kTop] + signs[kBottom];
  xy += total * center_x * center_y + horizontal * center_y + vertical * center_x;

  const auto addHeights = [&](const double(&edges)[4], double& sum, double& x_sum, double& y_sum) {
    const double edge_sum = edges[kLeft] + edges[kRight] + edges[kTop] + edges[kBottom];
    sum += edge_sum;
    x_sum += center_x * edge_sum + (edges[kRight] - edges[kLeft]);
    y_sum += center_y * edge_sum + (edges[kBottom] - edges[kTop]);
  };
  double edges[4];
  for (int side = 0; side < 4; ++side) {
    edges[side] = signs[side] == 0.0 ? 0.0 : signs[side] * 0.5 * (cell_gap + gaps[side]);
  }
  addHeights(edges, gap, x_gap, y_gap);
  if (field.upperIsFlat()) return;  // the lower surface is then the gap, turned over
  const int neighbours[4] = {cell.index - 1, cell.index + 1, cell.index - field.cols(), cell.index + field.cols()};
  const double cell_lower = field.lowerHeight(cell.index);
  for (int side = 0; side < 4; ++side) {
    edges[side] = signs[side] == 0.0 ? 0.0 : signs[side] * 0.5 * (cell_lower + field.lowerHeight(neighbours[side]));
  }
  addHeights(edges, lower, x_lower, y_lower);
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

ContactPatch ContactPatch::ofCell(const GridCell& cell, double gap, const double (&outside)[4]) {
  ContactPatch patch;
  patch.area = 1;
  patch.min_col = patch.max_col = cell.col;
  patch.min_row = patch.max_row = cell.row;
  for (int side = 0; side < 4; ++side) patch.extreme[side] = {cell.index, gap, outside[side]};
  patch.deepest = cell.index;
  patch.deepest_gap = patch.latest_gap = gap;
  return patch;
}

void ContactPatch::addCell(const GridCell& cell, double gap, const double (&outside)[4]) {
  const auto extend = [&](Side side, std::int32_t& bound, std::int32_t place, bool is_further) {
    const ExtremeCell candidate{cell.index, gap, outside[side]};
    if (!is_further && (place != bound || !isDeeper(candidate, extreme[side]))) return;
    bound = place;
    extreme[side] = candidate;
  };
  extend(kLeft, min_col, cell.col, cell.col < min_col);
  extend(kRight, max_col, cell.col, cell.col > max_col);
  extend(kTop, min_row, cell.row, cell.row < min_row);
  extend(kBottom, max_row, cell.row, cell.row > max_row);
  if (isDeeper(gap, cell.index, deepest_gap, deepest)) {
    deepest = cell.index;
    deepest_gap = gap;
  }
  latest_gap = std::max(latest_gap, gap);
  ++area;
}

void ContactPatch::merge(const ContactPatch& other) {
  const auto mergeSide = [&](Side side, std::int32_t& bound, std::int32_t other_bound, bool other_is_further) {
    if (other_is_further || (bound == other_bound && isDeeper(other.extreme[side], extreme[side]))) {
      bound = other_bound;
      extreme[side] = other.extreme[side];
    }
  };
  mergeSide(kLeft, min_col, other.min_col, other.min_col < min_col);
  mergeSide(kRight, max_col, other.max_col, other.max_col > max_col);
  mergeSide(kTop, min_row, other.min_row, other.min_row < min_row);
  mergeSide(kBottom, max_row, other.max_row, other.max_row > max_row);
  if (isDeeper(other.deepest_gap, other.deepest, deepest_gap, deepest)) {
    deepest = other.deepest;
    deepest_gap = other.deepest_gap;
  }
  area += other.area;
  latest_gap = std::max(latest_gap, other.latest_gap);
  boundary += other.boundary;
}

}  // namespace mems_stiction
