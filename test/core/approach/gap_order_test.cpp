#include "approach/gap_order.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include <gtest/gtest.h>

#include "support/analytic_surfaces.hpp"
#include "support/frame_gaps.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

std::vector<OrderedCell> sortedCells(const GapField& field) {
  std::vector<OrderedCell> cells;
  for (int cell = 0; cell < field.cellCount(); ++cell) {
    if (isValid(field, cell)) cells.push_back({field.gap(cell), cell, {}});
  }
  std::stable_sort(cells.begin(), cells.end(),
                   [](const auto& a, const auto& b) { return a.gap < b.gap; });
  return cells;
}

HeightMap withSpike(const HeightMap& surface, double height) {
  cv::Mat1d heights = surface.heights().clone();
  heights(heights.rows / 3, heights.cols / 4) = height;
  return {heights, surface.pitchX(), surface.pitchY()};
}

std::vector<samples::Frame> orderedFrames() {
  std::vector<samples::Frame> frames = samples::allFrames();
  const HeightMap rough = samples::gaussian(200, 201, 10e-9, 10e-9, 3e-9, 60e-9, 1);
  frames.push_back({"large", rough, {}});
  frames.push_back({"tall_spike", withSpike(rough, 5e-6), {}});
  frames.push_back({"deep_pit", withSpike(rough, -5e-6), {}});
  for (const int nanometres : {1, 2, 3, 4}) {  // as a scan of three bits has them
    const double digit = nanometres * 1e-9;
    const HeightMap noise = samples::whiteNoise(32, 32, 20e-9, 20e-9, 7.0 * digit, nanometres);
    frames.push_back(
        {"quantized_" + std::to_string(nanometres) + "_nm", samples::quantized(noise, digit), {}});
  }
  return frames;
}

/// Steps as a search takes them, some that meet the gaps of lattices exactly or but for round-off,
/// one that is tiny, and one beyond the range.
std::vector<double> stepsFor(const GapField& field) {
  const double range = std::max(field.largestGap(), 1e-9);
  return {range / 37.3,  range / 8.0, range / 14.0, range / 133.0,
          range / 259.0, range / 1e7, 3.0 * range};
}

class OrderedFrame : public testing::TestWithParam<samples::Frame> {
 protected:
  void SetUp() override { field_ = GetParam().gapField(); }
  GapField field_;
};

