#include "approach/gap_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/frame_gaps.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kStageOffset = 76e-3;  // m, the z stage of a profiler
// Heights at 76 mm are multiples of 2^-56 m = 1.4e-17 m: two of them make a gap.
constexpr double kSpacingAtOffset = 3e-17;

HeightMap map(const cv::Mat& heights) { return {heights, 2e-9, 3e-9}; }

std::string messageOf(const HeightMap& lower, const HeightMap& upper) {
  try {
    GapField().compute({lower, upper});
  } catch (const SurfaceError& error) {
    return error.what();
  }
  return "";
}

TEST(GapField, countsFromTheHighestPixelToAPlane) {
  GapField field;
  field.compute(map((cv::Mat1d(2, 3) << 1e-9, 5e-9, 2e-9, -4e-9, 0.0, 5e-9)));
  EXPECT_EQ(field.rows(), 2);
  EXPECT_EQ(field.cols(), 3);
  EXPECT_EQ(field.pitchX(), 2e-9);
  EXPECT_EQ(field.pitchY(), 3e-9);
  EXPECT_DOUBLE_EQ(field.cellArea(), 6e-18);
  EXPECT_TRUE(field.upperIsFlat());
  const double expected[] = {4e-9, 0.0, 3e-9, 9e-9, 5e-9, 0.0};
  double sum = 0.0;
  for (int cell = 0; cell < 6; ++cell) {
    EXPECT_DOUBLE_EQ(field.gap(cell), expected[cell]);
    EXPECT_DOUBLE_EQ(field.lowerHeight(cell), -expected[cell]);
    sum += expected[cell];
  }
  EXPECT_DOUBLE_EQ(field.largestGap(), 9e-9);
  EXPECT_DOUBLE_EQ(field.meanGap(), sum / 6);
}

TEST(GapField, countsFromTheClosestPairBetweenTwoSurfaces) {
  GapField field;
  field.compute(
      {map((cv::Mat1d(1, 3) << 1e-9, 5e-9, 2e-9)), map((cv::Mat1d(1, 3) << 9e-9, 9e-9, 3e-9))});
  EXPECT_FALSE(field.upperIsFlat());
  EXPECT_NEAR(field.gap(0), 7e-9, 1e-24);  // round-off of nanometres
  EXPECT_NEAR(field.gap(1), 3e-9, 1e-24);
  EXPECT_EQ(field.gap(2), 0.0);
  // z1 keeps its shape
  EXPECT_NEAR(field.lowerHeight(1) - field.lowerHeight(0), 4e-9, 1e-24);
  EXPECT_NEAR(field.lowerHeight(2) - field.lowerHeight(0), 1e-9, 1e-24);
}

TEST(GapField, doesNotDependOnAStageOffset) {
  const HeightMap surface = samples::gaussian(30, 41, 10e-9, 12e-9, 3e-9, 40e-9, 1);
  const HeightMap other = samples::gaussian(30, 41, 10e-9, 12e-9, 2e-9, 40e-9, 2);
  const HeightMap offset =
      analytic::sum(surface, analytic::flat(30, 41, 10e-9, 12e-9, kStageOffset));
  GapField plain;
  GapField shifted;
  plain.compute(surface);
  shifted.compute(offset);
  for (int cell = 0; cell < plain.cellCount(); ++cell) {
    ASSERT_NEAR(shifted.gap(cell), plain.gap(cell), kSpacingAtOffset);
  }
  plain.compute({surface, other});
  shifted.compute({offset, other});
  for (int cell = 0; cell < plain.cellCount(); ++cell) {
    ASSERT_NEAR(shifted.gap(cell), plain.gap(cell), 2 * kSpacingAtOffset);
    ASSERT_NEAR(shifted.lowerHeight(cell) - shifted.lowerHeight(0),
                plain.lowerHeight(cell) - plain.lowerHeight(0), kSpacingAtOffset);
  }
  // the level is near the surface, not at the stage's zero
  EXPECT_LT(std::abs(shifted.lowerHeight(7)), 1e-7);
}

