/// What is kept of an area: its highest cells and how many others lie where, whatever comes in
/// which order; and what is refused.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "approach/area_cells.hpp"
#include "approach/cell_islands.hpp"
#include "approach/far_gaps.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kFinest = 1.0 / 549755813888.0;  // 2^-39

cv::Mat1d randomHeights(int rows, int cols, double scale, unsigned seed, double level = 0.0) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> height(level, scale);
  cv::Mat1d heights(rows, cols);
  std::generate(heights.begin(), heights.end(), [&] { return height(generator); });
  return heights;
}

TEST(HeightCounts, countEveryFiniteHeight) {
  cv::Mat1d heights = randomHeights(1, 1000, 5e-9, 1, -2e-9);
  heights(0, 10) = kNaN;
  heights(0, 20) = std::numeric_limits<double>::infinity();
  HeightCounts counts;
  std::vector<std::int32_t> slots(1000);
  counts.add(heights[0], 1000, slots.data());
  EXPECT_EQ(counts.total(), 998);
  EXPECT_EQ(counts.width(), kFinest);
  for (int i = 0; i < 1000; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    if (!std::isfinite(heights(0, i))) {
      EXPECT_EQ(slots[slot], 0);
      continue;
    }
    const std::int64_t bucket = counts.bucketOf(heights(0, i));
    EXPECT_EQ(counts.slotOf(bucket), slots[slot]);
    EXPECT_NEAR(counts.centre(bucket), heights(0, i), 0.500001 * kFinest);
    EXPECT_GE(counts.countOf(bucket), 1);
  }
  EXPECT_EQ(counts.countOf(counts.highest() + 1), 0);
  EXPECT_EQ(counts.lowestWithin(998), counts.lowest());
  EXPECT_GT(counts.lowestWithin(997), counts.lowest());
  EXPECT_EQ(counts.lowestWithin(0), counts.highest() + 1);
}

TEST(HeightCounts, haveBucketsAsWideAsTheRangeAsks) {
  // one that lies far out, before or behind the others, here or in another part
  const double far = -40e-6;
  cv::Mat1d heights = randomHeights(1, 1001, 5e-9, 1);
  std::vector<std::int32_t> slots(1001);
  std::vector<std::string> bytes;
  for (const int place : {0, 500, 1000}) {
    cv::Mat1d with_far = heights.clone();
    std::swap(with_far(0, place), with_far(0, 1000));
    with_far(0, place) = far;
    if (place != 1000) with_far(0, 1000) = heights(0, place);
    HeightCounts counts;
    for (int i = 0; i < 1001; ++i) counts.add(with_far[0] + i, 1, slots.data());
    EXPECT_EQ(counts.width(), 32 * kFinest);
    EXPECT_EQ(counts.total(), 1001);
    HeightCounts first;
    first.add(with_far[0], 300, slots.data());
    HeightCounts rest;
    rest.add(with_far[0] + 300, 701, slots.data());
    HeightCounts sum = rest;
    sum.add(first);
    first.add(rest);
    for (const HeightCounts* const one : {&sum, &first}) {
      ASSERT_EQ(one->width(), counts.width());
      ASSERT_EQ(one->lowest(), counts.lowest());
      const std::int64_t highest = counts.highest();
      for (std::int64_t i = counts.lowest(); i <= highest; ++i) {
        if (one->countOf(i) != counts.countOf(i)) FAIL() << "bucket " << i;
      }
    }
  }
}

TEST(AreaCells, keepThoseAboveTheirLevel) {
  const cv::Mat1d heights = randomHeights(50, 70, 5e-9, 2);
  const double highest = *std::max_element(heights.begin(), heights.end());
  AreaCellLimits deep;
  deep.depth = highest - 3e-9;
  AreaCellLimits few;
  few.most_cells =
      std::count_if(heights.begin(), heights.end(), [](double height) { return height > 3e-9; });
  for (const AreaCellLimits& one : {deep, few}) {
    AreaCells cells(1e-9, 2e-9, one);
    cells.add(-3, 10, heights);
    EXPECT_EQ(cells.validCount(), 3500);
    EXPECT_NEAR(cells.area(), 3500 * 2e-18, 1e-30);
    EXPECT_EQ(cells.highest(), highest);
    EXPECT_NEAR(cells.level(), 3e-9, 0.1e-9);
    const std::vector<AreaCell> kept = cells.cellsFrom(cells.levelBucket());
    EXPECT_EQ(static_cast<std::int64_t>(kept.size()), cells.cellCount());
    EXPECT_EQ(static_cast<std::int64_t>(kept.size()),
              std::count_if(heights.begin(), heights.end(),
                            [&](double height) { return height > cells.level(); }));
    for (const AreaCell& cell : kept) EXPECT_EQ(cell.relief, heights(cell.row + 3, cell.col - 10));
  }
}