INSTANTIATE_TEST_SUITE_P(Frames, OrderedFrame, testing::ValuesIn(orderedFrames()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(OrderedFrame, sortsTheCellsByGapThenIndexWhereAsked) {
  const std::vector<OrderedCell> expected = sortedCells(field_);
  for (const double step : stepsFor(field_)) {
    for (const double fraction : {1e-9, 0.01, 0.1, 0.5, 0.9, 1.0}) {
      GapOrder order;
      order.build(field_, fraction, step);
      ASSERT_LE(order.cells().size(), expected.size());
      ASSERT_GE(order.cells().size(), static_cast<std::size_t>(order.contactLimit()));
      order.sortBetween(0, static_cast<int>(order.cells().size()));
      for (std::size_t i = 0; i < order.cells().size(); ++i) {
        ASSERT_EQ(order.cells()[i].cell, expected[i].cell) << "place " << i;
        ASSERT_EQ(order.cells()[i].gap, expected[i].gap) << "place " << i;
      }
    }
  }
}

TEST_P(OrderedFrame, grownInPartsIsTheOrderMadeAtOnce) {
  GapOrder grown;
  grown.build(field_, 1e-9);
  GapOrder at_once;
  for (const double fraction : {0.01, 0.3, 0.9, 1.0}) {
    grown.extend(field_, fraction);
    at_once.build(field_, fraction);
    ASSERT_EQ(grown.orderedBuckets(), at_once.orderedBuckets());
    ASSERT_EQ(grown.cells().size(), at_once.cells().size());
    EXPECT_EQ(grown.contactLimit(), at_once.contactLimit());
    const auto count = static_cast<int>(grown.cells().size());
    grown.sortBetween(0, count);
    at_once.sortBetween(0, count);
    for (std::size_t i = 0; i < grown.cells().size(); ++i) {
      ASSERT_EQ(grown.cells()[i].cell, at_once.cells()[i].cell) << "place " << i;
    }
    for (std::size_t i = 0; i < grown.orderedMoments().size(); ++i) {
      ASSERT_EQ(grown.orderedMoments()[i].count, at_once.orderedMoments()[i].count);
      ASSERT_EQ(grown.orderedMoments()[i].mean, at_once.orderedMoments()[i].mean);
    }
  }
}

TEST_P(OrderedFrame, cellsBearTheirDaleAndWhereItMeetsOthers) {
  DaleMap dales;
  dales.start(field_);
  GapOrder order;
  order.build(field_, 0.05, 0.0, &dales);
  order.extend(field_, 0.4);
  order.extend(field_, 1.0);
  for (const OrderedCell& ordered : order.cells()) {
    const GridCell cell = field_.cellAt(ordered.cell);
    ASSERT_EQ(ordered.tag.dale(), dales.find(cell));
    for (const Side side : kSides) {
      const GridCell neighbour = cell.neighbour(side, field_.cols());
      const bool comes_before =
          field_.contains(neighbour) && comesFirst(side, field_.gap(neighbour.index), ordered.gap);
      ASSERT_EQ(ordered.tag.isBorderAt(side),
                comes_before && dales.find(neighbour) != ordered.tag.dale());
    }
  }
}

TEST_P(OrderedFrame, changedGapsAreInOrder) {
  GapOrder order;
  order.build(field_, 1.0);
  const double limit = 0.4 * std::max(field_.largestGap(), 1e-12);
  const int count = order.sortBelow(limit);
  std::vector<double> gaps;
  std::map<int, double> gap_of_cell;
  for (int i = 0; i < count;
       ++i) {  // some rise, some stay: half the way to the limit where the cell's number is odd
    const OrderedCell& ordered = order.cells()[static_cast<std::size_t>(i)];
    gaps.push_back(ordered.cell % 2 == 1 ? 0.5 * (ordered.gap + limit) : ordered.gap);
    gap_of_cell[ordered.cell] = gaps.back();
  }
  order.changeGaps(limit, gaps);
  ASSERT_EQ(order.sortBelow(limit), count);
  order.sortBetween(0, count);
  double counted = 0.0;
  for (const GapMoments& moments : order.orderedMoments()) counted += moments.count;
  EXPECT_EQ(counted, static_cast<double>(order.cells().size()));
  for (int i = 0; i < count; ++i) {
    const OrderedCell& ordered = order.cells()[static_cast<std::size_t>(i)];
    ASSERT_EQ(ordered.gap, gap_of_cell.at(ordered.cell));
    if (i == 0) continue;
    const OrderedCell& before = order.cells()[static_cast<std::size_t>(i - 1)];
    ASSERT_TRUE(comesBefore(before.gap, before.cell, ordered.gap, ordered.cell));
  }
}

TEST_P(OrderedFrame, keepsTheCellsOfOneStepTogetherAndInTheOrderOfTheFrame) {
  const std::vector<double> gaps = frameGaps(field_);
  const double range = std::max(field_.largestGap(), 1e-9);
  for (const double step : {range / 37.3, range / 8.0, 3.0 * range}) {
    GapOrder order;
    order.build(field_, 0.5, step);
    int before = 0;
    for (int k = 1; before < order.contactLimit(); ++k) {
      const double approach = k * step;
      const int below = order.sortBelow(approach);
      const auto expected =
          std::count_if(gaps.begin(), gaps.end(), [=](double gap) { return gap < approach; });
      ASSERT_EQ(below, std::min<std::ptrdiff_t>(expected,
                                                static_cast<std::ptrdiff_t>(order.cells().size())));
      for (int i = before; i < below; ++i) {
        ASSERT_LT(order.cells()[static_cast<std::size_t>(i)].gap, approach);
        ASSERT_GE(order.cells()[static_cast<std::size_t>(i)].gap, (k - 1) * step);
      }
      if (below >= order.contactLimit()) break;  // the last group is sorted for the limit
      for (int i = before + 1; i < below; ++i) {
        ASSERT_LT(order.cells()[static_cast<std::size_t>(i - 1)].cell,
                  order.cells()[static_cast<std::size_t>(i)].cell);
      }
      before = below;
    }
  }
}

TEST_P(OrderedFrame, keepsCellsOfEqualGapsInTheOrderOfTheFrame) {
  for (const double step : stepsFor(field_)) {
    GapOrder order;
    order.build(field_, 0.5, step);
    std::map<double, std::int32_t> latest;
    for (const OrderedCell& cell : order.cells()) {
      const auto found = latest.emplace(cell.gap, -1).first;
      ASSERT_LT(found->second, cell.cell);
      found->second = cell.cell;
    }
  }
}

TEST_P(OrderedFrame, limitsContactAtTheFirstLevelThatReachesTheFraction) {
  const std::vector<OrderedCell> expected = sortedCells(field_);
  for (const double fraction : {1e-9, 0.01, 0.1, 0.5, 0.9, 1.0}) {
    GapOrder order;
    order.build(field_, fraction, 0.03 * field_.largestGap());
    const auto wanted =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(fraction * expected.size())));
    const double level = expected[wanted - 1].gap;
    const auto end = std::find_if(expected.begin(), expected.end(),
                                  [&](const auto& cell) { return cell.gap > level; });
    EXPECT_EQ(order.contactLimit(), end - expected.begin()) << "fraction " << fraction;
  }
}

TEST_P(OrderedFrame, countsTheCellsBelowAnApproach) {
  const std::vector<double> gaps = frameGaps(field_);
  GapOrder order;
  order.build(field_, 1.0);
  for (int k = 0; k <= 20; ++k) {
    const double approach = field_.largestGap() * k / 20;
    const auto below =
        std::count_if(gaps.begin(), gaps.end(), [approach](double gap) { return gap < approach; });
    EXPECT_EQ(order.sortBelow(approach), below);
  }
  EXPECT_EQ(order.sortBelow(0.0), 0);  // touching at D = 0 is not interference yet
}