TEST(GapField, subtractsSinglePrecisionHeightsInDouble) {
  cv::Mat1f heights(1, 2);
  heights(0, 0) = 1e-6f;
  heights(0, 1) = std::nextafter(1e-6f, 0.0f);
  GapField field;
  field.compute(map(heights));
  EXPECT_EQ(field.gap(1), static_cast<double>(heights(0, 0)) - static_cast<double>(heights(0, 1)));
  EXPECT_GT(field.gap(1), 0.0);
}

TEST(GapField, leavesOutPixelsThatAreInvalidInEitherSurface) {
  const HeightMap lower = map((cv::Mat1d(1, 6) << 1e-9, kNan, kInfinity, -kInfinity, 4e-9, 5e-9));
  GapField field;
  field.compute(lower);
  EXPECT_EQ(field.validCount(), 3);
  EXPECT_DOUBLE_EQ(field.meanGap(), (4e-9 + 1e-9) / 3);

  field.compute({lower, map((cv::Mat1d(1, 6) << 9e-9, 9e-9, kInfinity, 9e-9, kNan, 9e-9))});
  EXPECT_EQ(field.validCount(), 2);
  for (const int cell : {1, 2, 3, 4}) {
    EXPECT_FALSE(isValid(field, cell));
    EXPECT_EQ(field.gap(cell), GapField::kInvalidGap);
    EXPECT_TRUE(std::isfinite(field.lowerHeight(cell)));
  }
  EXPECT_NEAR(field.largestGap(), 4e-9, 1e-24);
}

TEST(GapField, keepsNothingOfThePreviousFrame) {
  GapField used;
  used.compute({samples::gaussian(50, 50, 10e-9, 10e-9, 3e-9, 40e-9, 1),
                samples::gaussian(50, 50, 10e-9, 10e-9, 3e-9, 40e-9, 2)});
  const HeightMap small = map((cv::Mat1d(1, 3) << 1e-9, kNan, 2e-9));
  used.compute(small);
  GapField fresh;
  fresh.compute(small);
  EXPECT_EQ(frameGaps(used), frameGaps(fresh));
  EXPECT_EQ(used.validCount(), fresh.validCount());
  EXPECT_EQ(used.meanGap(), fresh.meanGap());
  EXPECT_EQ(used.largestGap(), fresh.largestGap());
  EXPECT_TRUE(used.upperIsFlat());
}

/// Whole metres, so that every sum is exact in whatever order; some are not valid.
template <typename Scalar>
cv::Mat_<Scalar> wholeHeights(int rows, int cols) {
  cv::Mat_<Scalar> heights(rows, cols);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const int number = (31 * row + 17 * col + row * col) % 101;
      heights(row, col) =
          number % 13 == 5 ? static_cast<Scalar>(kNan) : static_cast<Scalar>(number - 40);
    }
  }
  return heights;
}

template <typename Scalar>
void expectSumsOfHeights(int rows, int cols) {
  const cv::Mat_<Scalar> heights = wholeHeights<Scalar>(rows, cols);
  GapField field;
  field.compute(map(heights));
  double first = kNan;
  double highest = -kInfinity;
  double lowest = kInfinity;
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const double height : heights) {
    if (std::isnan(height)) continue;
    if (std::isnan(first)) first = height;
    highest = std::max(highest, height);
    lowest = std::min(lowest, height);
    count += 1.0;
    sum += height - first;
    squares += (height - first) * (height - first);
  }
  const double mean = sum / count;
  EXPECT_EQ(field.validCount(), count);
  EXPECT_EQ(field.largestGap(), highest - lowest);
  EXPECT_EQ(field.meanGap(), (highest - first) - mean);
  EXPECT_EQ(field.rmsGap(), std::sqrt(squares / count - mean * mean));
}

