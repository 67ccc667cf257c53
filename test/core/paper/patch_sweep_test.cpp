#include "paper/patch_sweep.hpp"

#include <cmath>
#include <map>
#include <ostream>
#include <set>

#include <gtest/gtest.h>

#include "support/frame_gaps.hpp"
#include "support/plain_adhesion_model.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

/// Sums come in another order, and edges that were added are taken away again: round-off of every
/// edge so far, times its lever arm in half pixels.
struct RoundOff {
  explicit RoundOff(const GapField& field) {
    double largest_lower = 0.0;
    for (int cell = 0; cell < field.cellCount(); ++cell) {
      if (isValid(field, cell))
        largest_lower = std::max(largest_lower, std::abs(field.lowerHeight(cell)));
    }
    height = 1e-14 * field.cellCount() * (field.largestGap() + largest_lower);
    moment = height * 2.0 * std::max(field.rows(), field.cols());
  }
  double height;
  double moment;
};

void expectSameBoundary(const BoundarySums& sums, const BoundarySums& expected,
                        const RoundOff& round_off) {
  EXPECT_EQ(sums.count, expected.count);
  EXPECT_EQ(sums.x, expected.x);
  EXPECT_EQ(sums.y, expected.y);
  EXPECT_EQ(sums.xx, expected.xx);
  EXPECT_EQ(sums.xy, expected.xy);
  EXPECT_EQ(sums.yy, expected.yy);
  EXPECT_NEAR(sums.gap, expected.gap, round_off.height);
  EXPECT_NEAR(sums.x_gap, expected.x_gap, round_off.moment);
  EXPECT_NEAR(sums.y_gap, expected.y_gap, round_off.moment);
  EXPECT_NEAR(sums.lower, expected.lower, round_off.height);
  EXPECT_NEAR(sums.x_lower, expected.x_lower, round_off.moment);
  EXPECT_NEAR(sums.y_lower, expected.y_lower, round_off.moment);
}

void expectSamePatch(const ContactPatch& patch, const ContactPatch& expected,
                     const RoundOff& round_off) {
  EXPECT_EQ(patch.area, expected.area);
  EXPECT_EQ(patch.min_col, expected.min_col);
  EXPECT_EQ(patch.max_col, expected.max_col);
  EXPECT_EQ(patch.min_row, expected.min_row);
  EXPECT_EQ(patch.max_row, expected.max_row);
  for (const Side side : kSides) {
    EXPECT_EQ(patch.extreme[side].cell, expected.extreme[side].cell);
    EXPECT_EQ(patch.extreme[side].gap, expected.extreme[side].gap);
    EXPECT_EQ(patch.extreme[side].outside, expected.extreme[side].outside);
  }
  EXPECT_EQ(patch.deepest_gap, expected.deepest_gap);
  EXPECT_EQ(patch.deepest, expected.deepest);
  EXPECT_EQ(patch.latest_gap, expected.latest_gap);
  expectSameBoundary(patch.boundary, expected.boundary, round_off);
}

/// Number of cells in contact.
int areaOfPatches(const PatchSweep& sweep) {
  int area = 0;
  for (const std::int32_t id : sweep.livePatches()) area += sweep.patch(id).area;
  return area;
}

/// The same cells touch, in the same patches, with the same attributes.
void expectSamePatches(PatchSweep& sweep, const plain::Labelling& labelling,
                       const GapField& field) {
  ASSERT_EQ(areaOfPatches(sweep), labelling.contact_count);
  ASSERT_EQ(sweep.livePatches().size(), labelling.patches.size());
  std::map<std::int32_t, int> label_of_id;
  for (int cell = 0; cell < field.cellCount(); ++cell) {
    const int label = labelling.labels.at<int>(cell / field.cols(), cell % field.cols());
    const std::int32_t id = sweep.patchOf(cell);
    ASSERT_EQ(id < 0, label == 0) << "cell " << cell;
    if (id < 0) continue;
    ASSERT_EQ(label_of_id.emplace(id, label).first->second, label) << "cell " << cell;
  }
  // as many ids as labels, and one label per id: the partitions are the same
  ASSERT_EQ(label_of_id.size(), labelling.patches.size());
  const RoundOff round_off(field);
  for (const std::int32_t id : sweep.livePatches()) {
    ASSERT_EQ(label_of_id.count(id), 1u);
    const auto place = static_cast<std::size_t>(label_of_id[id] - 1);
    expectSamePatch(sweep.patch(id), labelling.patches[place], round_off);
    if (testing::Test::HasFailure()) return;
  }
}

struct Case {
  samples::Frame frame;
  Connectivity connectivity;
};

void PrintTo(const Case& tested, std::ostream* out) { *out << tested.frame.name; }

std::vector<Case> allCases() {
  std::vector<Case> cases;
  for (const samples::Frame& frame : samples::allFrames()) {
    cases.push_back({frame, Connectivity::kFour});
    cases.push_back({frame, Connectivity::kEight});
  }
  return cases;
}