TEST(AreaCells, areTheSameInSinglePrecision) {
  cv::Mat1f heights;
  randomHeights(50, 70, 5e-9, 2).convertTo(heights, CV_32F);
  cv::Mat1d same;
  heights.convertTo(same, CV_64F);
  AreaCells single(1e-9, 1e-9);
  AreaCells twice(1e-9, 1e-9);
  single.add(0, 0, heights);
  twice.add(0, 0, same);
  EXPECT_EQ(single.toBytes(), twice.toBytes());
}

TEST(AreaCells, doNotDependOnTheOrderWithAnyLimit) {
  AreaCellLimits by_number;
  by_number.most_cells = 500;
  AreaCellLimits by_depth;
  by_depth.depth = 4e-9;
  AreaCellLimits by_all = by_depth;
  by_all.most_cells = 800;
  std::vector<cv::Mat1d> tiles;
  for (unsigned i = 0; i < 40; ++i)
    tiles.push_back(randomHeights(40, 40, 2e-9 + 0.2e-9 * (i % 7), i));
  tiles[30](5, 5) = -30e-6;  // buckets become wider then
  for (const AreaCellLimits& limits : {by_number, by_depth, by_all}) {
    std::string expected;
    std::vector<std::size_t> order(tiles.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    for (unsigned seed = 0; seed < 5; ++seed) {
      AreaCells cells(1e-9, 1e-9, limits);
      AreaCells other(1e-9, 1e-9, limits);
      for (std::size_t i = 0; i < order.size(); ++i) {
        (i % 3 == 0 ? other : cells)
            .add(static_cast<std::int64_t>(order[i]) * 40, 0, tiles[order[i]]);
        if (i == 20) cells = AreaCells::fromBytes(cells.toBytes());
      }
      cells.add(other);
      if (seed == 0) expected = cells.toBytes();
      EXPECT_TRUE(cells.toBytes() == expected) << "other bits";
      EXPECT_GT(cells.cellCount(), 50);
      std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    }
  }
}

TEST(AreaCells, refuseBytesThatAreNoneOfTheirs) {
  AreaCells cells(1e-9, 1e-9);
  cells.add(0, 0, randomHeights(10, 10, 1e-9, 1));
  const std::string bytes = cells.toBytes();
  EXPECT_EQ(AreaCells::fromBytes(bytes).toBytes(), bytes);
  EXPECT_THROW(AreaCells::fromBytes(""), SurfaceError);
  EXPECT_THROW(AreaCells::fromBytes(bytes.substr(0, bytes.size() - 1)), SurfaceError);
  EXPECT_THROW(AreaCells::fromBytes(bytes + " "), SurfaceError);
  for (std::size_t place = 0; place < bytes.size(); place += 7) {
    std::string changed = bytes;
    changed[place] = static_cast<char>(changed[place] ^ 1);
    EXPECT_THROW(AreaCells::fromBytes(changed), SurfaceError) << place;
  }
  const AreaCells empty(1e-9, 1e-9);
  EXPECT_EQ(AreaCells::fromBytes(empty.toBytes()).toBytes(), empty.toBytes());
}

TEST(AreaCells, refuseWhatIsNoPartOfOneArea) {
  AreaCells cells(1e-9, 1e-9);
  const cv::Mat1d heights = randomHeights(10, 10, 1e-9, 1);
  EXPECT_THROW(AreaCells(0.0, 1e-9), SurfaceError);
  AreaCellLimits none;
  none.most_cells = 0;
  EXPECT_THROW(AreaCells(1e-9, 1e-9, none), SurfaceError);
  EXPECT_THROW(cells.add(0, 0, cv::Mat1b(3, 3)), SurfaceError);
  EXPECT_THROW(cells.add(std::int64_t{1} << 40, 0, heights), SurfaceError);
  EXPECT_THROW(cells.add(0, 0, cv::Mat1d(3, 3, 2e3)), SurfaceError);
  EXPECT_THROW(cells.add(0, 0, cv::Mat1d(3, 3, 1e300)), SurfaceError);
  EXPECT_THROW(cells.add(AreaCells(2e-9, 1e-9)), SurfaceError);
  AreaCellLimits others;
  others.depth = 1e-9;
  EXPECT_THROW(cells.add(AreaCells(1e-9, 1e-9, others)), SurfaceError);
  cells.add(0, 0, heights);
  EXPECT_NO_THROW(cells.cellsFrom(cells.levelBucket()));
  cells.add(9, 9, heights);  // over one cell of the first
  EXPECT_THROW(cells.cellsFrom(cells.levelBucket()), SurfaceError);
}

/// Labels of connected valid cells of a frame by brute force: for each, its cells' heights in the
/// order of the frame.
std::vector<std::vector<double>> islandsOf(const cv::Mat1d& frame) {
  cv::Mat1b seen(frame.size(), 0);
  std::vector<std::vector<double>> islands;
  for (int row = 0; row < frame.rows; ++row) {
    for (int col = 0; col < frame.cols; ++col) {
      if (std::isnan(frame(row, col)) || seen(row, col)) continue;
      std::vector<cv::Point> cells = {{col, row}};
      seen(row, col) = 1;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        for (int y = std::max(cells[i].y - 1, 0); y <= std::min(cells[i].y + 1, frame.rows - 1);
             ++y) {
          for (int x = std::max(cells[i].x - 1, 0); x <= std::min(cells[i].x + 1, frame.cols - 1);
               ++x) {
            if (std::isnan(frame(y, x)) || seen(y, x)) continue;
            seen(y, x) = 1;
            cells.emplace_back(x, y);
          }
        }
      }
      std::sort(cells.begin(), cells.end(), [](const cv::Point& a, const cv::Point& b) {
        return a.y != b.y ? a.y < b.y : a.x < b.x;
      });
      std::vector<double> heights;  // and where they lie from the first
      for (const cv::Point& cell : cells) {
        heights.insert(heights.end(), {frame(cell), static_cast<double>(cell.x - cells[0].x),
                                       static_cast<double>(cell.y - cells[0].y)});
      }
      islands.push_back(heights);
    }
  }
  std::sort(islands.begin(), islands.end());
  return islands;
}

