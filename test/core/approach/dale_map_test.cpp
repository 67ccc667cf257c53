#include "approach/dale_map.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/frame_gaps.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

/// The pit below each cell by the definition: cells are ranked by gap and place, and a path goes to
/// the left or up if that leads to a lower rank, else to the lower of right and below. -1 for
/// invalid cells.
std::vector<int> pitsOf(const GapField& field) {
  const std::vector<double> gaps = frameGaps(field);
  std::vector<int> order(gaps.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return gaps[a] < gaps[b]; });
  std::vector<int> rank(gaps.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    rank[static_cast<std::size_t>(order[i])] = static_cast<int>(i);

  const int cols = field.cols();
  std::vector<int> pits(gaps.size(), -1);
  for (const int cell : order) {  // the lowest first: what lies below a cell is known
    if (!isValid(field, cell)) break;
    const auto rankOf = [&](bool is_in_frame, int other) {
      return is_in_frame ? rank[other] : field.cellCount();
    };
    const int left = rankOf(cell % cols > 0, cell - 1);
    const int right = rankOf(cell % cols + 1 < cols, cell + 1);
    const int top = rankOf(cell >= cols, cell - cols);
    const int bottom = rankOf(cell + cols < field.cellCount(), cell + cols);
    const int own = rank[cell];
    const int next = left < own ? left : (top < own ? top : std::min({right, bottom, own}));
    pits[cell] = next == own ? cell : pits[order[next]];
  }
  return pits;
}

/// One dale for each pit, and every cell in that of its pit.
void expectDales(DaleMap& dales, const GapField& field, const std::vector<int>& pits) {
  std::map<int, std::int32_t> dale_of_pit;
  std::set<std::int32_t> numbers;
  for (int cell = 0; cell < field.cellCount(); ++cell) {
    if (!isValid(field, cell)) continue;
    const std::int32_t dale = dales.find(field.cellAt(cell));
    ASSERT_EQ(dale_of_pit.emplace(pits[static_cast<std::size_t>(cell)], dale).first->second, dale)
        << "cell " << cell;
    numbers.insert(dale);
  }
  EXPECT_EQ(numbers.size(), dale_of_pit.size());
  EXPECT_EQ(dales.count(), static_cast<int>(numbers.size()));
  EXPECT_EQ(*numbers.rbegin(), dales.count() - 1);
}

class MappedFrame : public testing::TestWithParam<samples::Frame> {
 protected:
  void SetUp() override {
    field_ = GetParam().gapField();
    pits_ = pitsOf(field_);
    dales_.start(field_);
  }

  GapField field_;
  std::vector<int> pits_;
  DaleMap dales_;
};

INSTANTIATE_TEST_SUITE_P(Frames, MappedFrame, testing::ValuesIn(samples::allFrames()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(MappedFrame, hasOneDaleForEachPit) { expectDales(dales_, field_, pits_); }

TEST_P(MappedFrame, hasTheSameDalesInWhateverOrderTheyAreAskedFor) {
  for (int cell = field_.cellCount() - 1; cell >= 0; cell -= 3) {
    if (isValid(field_, cell)) dales_.find(field_.cellAt(cell));
  }
  expectDales(dales_, field_, pits_);
}

TEST_P(MappedFrame, hasTheSameDalesWhenFoundRowByRow) {
  const int cols = field_.cols();
  // the gaps of a row and of the one above, with a cell off the frame at either end
  std::vector<double> above(static_cast<std::size_t>(cols) + 2, GapField::kInvalidGap);
  std::vector<double> line = above;
  for (int row = 0; row < field_.rows(); ++row) {
    field_.gapsOfRow(row, line.data() + 1);
    std::vector<std::int32_t> valid;
    for (int col = 0; col < cols; ++col) {
      if (isValid(field_, row * cols + col) && (row + col) % 5 != 0) valid.push_back(col);
    }
    dales_.findInRow(row, valid.data(), static_cast<int>(valid.size()), line.data() + 1,
                     above.data() + 1);
    for (const std::int32_t col : valid)
      ASSERT_NE(dales_.at(field_.cellAt(row, col)), DaleMap::kUnknown);
    std::swap(line, above);
  }
  expectDales(dales_, field_, pits_);
}

TEST_P(MappedFrame, knowsOnlyThePathsThatWereAskedFor) {
  const auto pit = std::find_if(pits_.begin(), pits_.end(), [](int cell) { return cell >= 0; });
  const GridCell asked = field_.cellAt(static_cast<int>(pit - pits_.begin()));
  EXPECT_EQ(dales_.at(asked), DaleMap::kUnknown);
  EXPECT_EQ(dales_.find(asked), 0);
  EXPECT_EQ(dales_.count(), 1);
  for (int cell = 0; cell < field_.cellCount(); ++cell) {
    if (pits_[static_cast<std::size_t>(cell)] != *pit) {
      ASSERT_EQ(dales_.at(field_.cellAt(cell)), DaleMap::kUnknown);
    }
  }
}

TEST_P(MappedFrame, forgetsAnotherFrame) {
  const GapField other =
      samples::Frame{"", samples::whiteNoise(70, 90, 1e-9, 2e-9, 4e-9, 12), {}}.gapField();
  dales_.start(other);
  expectDales(dales_, other, pitsOf(other));
  dales_.start(field_);
  EXPECT_EQ(dales_.count(), 0);
  expectDales(dales_, field_, pits_);
}

}  // namespace
}  // namespace mems_stiction