class SweptFrame : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    field_ = GetParam().frame.gapField();
    order_.build(field_, 1.0);
    sweep_.start(field_, order_, GetParam().connectivity);
  }

  void expectPlainPatchesAt(double approach, plain::Touch touch) {
    SCOPED_TRACE("approach " + std::to_string(approach * 1e9) + " nm");
    expectSamePatches(sweep_, plain::labelPatches(field_, approach, touch, GetParam().connectivity),
                      field_);
  }

  GapField field_;
  GapOrder order_;
  PatchSweep sweep_;
};

INSTANTIATE_TEST_SUITE_P(Frames, SweptFrame, testing::ValuesIn(allCases()), [](const auto& tested) {
  return tested.param.frame.name +
         (tested.param.connectivity == Connectivity::kFour ? "_four" : "_eight");
});

TEST_P(SweptFrame, hasThePatchesOfARelabelledFrameAtEveryStep) {
  constexpr int kSteps = 40;
  const double step = std::max(field_.largestGap(), 1e-9) / kSteps;
  for (int k = 1; k <= kSteps + 1 && !HasFailure(); ++k) {
    sweep_.advanceTo(order_.sortBelow(k * step));
    expectPlainPatchesAt(k * step, plain::Touch::kBelow);
  }
  EXPECT_EQ(areaOfPatches(sweep_), field_.validCount());
}

TEST_P(SweptFrame, hasThePatchesOfARelabelledFrameAtGapLevels) {
  const LargePageVector<OrderedCell>& cells = order_.cells();
  order_.sortBetween(0, static_cast<int>(cells.size()));
  const std::size_t stride = std::max<std::size_t>(1, cells.size() / 25);
  for (std::size_t place = 0; place < cells.size() && !HasFailure(); place += stride) {
    std::size_t end = place + 1;  // all cells of this level
    while (end < cells.size() && cells[end].gap == cells[place].gap) ++end;
    sweep_.advanceTo(static_cast<int>(end));
    expectPlainPatchesAt(cells[place].gap, plain::Touch::kUpTo);
  }
}

TEST_P(SweptFrame, startsOverWhenAskedForFewerCells) {
  const double halfway = 0.5 * field_.largestGap();
  sweep_.advanceTo(field_.validCount());
  sweep_.advanceTo(order_.sortBelow(halfway));
  expectPlainPatchesAt(halfway, plain::Touch::kBelow);
  sweep_.advanceTo(0);
  EXPECT_TRUE(sweep_.livePatches().empty());
  sweep_.advanceTo(field_.validCount());
  expectPlainPatchesAt(field_.largestGap(), plain::Touch::kUpTo);
}

TEST_P(SweptFrame, leavesNoTraceOfThePreviousFrame) {
  const GapField other =
      samples::Frame{"", samples::whiteNoise(33, 90, 1e-9, 2e-9, 4e-9, 12), {}}.gapField();
  GapOrder other_order;
  other_order.build(other, 1.0);
  sweep_.start(other, other_order, Connectivity::kEight);
  sweep_.advanceTo(other.validCount() / 3);
  const double halfway = 0.5 * field_.largestGap();
  sweep_.start(field_, order_, GetParam().connectivity);
  sweep_.advanceTo(order_.sortBelow(halfway));
  expectPlainPatchesAt(halfway, plain::Touch::kBelow);
}

TEST_P(SweptFrame, reportsEveryPatchThatChangedOrMovedAndNoOther) {
  std::map<std::int32_t, std::pair<std::int32_t, std::int32_t>> known;  // area and place
  const double step = std::max(field_.largestGap(), 1e-9) / 30;
  for (int k = 1; k <= 30; ++k) {
    sweep_.advanceTo(order_.sortBelow(k * step));
    const std::vector<std::int32_t> reported = sweep_.takeChangedPatches();
    const std::set<std::int32_t> changed(reported.begin(), reported.end());
    EXPECT_EQ(changed.size(), reported.size());  // once each
    for (const std::int32_t id : sweep_.livePatches()) {
      const std::pair<std::int32_t, std::int32_t> now(sweep_.patch(id).area, sweep_.livePlace(id));
      ASSERT_EQ(sweep_.livePatches()[static_cast<std::size_t>(now.second)], id);
      const auto before = known.find(id);
      if (before == known.end() || before->second != now) {
        ASSERT_EQ(changed.count(id), 1u) << "step " << k << " patch " << id;
      } else if (changed.count(id) == 1) {
        // it may have moved away and back within the step, when patches merged
        ASSERT_LT(sweep_.livePatches().size(), known.size()) << "step " << k << " patch " << id;
      }
      known[id] = now;
    }
  }
  sweep_.advanceTo(0);  // a restart
  sweep_.advanceTo(1);
  EXPECT_EQ(sweep_.takeChangedPatches().size(), 1u);
}

}  // namespace
}  // namespace mems_stiction