TEST(GapField, sumsSeveralHeightsAtOnceAsOneAfterTheOther) {
  for (int cols = 1; cols <= 13; ++cols) {
    for (const int rows : {1, 2, 9}) {
      SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(cols));
      expectSumsOfHeights<double>(rows, cols);
      expectSumsOfHeights<float>(rows, cols);
    }
  }
}

TEST(ColumnsBetween, areThoseOfOneComparisonAfterTheOther) {
  for (int cols = 0; cols <= 40; ++cols) {
    std::vector<double> gaps;
    for (int col = 0; col < cols; ++col)
      gaps.push_back(col % 11 == 7 ? kInfinity : (37 * col) % 29);
    for (const double from : {0.0, 1.0, 14.0}) {
      for (const double limit : {0.0, 1.0, 14.0, 28.0, 29.0, kInfinity}) {
        if (limit < from) continue;
        std::vector<std::int32_t> expected;
        for (int col = 0; col < cols; ++col) {
          const double gap = gaps[static_cast<std::size_t>(col)];
          if (gap >= from && gap < limit) expected.push_back(col);
        }
        std::vector<std::int32_t> columns(static_cast<std::size_t>(cols) + 1);
        columns.resize(static_cast<std::size_t>(
            columnsBetween(from, limit, gaps.data(), cols, columns.data())));
        EXPECT_EQ(columns, expected) << cols << " columns from " << from << " to " << limit;
      }
    }
  }
}

TEST(GapField, refusesSurfacesWithoutAValidPixel) {
  GapField field;
  EXPECT_THROW(field.compute(map(cv::Mat1d(2, 2, kNan))), SurfaceError);
  EXPECT_THROW(field.compute(map(cv::Mat1f(2, 2, std::numeric_limits<float>::infinity()))),
               SurfaceError);
  const HeightMap left = map((cv::Mat1d(1, 2) << 0.0, kNan));
  const HeightMap right = map((cv::Mat1d(1, 2) << kNan, 0.0));
  EXPECT_NE(messageOf(left, right).find("valid in both"), std::string::npos);
}

TEST(GapField, refusesHeightsThatNoSquareCanHold) {
  const auto message = [](double height, double other) {
    return messageOf(map((cv::Mat1d(2, 3) << 0.0, 1e-9, height, 2e-9, other, kNan)),
                     map(cv::Mat1d(2, 3, 0.0)));
  };
  EXPECT_EQ(message(1e99, 0.0), "");
  for (const double height : {2e154, -2e154, 1e308, -1e308}) {
    EXPECT_NE(message(height, 0.0).find("must be <= 1e+100 m"), std::string::npos)
        << message(height, 0.0);
    EXPECT_NE(message(height, -height).find("must be <= 1e+100 m"), std::string::npos)
        << message(height, -height);
    GapField field;
    EXPECT_THROW(field.compute(map((cv::Mat1d(1, 3) << 0.0, height, 1e-9))), SurfaceError);
  }
}

TEST(GapField, refusesGridsThatDifferAndNamesBoth) {
  const cv::Mat1d heights(2, 3, 0.0);
  const HeightMap lower(heights, 2e-9, 3e-9);
  const std::string size = messageOf(lower, HeightMap(cv::Mat1d(3, 2, 0.0), 2e-9, 3e-9));
  EXPECT_NE(size.find("2 rows x 3 columns"), std::string::npos) << size;
  EXPECT_NE(size.find("3 rows x 2 columns"), std::string::npos) << size;
  const std::string pitch = messageOf(lower, HeightMap(heights, 2e-9, 3.1e-9));
  EXPECT_NE(pitch.find("3.1e-09"), std::string::npos) << pitch;
  EXPECT_NE(messageOf(lower, HeightMap(heights, 2.1e-9, 3e-9)), "");
  // pitches that went through float32 are the same
  EXPECT_EQ(
      messageOf(lower, HeightMap(heights, static_cast<double>(2e-9f), static_cast<double>(3e-9f))),
      "");
}

}  // namespace
}  // namespace mems_stiction
