#include "mems_stiction/preprocess/pipeline.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "preprocess/level.hpp"
#include "settings/option_yaml.hpp"
#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"
#include "yaml-cpp/yaml.h"

namespace mems_stiction {
namespace {

HeightMap levelledBy(const HeightMap& surface, const LevelOptions& options) {
  PipelineOptions pipeline;
  pipeline.level = options;
  return cleanScan(surface, pipeline).surface;
}

GaussianSurfaceOptions smoothFilm() {
  GaussianSurfaceOptions options;
  options.rows = 400;
  options.cols = 512;
  options.rms_height = 4e-9;
  options.seed = 11;
  return options;
}

/// As an instrument would deliver it: on a stage, tilted, bowed, with spikes up and down and with
/// holes.
HeightMap spoiled(const HeightMap& clean) {
  cv::Mat heights = clean.asDouble().heights().clone();
  const double width = clean.cols() * clean.pitchX();
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      const double u = 2.0 * col / heights.cols - 1.0;
      const double v = 2.0 * row / heights.rows - 1.0;
      heights.at<double>(row, col) += 2e-3 + 0.02 * width * u - 0.01 * width * v + 25e-9 * u * u -
                                      15e-9 * u * v + 30e-9 * v * v;
    }
  }
  std::mt19937 engine(4);
  const auto place = [&](int size) {
    return cv::Rect(static_cast<int>(engine() % static_cast<unsigned>(heights.cols - size)),
                    static_cast<int>(engine() % static_cast<unsigned>(heights.rows - size)), size,
                    size);
  };
  for (int count = 0; count < 150; ++count)
    heights(place(1 + count % 2)) += count % 3 == 0 ? -60e-9 : 90e-9;
  for (int count = 0; count < 250; ++count) {
    heights(place(1 + count % 4)).setTo(std::numeric_limits<double>::quiet_NaN());
  }
  return {heights, clean.pitchX(), clean.pitchY()};
}

PipelineOptions cleaning() {
  PipelineOptions options;
  options.offset.enabled = true;
  options.spikes.enabled = true;
  options.fill.enabled = true;
  options.level.shape =
      LevelShape::kPolynomial;  // spikes are gone by then: least squares takes nothing else off
  return options;
}

Options polysilicon(double load) {
  Options options;
  options.load.mechanical_load = load;
  return options;
}

TEST(Pipeline, withoutAnyStepIsTheScanItself) {
  const HeightMap scan = analytic::withInvalidPixel(gaussianSurface(smoothFilm()), 3, 4);
  const CleanedScan prepared = cleanScan(scan, PipelineOptions());
  EXPECT_EQ(prepared.surface.heights().data, scan.heights().data);
  EXPECT_TRUE(prepared.record.steps.empty());
}

TEST(Pipeline, planeAloneIsLevelled) {
  const HeightMap scan = analytic::tiltedPlane(30, 40, 5e-9, 6e-9, 0.1, 0.2);
  PipelineOptions options;
  options.level.shape = LevelShape::kPlane;
  const CleanedScan prepared = cleanScan(scan, options);
  EXPECT_EQ(cv::countNonZero(prepared.surface.heights() != levelled(scan).heights()), 0);
  ASSERT_EQ(prepared.record.steps.size(), 1u);
  EXPECT_EQ(prepared.record.steps[0].name, "level");
  EXPECT_EQ(prepared.record.steps[0].parameters, "shape=plane robust=false");
  EXPECT_NEAR(prepared.record.steps[0].rms_change, heightStatistics(scan).rms_height, 1e-20);
}

TEST(Pipeline, recordsWhatEachStepDidInTheOrderOfTheTable) {
  GaussianSurfaceOptions surface = smoothFilm();
  surface.rows = 96;
  surface.cols = 128;
  HeightMap scan = gaussianSurface(surface);
  cv::Mat heights = scan.heights().clone();
  heights += 1e-3;
  heights.at<double>(50, 60) += 100e-9;
  heights.at<double>(20, 30) = std::numeric_limits<double>::quiet_NaN();
  scan = HeightMap(heights, 10e-9, 10e-9);
  PipelineOptions options = cleaning();
  options.lines.method = LineAlignment::kMedian;
  options.tip.radius = 20e-9;
  options.low_pass.cutoff_wavelength = 60e-9;
  options.refine.factor = 2;
  const CleanedScan prepared = cleanScan(scan, options);
  const std::vector<PreprocessStep>& steps = prepared.record.steps;
  ASSERT_EQ(steps.size(), 8u);
  const char* names[] = {"offset", "lines", "spikes", "fill", "tip", "level", "low_pass", "refine"};
  for (std::size_t index = 0; index < steps.size(); ++index)
    EXPECT_EQ(steps[index].name, names[index]);
  EXPECT_NEAR(steps[0].rms_change, 1e-3, 1e-8);
  EXPECT_EQ(steps[0].changed_pixels, 96 * 128 - 1);
  EXPECT_EQ(steps[2].parameters, "threshold=6 window=5");
  EXPECT_EQ(steps[2].changed_pixels, 1);
  EXPECT_EQ(steps[2].invalid_pixels, 2);
  EXPECT_EQ(steps[3].changed_pixels, 2);
  EXPECT_EQ(steps[3].rms_change, 0.0);  // no measured height was touched
  EXPECT_EQ(steps[3].invalid_pixels, 0);
  EXPECT_EQ(steps[4].parameters, "radius=2e-08 half_angle=0");
  EXPECT_GT(steps[6].rms_change, 0.0);
  EXPECT_LT(steps[6].rms_change, 1e-9);
  EXPECT_EQ(prepared.surface.rows(), 192);
  const std::vector<std::string> lines = recordLines(prepared.record);
  ASSERT_EQ(lines.size(), 8u);
  EXPECT_EQ(lines[2], "spikes (threshold=6 window=5): rms change 0 m; 1 pixels changed");
  EXPECT_NE(lines[4].find("fraction not reached"), std::string::npos);
}

