/// Patches of the sweep against OpenCV's labelling, and what they carry where they meet.

#include "separation/overlap_sweep.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

constexpr double kNm = 1e-9;

struct Labelled {
  int cells = 0;
  double gap_sum = 0.0;
  double first_gap = std::numeric_limits<double>::infinity();
};

const OverlapPatch& patchOf(const OverlapSweep& sweep, std::int32_t id) {
  return sweep.patches()[static_cast<std::size_t>(sweep.livePlace(id))];
}

class SampleFrames : public testing::TestWithParam<samples::Frame> {};
INSTANTIATE_TEST_SUITE_P(Frames, SampleFrames, testing::ValuesIn(samples::allFrames()));

TEST_P(SampleFrames, patchesAreThoseOfALabelling) {
  const GapField field = GetParam().gapField();
  for (const Connectivity connectivity : {Connectivity::kFour, Connectivity::kEight}) {
    GapOrder order;
    DaleMap dales;
    dales.start(field);
    order.build(field, 1.0, 0.0, &dales);
    OverlapSweep sweep;
    sweep.start(field, dales, connectivity);
    for (const double share : {0.02, 0.1, 0.3, 0.5, 0.8, 1.01}) {
      const double approach = share * std::max(field.largestGap(), 1e-12);
      cv::Mat touching(field.rows(), field.cols(), CV_8UC1, cv::Scalar(0));
      int touching_count = 0;
      for (int cell = 0; cell < field.cellCount(); ++cell) {
        const bool touches = field.gap(cell) < approach;
        touching.at<std::uint8_t>(cell / field.cols(), cell % field.cols()) = touches ? 1 : 0;
        touching_count += touches ? 1 : 0;
      }
      cv::Mat labels;
      const int patch_count =
          cv::connectedComponents(touching, labels, connectivity == Connectivity::kFour ? 4 : 8) -
          1;
      std::vector<Labelled> labelled(static_cast<std::size_t>(patch_count));
      ASSERT_EQ(sweep.advanceTo(approach, order), touching_count);
      ASSERT_EQ(static_cast<int>(sweep.livePatches().size()), patch_count);
      std::map<int, std::int32_t> patch_of_label;
      for (int cell = 0; cell < field.cellCount(); ++cell) {
        const int label = labels.at<int>(cell / field.cols(), cell % field.cols());
        const std::int32_t id = sweep.patchOf(field.cellAt(cell));
        ASSERT_EQ(label > 0, id >= 0);
        if (label == 0) continue;
        ASSERT_EQ(patch_of_label.emplace(label, id).first->second, id);
        Labelled& patch = labelled[static_cast<std::size_t>(label - 1)];
        ++patch.cells;
        patch.gap_sum += field.gap(cell);
        patch.first_gap = std::min(patch.first_gap, field.gap(cell));
      }
      for (const auto& [label, id] : patch_of_label) {
        const OverlapPatch& patch = patchOf(sweep, id);
        const Labelled& expected = labelled[static_cast<std::size_t>(label - 1)];
        EXPECT_EQ(patch.cells, expected.cells);
        EXPECT_EQ(patch.first_gap, expected.first_gap);
        EXPECT_EQ(field.gap(patch.first_cell), expected.first_gap);
        // sums in another order: round-off of some thousand terms
        EXPECT_NEAR(patch.gap_sum, expected.gap_sum, 1e-12 * expected.gap_sum);
        EXPECT_GE(patch.summits, 1);
        EXPECT_LE(patch.summits, patch.cells);
      }
    }
  }
}

/// Two valleys of 5 cells in a row, with a ridge between them.
GapField twoSummits() {
  const cv::Mat heights = (cv::Mat_<double>(1, 5) << -1.0, 0.0, -4.0, -0.5, -2.0) * kNm;
  SurfacePair pair;
  pair.lower = HeightMap(heights, 1e-8, 1e-8);
  GapField field;
  field.compute(pair);
  return field;
}

TEST(OverlapSweep, loadsAreKeptWherePatchesMeet) {
  const GapField field = twoSummits();
  GapOrder order;
  DaleMap dales;
  dales.start(field);
  order.build(field, 1.0, 0.0, &dales);
  OverlapSweep sweep;
  sweep.start(field, dales, Connectivity::kFour);
  const double ridge = 4.0 * kNm;
  const auto load = [&] {
    double sum = 0.0;
    for (const std::int32_t id : sweep.livePatches()) sum += patchOf(sweep, id).loadTerm(ridge);
    return sum;
  };
  sweep.advanceTo(ridge, order);
  ASSERT_EQ(sweep.livePatches().size(), 2U);
  const double before = load();
  sweep.advanceTo(ridge * (1.0 + 1e-9), order);
  ASSERT_EQ(sweep.livePatches().size(), 1U);
  const OverlapPatch& both = patchOf(sweep, sweep.livePatches().front());
  EXPECT_EQ(both.summits, 2);
  EXPECT_EQ(both.cells, 5);
  EXPECT_EQ(both.first_cell, 1);
  EXPECT_GT(both.merged_term, 0.0);  // the larger patch alone would carry less
  // the ridge itself joins with the larger of the two, where it adds no volume: sqrt(n) of its
  // cells alone
  EXPECT_NEAR(load() / before, 1.0, 0.1);
  EXPECT_NEAR(both.gap_sum, 7.5 * kNm, 1e-20);
  EXPECT_NEAR(both.depth(ridge), 2.5 * kNm, 1e-20);
}

