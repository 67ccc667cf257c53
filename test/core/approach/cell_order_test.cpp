#include "approach/cell_order.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

constexpr int kCols = 7;
constexpr GridCell kCell{3, 4, 3 * kCols + 4};

TEST(CellOrder, knowsTheNeighboursOfACell) {
  const int rows[] = {3, 3, 2, 4};  // left, right, top, bottom
  const int cols[] = {3, 5, 4, 4};
  for (const Side side : kSides) {
    const GridCell neighbour = kCell.neighbour(side, kCols);
    EXPECT_EQ(neighbour.row, rows[side]);
    EXPECT_EQ(neighbour.col, cols[side]);
    EXPECT_EQ(neighbour.index, rows[side] * kCols + cols[side]);
  }
}

TEST(CellOrder, goesByGapThenByPlace) {
  EXPECT_TRUE(comesBefore(1.0, 5, 2.0, 3));
  EXPECT_FALSE(comesBefore(2.0, 3, 1.0, 5));
  EXPECT_TRUE(comesBefore(1.0, 3, 1.0, 5));
  EXPECT_FALSE(comesBefore(1.0, 5, 1.0, 3));
  EXPECT_FALSE(comesBefore(1.0, 5, 1.0, 5));
}

TEST(CellOrder, knowsBySideWhichOfTwoNeighboursComesFirst) {
  constexpr double kNoCell = std::numeric_limits<double>::infinity();
  for (const Side side : kSides) {
    const GridCell neighbour = kCell.neighbour(side, kCols);
    for (const double gap : {1.0, 2.0, 3.0, kNoCell}) {
      EXPECT_EQ(comesFirst(side, gap, 2.0), comesBefore(gap, neighbour.index, 2.0, kCell.index))
          << side << " " << gap;
    }
  }
}

}  // namespace
}  // namespace mems_stiction
