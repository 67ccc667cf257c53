#include "paper/cell_surroundings.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

class SurroundedFrame : public testing::TestWithParam<samples::Frame> {
 protected:
  void SetUp() override {
    field_ = GetParam().gapField();
    order_.build(field_, 1.0, std::max(field_.largestGap(), 1e-9) / 30);
    dales_.start(field_);
    table_.start(field_, order_, dales_);
  }

  int cellCount() const { return static_cast<int>(order_.cells().size()); }

  /// Gaps, dale and border of the cell at this place, from the field and the dales themselves.
  void expectSurroundings(int place) {
    const OrderedCell& ordered = order_.cells()[static_cast<std::size_t>(place)];
    const GridCell cell = field_.cellAt(ordered.cell);
    const CellSurroundings around = table_.at(place);
    ASSERT_EQ(around.cell, cell.index);
    ASSERT_EQ(around.dale(), dales_.find(cell));
    const int row_steps[] = {0, 0, -1, 1};  // left, right, top, bottom
    const int col_steps[] = {-1, 1, 0, 0};
    for (int side = 0; side < 4; ++side) {
      const int row = cell.row + row_steps[side];
      const int col = cell.col + col_steps[side];
      const bool is_in_frame = row >= 0 && row < field_.rows() && col >= 0 && col < field_.cols();
      const double gap =
          is_in_frame ? field_.gap(row * field_.cols() + col) : GapField::kInvalidGap;
      ASSERT_EQ(around.gaps[side], gap) << "cell " << cell.index << " side " << side;
      if (around.isBorder() || !is_in_frame) continue;
      // inside a dale: neighbours that are in contact before belong to it
      const GridCell neighbour = field_.cellAt(row, col);
      if (comesBefore(gap, neighbour.index, ordered.gap, cell.index)) {
        ASSERT_EQ(dales_.find(neighbour), around.dale())
            << "cell " << cell.index << " side " << side;
      }
    }
  }

  GapField field_;
  GapOrder order_;
  DaleMap dales_;
  SurroundingsTable table_;
};

INSTANTIATE_TEST_SUITE_P(Frames, SurroundedFrame, testing::ValuesIn(samples::allFrames()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(SurroundedFrame, areKnownWithoutAWindow) {
  EXPECT_EQ(table_.endPlace(), 0);
  for (int place = 0; place < cellCount() && !HasFailure(); ++place) expectSurroundings(place);
}

TEST_P(SurroundedFrame, areTheSameInsideAWindowAndBeyond) {
  table_.collectFrom(0);
  EXPECT_GT(table_.endPlace(), 0);
  for (int place = 0; place < cellCount() && !HasFailure(); ++place) expectSurroundings(place);
}

TEST_P(SurroundedFrame, areTheSameInOneWindowAfterTheOther) {
  while (table_.endPlace() < cellCount()) {
    const int begin = table_.endPlace();
    table_.collectFrom(begin);
    ASSERT_GT(table_.endPlace(), begin);
    for (int place = begin; place < table_.endPlace() && !HasFailure(); ++place)
      expectSurroundings(place);
  }
}

TEST_P(SurroundedFrame, areThoseOfTheCellThatSortingHasPutThere) {
  table_.collectFrom(0);
  order_.sortBetween(0, cellCount());
  for (int place = 0; place < cellCount() && !HasFailure(); ++place) expectSurroundings(place);
}

TEST_P(SurroundedFrame, leaveNoTraceOfAnotherFrame) {
  const GapField other =
      samples::Frame{"", samples::whiteNoise(70, 90, 1e-9, 2e-9, 4e-9, 12), {}}.gapField();
  GapOrder other_order;
  other_order.build(other, 1.0, 1e-10);
  dales_.start(other);
  table_.start(other, other_order, dales_);
  table_.collectFrom(0);
  dales_.start(field_);
  table_.start(field_, order_, dales_);
  EXPECT_EQ(table_.endPlace(), 0);
  table_.collectFrom(0);
  for (int place = 0; place < cellCount() && !HasFailure(); ++place) expectSurroundings(place);
}

TEST(CellSurroundings, mostCellsOfASmoothFrameLieInsideADale) {
  const GapField field =
      samples::Frame{"", samples::gaussian(200, 200, 1e-9, 1e-9, 3e-9, 20e-9, 1), {}}.gapField();
  GapOrder order;
  order.build(field, 0.2, field.largestGap() / 100);
  DaleMap dales;
  dales.start(field);
  SurroundingsTable table;
  table.start(field, order, dales);
  table.collectFrom(0);
  int border_count = 0;
  for (int place = 0; place < table.endPlace(); ++place)
    border_count += table.at(place).isBorder() ? 1 : 0;
  // dales some 20 pixels across have a fifth of their cells at the border with another; half of it
  // is asked about
  EXPECT_LT(border_count, 0.2 * table.endPlace());
}

}  // namespace
}  // namespace mems_stiction