TEST(OverlapSweep, whatTwoEqualPatchesCarryWhenTheyMeetIsTheirSum) {
  OverlapPatch one;
  one.cells = 9;
  one.summits = 1;
  one.gap_sum = 9.0 * kNm;
  OverlapPatch other = one;
  other.first_gap = 0.5 * kNm;
  other.first_cell = 7;
  const double approach = 3.0 * kNm;
  const double carried = one.loadTerm(approach) + other.loadTerm(approach);
  one.merge(other, approach);
  EXPECT_NEAR(one.loadTerm(approach) / carried, 1.0, 1e-14);
  EXPECT_EQ(one.first_cell, 0);  // of the smaller gap
  // deeper, what comes on top has the stiffness of 18 cells
  const double deeper = 4.0 * kNm;
  EXPECT_NEAR(one.loadTerm(deeper) - carried, std::sqrt(18.0) * kNm, 1e-14 * kNm);
}

TEST(OverlapSweep, radiusAndLoadOfAParaboloidAreHertzs) {
  const double radius = 1e-6;
  const double pitch = 1e-9;
  SurfacePair pair;
  pair.lower = analytic::paraboloid(301, 301, pitch, pitch, radius);
  GapField field;
  field.compute(pair);
  GapOrder order;
  DaleMap dales;
  dales.start(field);
  order.build(field, 1.0, 0.0, &dales);
  OverlapSweep sweep;
  sweep.start(field, dales, Connectivity::kFour);
  const double depth = 8.0 * kNm;
  sweep.advanceTo(depth, order);
  ASSERT_EQ(sweep.livePatches().size(), 1U);
  const OverlapPatch& patch = patchOf(sweep, sweep.livePatches().front());
  const double cell = pitch * pitch;
  // a circle of 126 pixels: its area on the grid is off by 1e-3
  EXPECT_NEAR(patch.cells * cell / (2.0 * kPi * radius * depth), 1.0, 2e-3);
  EXPECT_NEAR(patch.radius(depth, cell) / radius, 1.0, 4e-3);
  // P/E = 0.6 sqrt(pi dA) loadTerm = (4/3) sqrt(R) delta^1.5
  const double load = 0.6 * std::sqrt(kPi * cell) * patch.loadTerm(depth);
  EXPECT_NEAR(load / (4.0 / 3.0 * std::sqrt(radius) * std::pow(depth, 1.5)), 1.0, 4e-3);
}

TEST_P(SampleFrames, patchesDoNotDependOnTheStepsNorOnASweepAhead) {
  const GapField field = GetParam().gapField();
  const double range = std::max(field.largestGap(), 1e-12);
  DaleMap dales;
  dales.start(field);
  GapOrder order;
  order.build(field, 1.0, 0.0, &dales);
  OverlapSweep ahead;
  OverlapSweep behind;
  ahead.start(field, dales, Connectivity::kFour);
  behind.start(field, dales, Connectivity::kFour);
  for (int step = 1; step <= 60; ++step) {
    ahead.advanceTo((step + 3) * range / 100.0, order);
    behind.advanceTo(step * range / 100.0, order, &ahead);
  }
  const OverlapSweep kept = behind;
  behind.advanceTo(0.9 * range, order);
  behind = kept;
  GapOrder other_order;
  other_order.build(field, 1.0, 0.0, &dales);
  OverlapSweep at_once;
  at_once.start(field, dales, Connectivity::kFour);
  at_once.advanceTo(60 * range / 100.0, other_order);
  ASSERT_EQ(behind.livePatches().size(), at_once.livePatches().size());
  for (const std::int32_t id : at_once.livePatches()) {
    const OverlapPatch& expected = patchOf(at_once, id);
    const OverlapPatch& patch = patchOf(behind, behind.patchOf(field.cellAt(expected.first_cell)));
    ASSERT_EQ(patch.cells, expected.cells);
    ASSERT_EQ(patch.summits, expected.summits);
    ASSERT_EQ(patch.first_cell, expected.first_cell);
    // sums in another order, and kept is what is left of two of them
    EXPECT_NEAR(patch.gap_sum, expected.gap_sum, 1e-12 * expected.gap_sum);
    EXPECT_NEAR(patch.merged_term, expected.merged_term, 1e-11 * range * std::sqrt(expected.cells));
  }
}

TEST(OverlapSweep, startsAnewOnAnotherFrameAndBack) {
  const std::vector<samples::Frame> frames = samples::allFrames();
  OverlapSweep used;
  for (const std::size_t i : {0U, 1U, 0U, 0U}) {
    const GapField field = frames[i].gapField();
    GapOrder order;
    DaleMap dales;
    dales.start(field);
    order.build(field, 1.0, 0.0, &dales);
    OverlapSweep fresh;
    used.start(field, dales, Connectivity::kFour);
    fresh.start(field, dales, Connectivity::kFour);
    const double approach = 0.4 * field.largestGap();
    ASSERT_EQ(used.advanceTo(approach, order), fresh.advanceTo(approach, order));
    EXPECT_EQ(used.livePatches(), fresh.livePatches());
    for (int cell = 0; cell < field.cellCount(); ++cell)
      ASSERT_EQ(used.patchOf(field.cellAt(cell)), fresh.patchOf(field.cellAt(cell)));
    for (const std::int32_t id : used.livePatches())
      EXPECT_EQ(patchOf(used, id).merged_term, patchOf(fresh, id).merged_term);
  }
}

}  // namespace
}  // namespace mems_stiction
