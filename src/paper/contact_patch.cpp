#include "paper/contact_patch.hpp"

#include <algorithm>

namespace mems_stiction {
namespace {

bool isApart(double gap) { return gap < GapField::kInvalidGap; }

/// +1 for an edge that comes in with a cell, -1 for one that goes, 0 for none. Which one is random:
/// without a branch.
double signOfEdge(Side side, double neighbour_gap, double gap) {
  return static_cast<int>(isApart(neighbour_gap)) -
         2 * static_cast<int>(comesFirst(side, neighbour_gap, gap));
}

}  // namespace

void BoundarySums::addEdges(const GridCell& cell, double own, const double (&gaps)[4]) {
  double signs[4];
  double edges[4];
  for (const Side side : kSides) {
    signs[side] = signOfEdge(side, gaps[side], own);
    edges[side] = signs[side] * 0.5 * (own + (isApart(gaps[side]) ? gaps[side] : 0.0));
  }
  // All edges are half a pixel pitch, one unit, from the cell's centre: moments follow from few
  // products.
  const double centre_x = 2.0 * cell.col;
  const double centre_y = 2.0 * cell.row;
  const double horizontal = signs[kLeft] + signs[kRight];
  const double vertical = signs[kTop] + signs[kBottom];
  const double rightwards = signs[kRight] - signs[kLeft];
  const double downwards = signs[kBottom] - signs[kTop];
  const double edge_count = horizontal + vertical;
  const double edge_gap = (edges[kLeft] + edges[kRight]) + (edges[kTop] + edges[kBottom]);
  const double edge_x = edge_count * centre_x + rightwards;
  const double edge_y = edge_count * centre_y + downwards;
  count += edge_count;
  gap += edge_gap;
  x += edge_x;
  x_gap += edge_gap * centre_x + (edges[kRight] - edges[kLeft]);
  y += edge_y;
  y_gap += edge_gap * centre_y + (edges[kBottom] - edges[kTop]);
  xx += (edge_x + rightwards) * centre_x + horizontal;
  yy += (edge_y + downwards) * centre_y + vertical;
  xy += edge_x * centre_y + downwards * centre_x;
}

void BoundarySums::addLowerEdges(const GapField& field, const GridCell& cell, double own,
                                 const double (&gaps)[4]) {
  const double cell_lower = field.lowerHeight(cell.index);
  double edges[4];
  for (const Side side : kSides) {
    const double sign = signOfEdge(side, gaps[side], own);
    const int neighbour = cell.neighbour(side, field.cols()).index;
    edges[side] = sign == 0.0 ? 0.0 : sign * 0.5 * (cell_lower + field.lowerHeight(neighbour));
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

void ContactPatch::extend(Side side, std::int32_t& bound, std::int32_t place,
                          const ExtremeCell& cell) {
  const std::int32_t beyond = side == kLeft || side == kTop ? bound - place : place - bound;
  ExtremeCell& known = extreme[side];
  if (beyond < 0 || (beyond == 0 && !comesBefore(cell.gap, cell.cell, known.gap, known.cell)))
    return;
  bound = place;
  known = cell;
}

void ContactPatch::addCell(const GridCell& cell, double gap, const double (&gaps)[4]) {
  if (area == 0) {
    min_col = max_col = cell.col;
    min_row = max_row = cell.row;
    deepest = cell.index;
    deepest_gap = latest_gap = gap;
    for (const Side side : kSides) extreme[side] = {cell.index, gap, gaps[side]};
  } else {
    extend(kLeft, min_col, cell.col, {cell.index, gap, gaps[kLeft]});
    extend(kRight, max_col, cell.col, {cell.index, gap, gaps[kRight]});
    extend(kTop, min_row, cell.row, {cell.index, gap, gaps[kTop]});
    extend(kBottom, max_row, cell.row, {cell.index, gap, gaps[kBottom]});
    if (comesBefore(gap, cell.index, deepest_gap, deepest)) {
      deepest = cell.index;
      deepest_gap = gap;
    }
    latest_gap = std::max(latest_gap, gap);
  }
  ++area;
}

void ContactPatch::merge(const ContactPatch& other) {
  extend(kLeft, min_col, other.min_col, other.extreme[kLeft]);
  extend(kRight, max_col, other.max_col, other.extreme[kRight]);
  extend(kTop, min_row, other.min_row, other.extreme[kTop]);
  extend(kBottom, max_row, other.max_row, other.extreme[kBottom]);
  if (comesBefore(other.deepest_gap, other.deepest, deepest_gap, deepest)) {
    deepest = other.deepest;
    deepest_gap = other.deepest_gap;
  }
  area += other.area;
  latest_gap = std::max(latest_gap, other.latest_gap);
  boundary += other.boundary;
}

}  // namespace mems_stiction