TEST(FrameOfIslands, hasEachIslandAsItIs) {
  for (const double share : {0.02, 0.2, 0.35, 0.6}) {
    cv::Mat1d frame = randomHeights(60, 80, 1.0, 5);
    std::vector<double> sorted(frame.begin(), frame.end());
    std::sort(sorted.begin(), sorted.end());
    const double level =
        sorted[static_cast<std::size_t>((1.0 - share) * static_cast<double>(sorted.size()))];
    std::vector<AreaCell> cells;
    for (int row = 0; row < frame.rows; ++row) {
      for (int col = 0; col < frame.cols; ++col) {
        if (frame(row, col) > level) {
          cells.push_back({row + 1000, col - 7, frame(row, col)});
        } else {
          frame(row, col) = kNaN;
        }
      }
    }
    const auto packed = frameOfIslands(cells, 1e-9, 1e-9, 1 << 20);
    ASSERT_TRUE(packed);
    EXPECT_EQ(islandsOf(packed->asDouble().heights()), islandsOf(frame));
    EXPECT_LT(packed->rows() * packed->cols(), share < 0.1 ? 1000 : 12000);
    EXPECT_FALSE(frameOfIslands(cells, 1e-9, 1e-9, static_cast<std::int64_t>(cells.size()) - 1));
  }
}

TEST(FrameOfIslands, isInSinglePrecisionIfThatIsExact) {
  EXPECT_EQ(frameOfIslands({{0, 0, 0.5}, {5, 9, 0.25}}, 1e-9, 1e-9, 100)->heights().type(),
            CV_32FC1);
  EXPECT_EQ(frameOfIslands({{0, 0, 0.5}, {5, 9, 0.1}}, 1e-9, 1e-9, 100)->heights().type(),
            CV_64FC1);
}

TEST(FarGaps, sumALawAsItsCellsWould) {
  const double range = 0.16e-9;
  const cv::Mat1d heights = randomHeights(300, 300, 10e-9, 6);
  AreaCells cells(1e-9, 1e-9);
  cells.add(0, 0, heights);
  const double top = cells.highest();
  const HeightCounts& counts = cells.counts();
  for (const double first : {0.5e-9, 5e-9, 20e-9}) {
    const FarGaps far(counts, counts.bucketOf(top - first), top, range);
    EXPECT_NEAR(far.first(), first, 2 * kFinest);
    double count = 0.0;
    double gap_sum = 0.0;
    double force = 0.0;
    double expected_force = 0.0;
    const double approach = far.first() - range;
    const auto law = [&](double gap) { return std::pow(gap - approach + range, -3.0); };
    for (const double height : heights) {
      const double gap = top - height;
      if (gap < far.first()) continue;
      count += 1.0;
      gap_sum += gap;
      expected_force += law(gap);
    }
    for (const GapMoments& gaps : far.moments()) {
      const double distance = gaps.mean - approach + range;
      force += gaps.count * law(gaps.mean) * (1.0 + 6.0 * gaps.variance / (distance * distance));
    }
    EXPECT_EQ(static_cast<double>(far.count()), count);
    EXPECT_NEAR(far.gapSum(), gap_sum, 1e-6 * gap_sum);
    EXPECT_NEAR(force, expected_force, 3e-4 * expected_force);
    EXPECT_LT(far.moments().size(), 1000U);
    for (const double limit : {first, 1.5 * first, 30e-9, 200e-9}) {
      const auto below = std::count_if(heights.begin(), heights.end(), [&](double height) {
        return top - height >= far.first() && top - height < limit;
      });
      EXPECT_NEAR(far.cellsBelow(limit), static_cast<double>(below), 3.0);
    }
  }
}

}  // namespace
}  // namespace mems_stiction
