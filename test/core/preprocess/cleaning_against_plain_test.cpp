#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "mems_stiction/preprocess/pipeline.hpp"
#include "preprocess/polynomial_level.hpp"
#include "preprocess/spike_removal.hpp"
#include "preprocess/stage_offset.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/plain_preparation.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

/// On a stage, tilted and bowed, each line on its own level, with spikes and holes; in single
/// precision.
HeightMap scan(int rows, int cols, unsigned seed) {
  GaussianSurfaceOptions options;
  options.rows = rows;
  options.cols = cols;
  options.rms_height = 5e-9;
  options.correlation_length_x = options.correlation_length_y = 60e-9;
  options.seed = static_cast<int>(seed);
  cv::Mat heights = gaussianSurface(options).heights().clone();
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  for (int row = 0; row < rows; ++row) {
    const double jump = 1e-6 + 2e-9 * normal(engine);
    for (int col = 0; col < cols; ++col) {
      const double u = 2.0 * col / cols - 1.0;
      heights.at<double>(row, col) += jump + 30e-9 * u + 20e-9 * u * u;
    }
  }
  const auto place = [&] {
    return cv::Point(static_cast<int>(engine()) & 0xffff, static_cast<int>(engine()) & 0xffff);
  };
  for (int count = 0; count < rows * cols / 500; ++count) {
    const cv::Point spike = place();
    heights.at<double>(spike.y % rows, spike.x % cols) += 80e-9 * normal(engine);
    const cv::Point hole = place();
    heights.at<double>(hole.y % rows, hole.x % cols) = std::numeric_limits<double>::quiet_NaN();
  }
  return analytic::asSingle(HeightMap(heights, 10e-9, 10e-9));
}

/// The same pixels are valid, and heights are the same to 1e-9 of the rms height: what sums in
/// another order leave.
void expectSame(const HeightMap& found, const cv::Mat1d& expected) {
  const double tolerance = 1e-9 * heightStatistics(found).rms_height;
  int different = 0;
  for (int row = 0; row < found.rows(); ++row) {
    for (int col = 0; col < found.cols(); ++col) {
      const double height = found.height(row, col);
      if (std::isnan(height) != std::isnan(expected(row, col))) ++different;
      if (std::fabs(height - expected(row, col)) > tolerance) ++different;
    }
  }
  EXPECT_EQ(different, 0);
}

class Preparation : public testing::TestWithParam<cv::Size> {
 protected:
  HeightMap scan_ = scan(GetParam().height, GetParam().width, 7);
  cv::Mat1d heights_ = scan_.asDouble().heights().clone();
};

TEST_P(Preparation, takesTheStageOffsetOffAsThePlainOneDoes) {
  PipelineOptions options;
  options.offset.enabled = true;
  expectSame(cleanScan(scan_, options).surface, plain::withoutStageOffset(heights_));
}

TEST_P(Preparation, alignsLinesAsThePlainOneDoes) {
  PipelineOptions options;
  options.lines.method = LineAlignment::kMedian;
  expectSame(cleanScan(scan_, options).surface, plain::withoutLineMedians(heights_));
}

TEST_P(Preparation, findsTheSpikesOfThePlainOne) {
  for (const int window : {3, 5}) {
    PipelineOptions options;
    options.spikes.enabled = true;
    options.spikes.window = window;
    const CleanedScan prepared = cleanScan(scan_, options);
    EXPECT_GT(prepared.record.steps[0].changed_pixels, heights_.total() / 1000);
    expectSame(prepared.surface,
               plain::withoutSpikes(heights_, window / 2, options.spikes.threshold));
  }
}

TEST_P(Preparation, levelsAsThePlainOneDoes) {
  PipelineOptions options;
  options.level.shape = LevelShape::kPlane;
  expectSame(cleanScan(scan_, options).surface, plain::withoutPlane(heights_));
}