TEST(Pipeline, optionsReadFromYamlAndNameWhatIsWrong) {
  PipelineOptions options;
  const auto describe = [&](OptionVisitor& visitor) { options.describe(visitor); };
  const std::vector<std::string> lines =
      readYaml(YAML::Load("preprocessing: {level: polynomial, level_robust: true, fill: {enabled: "
                          "true, max_fraction: 0.2},"
                          " tip/radius: 15e-9, lines: {method: median_difference}}"),
               describe);
  EXPECT_TRUE(lines.empty());
  EXPECT_EQ(options.level.shape, LevelShape::kPolynomial);
  EXPECT_TRUE(options.level.robust);
  EXPECT_TRUE(options.fill.enabled);
  EXPECT_EQ(options.fill.max_fraction, 0.2);
  EXPECT_EQ(options.tip.radius, 15e-9);
  EXPECT_EQ(options.lines.method, LineAlignment::kMedianDifference);

  options.fill.max_fraction = 1.5;
  options.refine.factor = 0;
  try {
    cleanScan(analytic::flat(3, 3, 1e-9, 1e-9), options);
    FAIL() << "was accepted";
  } catch (const OptionsError& error) {
    ASSERT_EQ(error.violations().size(), 2u);
    EXPECT_NE(error.violations()[0].find("preprocessing/fill/max_fraction: 1.5"),
              std::string::npos);
    EXPECT_NE(error.violations()[1].find("preprocessing/refine/factor: 0"), std::string::npos);
  }
}

TEST(Pipeline, refusesAScanWithTooManyHoles) {
  PipelineOptions options = cleaning();
  options.fill.max_fraction = 0.001;
  EXPECT_THROW(cleanScan(spoiled(gaussianSurface(smoothFilm())), options), SurfaceError);
}

// ------------------------------------------------------------------ what it is all for

TEST(CleanedScan, pullOffForceOfAGaussianSurfaceIsThatOfTheCleanOne) {
  for (const int seed : {11, 12, 13}) {
    GaussianSurfaceOptions surface = smoothFilm();
    surface.seed = seed;
    // A random surface has some bow of its own, which nobody can tell from the instrument's: this
    // one has none.
    LevelOptions without_bow;
    without_bow.shape = LevelShape::kPolynomial;
    const HeightMap clean = levelledBy(gaussianSurface(surface), without_bow);
    const CleanedScan prepared = cleanScan(spoiled(clean), cleaning());
    EXPECT_EQ(invalidFraction(prepared.surface), 0.0);
    EXPECT_LT(heightStatistics(HeightMap(prepared.surface.heights() - clean.heights(), 1.0, 1.0))
                  .rms_height,
              0.01 * surface.rms_height);
    AdhesionModel model(polysilicon(200e-6));
    const Prediction expected = model.predict(clean);
    const Prediction found = model.predict(prepared.surface);
    ASSERT_EQ(expected.status, Status::kEquilibrium);
    ASSERT_EQ(found.status, Status::kEquilibrium);
    EXPECT_GT(expected.asperity_count,
              10);  // with three or four, a picometre can decide about one more
    EXPECT_NEAR(found.pull_off_force / expected.pull_off_force, 1.0, 0.05) << "seed " << seed;
  }
}

TEST(CleanedScan, pullOffForceOfASphereIsThatOfTheCleanOne) {
  // A bow cannot be told from a sphere that fills the frame: this one stands on a plane, on 11 % of
  // it. Its apex lies between pixels, so that no two cells have the same gap and it does not hang
  // on round-off which comes first.
  cv::Mat heights = analytic::paraboloid(301, 301, 5e-9, 5e-9, 2e-6, 1.1e-9, -0.7e-9).heights();
  heights += 20e-9;
  heights = cv::max(heights, 0.0);
  const HeightMap clean(heights, 5e-9, 5e-9);
  PipelineOptions options = cleaning();
  options.level.robust = true;
  const CleanedScan prepared = cleanScan(spoiled(clean), options);
  AdhesionModel model(polysilicon(1e-7));
  const Prediction expected = model.predict(clean);
  const Prediction found = model.predict(prepared.surface);
  ASSERT_EQ(expected.status, Status::kEquilibrium);
  ASSERT_EQ(found.status, Status::kEquilibrium);
  EXPECT_EQ(found.asperity_count, 1);
  EXPECT_NEAR(found.pull_off_force / expected.pull_off_force, 1.0, 0.05);
  EXPECT_GT(std::fabs(model.predict(spoiled(clean)).pull_off_force / expected.pull_off_force - 1.0),
            0.2);
}

TEST(CleanedScan, jumpsBetweenLinesLeaveNoTrace) {
  const HeightMap clean = gaussianSurface(smoothFilm());
  cv::Mat heights = clean.heights().clone();
  std::mt19937 engine(8);
  std::normal_distribution<double> normal;
  for (int row = 0; row < heights.rows; ++row) heights.row(row) += 10e-9 * normal(engine);
  PipelineOptions options = cleaning();
  options.lines.method = LineAlignment::kMedian;
  const HeightMap jumped(heights, 10e-9, 10e-9);
  AdhesionModel model(polysilicon(200e-6));
  // Each line takes the median of its own roughness with it, jumps or not.
  const double expected = model.predict(cleanScan(clean, options).surface).pull_off_force;
  EXPECT_NEAR(model.predict(cleanScan(jumped, options).surface).pull_off_force / expected, 1.0,
              0.01);
}

}  // namespace
}  // namespace mems_stiction
