#include "mems_stiction/approach/contact_patch.hpp"

#include <algorithm>

namespace mems_stiction {
namespace {

bool isDeeper(const GapField& field, int cell, int other) {
  const double gap = field.gap(cell);
  const double other_gap = field.gap(other);
  return gap < other_gap || (gap == other_gap && cell < other);
}

}  // namespace

void BoundarySums::addEdge(const GapField& field, int row, int col, int neighbour_row, int neighbour_col, int sign) {
  const int cell = row * field.cols() + col;
  const int neighbour = neighbour_row * field.cols() + neighbour_col;
  const std::int64_t edge_x = col + neighbour_col;
  const std::int64_t edge_y = row + neighbour_row;
  count += sign;
  x += sign * edge_x;
  y += sign * edge_y;
  xx += sign * edge_x * edge_x;
  xy += sign * edge_x * edge_y;
  yy += sign * edge_y * edge_y;
  const double edge_gap = sign * 0.5 * (field.gap(cell) + field.gap(neighbour));
  gap += edge_gap;
  x_gap += static_cast<double>(edge_x) * edge_gap;
  y_gap += static_cast<double>(edge_y) * edge_gap;
  if (field.upperIsFlat()) return;  // the lower surface is then the gap, turned over
  const double edge_lower = sign * 0.5 * (field.lowerHeight(cell) + field.lowerHeight(neighbour));
  lower += edge_lower;
  x_lower += static_cast<double>(edge_x) * edge_lower;
  y_lower += static_cast<double>(edge_y) * edge_lower;
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

ContactPatch ContactPatch::ofCell(const GapField& field, int cell) {
  ContactPatch patch;
  patch.area = 1;
  patch.min_col = patch.max_col = cell % field.cols();
  patch.min_row = patch.max_row = cell / field.cols();
  for (std::int32_t& extreme_cell : patch.extreme) extreme_cell = cell;
  patch.deepest = cell;
  patch.latest_gap = field.gap(cell);
  return patch;
}

void ContactPatch::merge(const GapField& field, const ContactPatch& other) {
  const auto mergeSide = [&](Side side, std::int32_t& bound, std::int32_t other_bound, bool other_is_further) {
    if (other_is_further || (bound == other_bound && isDeeper(field, other.extreme[side], extreme[side]))) {
      bound = other_bound;
      extreme[side] = other.extreme[side];
    }
  };
  mergeSide(kLeft, min_col, other.min_col, other.min_col < min_col);
  mergeSide(kRight, max_col, other.max_col, other.max_col > max_col);
  mergeSide(kTop, min_row, other.min_row, other.min_row < min_row);
  mergeSide(kBottom, max_row, other.max_row, other.max_row > max_row);
  if (isDeeper(field, other.deepest, deepest)) deepest = other.deepest;
  area += other.area;
  latest_gap = std::max(latest_gap, other.latest_gap);
  boundary += other.boundary;
}

}  // namespace mems_stiction