TEST_P(Preparation, isThePlainOnesStepByStep) {
  PipelineOptions options;
  options.offset.enabled = true;
  options.lines.method = LineAlignment::kMedian;
  options.spikes.enabled = true;
  options.level.shape = LevelShape::kPlane;
  const cv::Mat1d aligned = plain::withoutLineMedians(plain::withoutStageOffset(heights_));
  expectSame(cleanScan(scan_, options).surface,
             plain::withoutPlane(plain::withoutSpikes(aligned, 2, options.spikes.threshold)));
}

INSTANTIATE_TEST_SUITE_P(Frames, Preparation,
                         testing::Values(cv::Size(256, 256), cv::Size(131, 90), cv::Size(61, 203)));

TEST(SampledFit, restsWhereTheOneOverAllPixelsDoes) {
  for (const cv::Size& size : {cv::Size(512, 400), cv::Size(333, 120)}) {
    WorkingSurface work(scan(size.height, size.width, 3));
    const PolynomialSurface all = fitPolynomial(work.heights, work.pitch_x, work.pitch_y, 2,
                                                FitWeights::kRobust, work.memory);
    const PolynomialSurface sampled =
        fitPolynomialBySamples(work.heights, work.pitch_x, work.pitch_y, 2, work.memory);
    const double right = size.width * work.pitch_x;
    const double bottom = size.height * work.pitch_y;
    for (const double x : {0.0, 0.5 * right, right}) {
      for (const double y : {0.0, 0.5 * bottom, bottom}) {
        // Both stop at steps of 1e-4 noise in each of six terms, and the noise is that of a sample
        // here.
        EXPECT_NEAR(sampled.height(x, y), all.height(x, y), 2e-3 * all.noise);
      }
    }
  }
}

TEST(SampledFit, ofFewPixelsIsTheOneOverAllOfThem) {
  WorkingSurface work(scan(40, 50, 3));
  const PolynomialSurface all =
      fitPolynomial(work.heights, work.pitch_x, work.pitch_y, 2, FitWeights::kRobust, work.memory);
  const PolynomialSurface sampled =
      fitPolynomialBySamples(work.heights, work.pitch_x, work.pitch_y, 2, work.memory);
  EXPECT_EQ(sampled.coefficients, all.coefficients);
}

// ------------------------------------------------------------------ one object, scan after scan

PipelineOptions recipe() {
  PipelineOptions options;
  options.offset.enabled = true;
  options.lines.method = LineAlignment::kMedian;
  options.spikes.enabled = true;
  options.fill.enabled = true;
  options.level.shape = LevelShape::kPlane;
  return options;
}

bool areSame(const HeightMap& first, const HeightMap& second) {
  return first.rows() == second.rows() && first.cols() == second.cols() &&
         cv::countNonZero(first.heights() != second.heights()) == 0;
}

TEST(ScanCleaner, preparesEveryScanAsIfItWereTheFirst) {
  ScanCleaner cleaner(recipe());
  for (const HeightMap& each : {scan(120, 90, 1), scan(60, 70, 2), scan(120, 90, 3)}) {
    const CleanedScan alone = cleanScan(each, recipe());
    const CleanedScan& prepared = cleaner.clean(each);
    EXPECT_TRUE(areSame(prepared.surface, alone.surface));
    EXPECT_EQ(recordLines(prepared.record), recordLines(alone.record));
  }
}

TEST(ScanCleaner, leavesASurfaceAloneThatSomebodyHolds) {
  ScanCleaner cleaner(recipe());
  const HeightMap held = cleaner.clean(scan(120, 90, 1)).surface;
  const cv::Mat before = held.heights().clone();
  cleaner.clean(scan(120, 90, 2));
  EXPECT_EQ(cv::countNonZero(held.heights() != before), 0);
}

TEST(ScanCleaner, neverWritesToTheScan) {
  const HeightMap wide = scan(64, 64, 4).asDouble();
  const cv::Mat before = wide.heights().clone();
  ScanCleaner cleaner(recipe());
  cleaner.clean(wide);
  cleaner.clean(wide);
  EXPECT_EQ(cv::norm(cv::Mat(cv::abs(wide.heights() - before) > 0.0)), 0.0);
}

}  // namespace
}  // namespace mems_stiction