TEST_P(OrderedFrame, keepsTheMomentsOfEveryBucket) {
  GapOrder order;
  order.build(field_, 0.3);
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  const auto add = [&](const GapMoments& bucket, double width) {
    ASSERT_GE(bucket.variance, 0.0);
    // spread of values that share a bucket: half its width at most
    ASSERT_LE(std::sqrt(bucket.variance), 0.5 * width * (1.0 + 1e-6));
    count += bucket.count;
    sum += bucket.count * bucket.mean;
    squares += bucket.count * (bucket.variance + bucket.mean * bucket.mean);
  };
  for (const GapMoments& bucket : order.orderedMoments()) add(bucket, order.bucketWidth());
  const double tail_width = order.bucketWidth() * GapOrder::kBucketsPerTailBucket;
  for (const GapMoments& bucket : order.tailMoments()) add(bucket, tail_width);
  ASSERT_EQ(
      order.orderedMoments().size() + order.tailMoments().size() * GapOrder::kBucketsPerTailBucket,
      static_cast<std::size_t>(order.bucketCount()));
  EXPECT_EQ(count, field_.validCount());
  double expected_squares = 0.0;
  for (const double gap : frameGaps(field_))
    expected_squares += gap == GapField::kInvalidGap ? 0.0 : gap * gap;
  // relative: the round-off of some ten thousand additions; cells of the tail stand at the middle
  // of their bucket
  const double tolerance =
      order.tailMoments().empty() ? 1e-12 : 0.5 * order.bucketWidth() / field_.largestGap();
  EXPECT_NEAR(sum, field_.meanGap() * count, tolerance * count * field_.largestGap());
  EXPECT_NEAR(squares, expected_squares,
              2.0 * tolerance * count * field_.largestGap() * field_.largestGap());
}

TEST_P(OrderedFrame, knowsWhereTheGroupsStart) {
  for (const double step : stepsFor(field_)) {
    GapOrder order;
    order.build(field_, 0.3, step);
    const double round_off = 1e-12 * field_.largestGap();  // of a gap at the border of two buckets
    for (int bucket = 0; bucket <= order.orderedBuckets(); ++bucket) {
      const int start = order.groupStartFrom(bucket);
      ASSERT_GE(start, bucket);
      if (start != bucket) continue;
      const int before = order.cellsBefore(start);
      const double border = start * order.bucketWidth();
      if (before > 0) {
        ASSERT_LE(order.cells()[static_cast<std::size_t>(before - 1)].gap, border + round_off)
            << "bucket " << bucket;
      }
      if (before < static_cast<int>(order.cells().size())) {
        ASSERT_GE(order.cells()[static_cast<std::size_t>(before)].gap, border - round_off)
            << "bucket " << bucket;
      }
    }
    EXPECT_EQ(order.cellsBefore(order.orderedBuckets()), static_cast<int>(order.cells().size()));
  }
}

TEST_P(OrderedFrame, knowsTheGroupOfEveryGap) {
  std::vector<double> steps = stepsFor(field_);
  steps.push_back(0.0);
  for (const double step : steps) {
    for (const double fraction : {0.3, 1.0}) {
      GapOrder order;
      order.build(field_, fraction, step);
      const auto count = static_cast<int>(order.cells().size());
      for (int place = 0; place < count; ++place) {
        const double gap = order.cells()[static_cast<std::size_t>(place)].gap;
        ASSERT_EQ(order.groupOf(gap), order.groupOfPlace(place))
            << "place " << place << " step " << step;
      }
    }
  }
}

TEST_P(OrderedFrame, isTheSameAfterAnotherFrame) {
  GapOrder fresh;
  fresh.build(field_, 0.4);
  GapOrder used;
  used.build(samples::Frame{"", samples::whiteNoise(120, 90, 1e-9, 2e-9, 4e-9, 12), {}}.gapField(),
             0.9);
  used.build(field_, 0.4);
  EXPECT_EQ(used.contactLimit(), fresh.contactLimit());
  EXPECT_EQ(used.bucketWidth(), fresh.bucketWidth());
  ASSERT_EQ(used.cells().size(), fresh.cells().size());
  for (std::size_t i = 0; i < fresh.cells().size(); ++i)
    ASSERT_EQ(used.cells()[i].cell, fresh.cells()[i].cell);
  ASSERT_EQ(used.orderedMoments().size(), fresh.orderedMoments().size());
  for (std::size_t i = 0; i < fresh.orderedMoments().size(); ++i) {
    ASSERT_EQ(used.orderedMoments()[i].count, fresh.orderedMoments()[i].count);
    ASSERT_EQ(used.orderedMoments()[i].mean, fresh.orderedMoments()[i].mean);
  }
}

}  // namespace
}  // namespace mems_stiction
