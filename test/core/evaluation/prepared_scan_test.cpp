#include "mems_stiction/evaluation/prepared_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "height_map/scan_sanity.hpp"
#include "import/scan_writer.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "preprocess/refine.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/scratch_folder.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

HeightMap rough(int seed) {
  GaussianSurfaceOptions options;
  options.rows = 64;
  options.cols = 96;
  options.pitch_x = options.pitch_y = 5e-9;
  options.rms_height = 2e-9;
  options.correlation_length_x = options.correlation_length_y = 40e-9;
  options.seed = seed;
  return gaussianSurface(options);
}

Configuration cleaning(CounterSurfaceType type = CounterSurfaceType::kFlat) {
  Configuration configuration;
  configuration.model.load.mechanical_load = 1e-6;
  configuration.preprocessing.offset.enabled = true;
  configuration.preprocessing.level.shape = LevelShape::kPlane;
  configuration.counter_surface.type = type;
  configuration.counter_surface.facing = CounterSurfaceFacing::kDown;
  return configuration;
}

bool showSamePixels(const HeightMap& a, const HeightMap& b) {
  return !a.empty() && a.heights().data == b.heights().data &&
         a.heights().size() == b.heights().size();
}

bool areEqual(const HeightMap& a, const HeightMap& b) {
  return a.heights().size() == b.heights().size() && a.pitchX() == b.pitchX() &&
         cv::norm(a.asDouble().heights(), b.asDouble().heights(), cv::NORM_INF) == 0.0;
}

TEST(PreparedScan, OfAScanThatNeedsNothingIsTheScan) {
  const HeightMap scan = rough(1);
  const PreparedScan prepared = ScanPreparer(Configuration()).prepare(scan);
  EXPECT_TRUE(showSamePixels(prepared.surfaces.lower, scan));
  EXPECT_TRUE(showSamePixels(prepared.model_surfaces.lower, scan));
  EXPECT_TRUE(prepared.surfaces.upperIsPlane());
  EXPECT_TRUE(prepared.model_surfaces.upperIsPlane());
  EXPECT_TRUE(prepared.record.steps.empty());
}

TEST(ScanPreparer, HoldsNoScanForLongerThanItTakes) {
  Configuration configuration;
  configuration.counter_surface.type = CounterSurfaceType::kTopic;
  configuration.counter_surface.facing = CounterSurfaceFacing::kDown;
  ScanPreparer preparer(configuration);
  preparer.setMeasuredCounterSurface(rough(2));
  const auto message = std::make_shared<HeightMap>(rough(1));
  preparer.prepare({message->heights(), message->pitchX(), message->pitchY(), message});
  EXPECT_EQ(message.use_count(), 1);
  const auto counter_message = std::make_shared<HeightMap>(rough(3));
  preparer.setMeasuredCounterSurface({counter_message->heights(), counter_message->pitchX(),
                                      counter_message->pitchY(), counter_message});
  EXPECT_EQ(preparer.prepare(rough(1)).surfaces.upper.heights().data,
            counter_message->heights().data);
  preparer.setMeasuredCounterSurface(rough(2));
  EXPECT_EQ(counter_message.use_count(), 1);
}

TEST(PreparedScan, RefinesBothSurfacesForTheModelAlone) {
  Configuration configuration = cleaning(CounterSurfaceType::kGaussian);
  const PreparedScan plain = ScanPreparer(configuration).prepare(rough(1));
  configuration.preprocessing.refine.factor = 3;
  const PreparedScan fine = ScanPreparer(configuration).prepare(rough(1));
  EXPECT_EQ(plain.refinement, 1);
  EXPECT_TRUE(showSamePixels(plain.surfaces.upper, plain.model_surfaces.upper));
  EXPECT_EQ(fine.refinement, 3);
  EXPECT_TRUE(areEqual(fine.surfaces.lower, plain.surfaces.lower));
  EXPECT_TRUE(areEqual(fine.surfaces.upper, plain.surfaces.upper));
  EXPECT_TRUE(areEqual(fine.model_surfaces.lower,
                       refined(plain.surfaces.lower, configuration.preprocessing.refine)));
  EXPECT_TRUE(areEqual(fine.model_surfaces.upper,
                       refined(plain.surfaces.upper, configuration.preprocessing.refine)));
}

TEST(PreparedScan, ServesEveryLoadAndOutput) {
  Configuration configuration = cleaning(CounterSurfaceType::kGaussian);
  configuration.model.interface.insulator_thickness = 1e-7;
  ScanPredictor predictor(configuration);
  const PreparedScan prepared = predictor.preparer().prepare(rough(1));
  for (const double voltage : {0.0, 20.0}) {
    configuration.model.load.voltage = voltage;
    configuration.model.output.deformed_surfaces = voltage == 0.0;
    predictor.setOptions(configuration.model);
    const Prediction prediction = predictor.predict(prepared);
    const Prediction expected = ScanPredictor(configuration).predict(rough(1));
    EXPECT_EQ(prediction.pull_off_force, expected.pull_off_force);
    EXPECT_EQ(prediction.electrostatic_force, expected.electrostatic_force);
    EXPECT_EQ(prediction.roughness.sdq, expected.roughness.sdq);
    EXPECT_EQ(prediction.deformed_lower.empty(), voltage != 0.0);
  }
  EXPECT_EQ(predictor.preparer().cleanings(), 1U);
}

TEST(PreparedScan, HasItsRoughnessWhereThatIsAskedFor) {
  Configuration configuration = cleaning();
  const PreparedScan figures = ScanPreparer(configuration).prepare(rough(1));
  EXPECT_EQ(figures.roughness.sq, arealParameters(figures.surfaces.lower).sq);
  EXPECT_TRUE(std::isnan(figures.spatial_roughness.sal));
  configuration.model.output.roughness = false;
  configuration.spatial_roughness.enabled = true;
  const PreparedScan lengths = ScanPreparer(configuration).prepare(rough(1));
  EXPECT_EQ(lengths.roughness.sq, 0.0);
  EXPECT_EQ(lengths.spatial_roughness.sal,
            spatialRoughness(figures.surfaces.lower, configuration.spatial_roughness).sal);
}

TEST(PreparedScan, SaysWhereTheSpectrumFillsMissingPixels) {
  Configuration configuration;
  const HeightMap holed = analytic::withInvalidPixel(rough(1), 3, 3);
  EXPECT_TRUE(ScanPreparer(configuration).prepare(holed).warnings.empty());
  configuration.spatial_roughness.enabled = true;
  const PreparedScan prepared = ScanPreparer(configuration).prepare(holed);
  ASSERT_EQ(prepared.warnings.size(), 1U);
  EXPECT_NE(prepared.warnings[0].find("output/spatial_roughness: 1 of "), std::string::npos)
      << prepared.warnings[0];
}

TEST(ScanPreparer, CleansEachMeasuredSurfaceOnce) {
  ScanPreparer preparer(cleaning(CounterSurfaceType::kTopic));
  EXPECT_THROW(preparer.prepare(rough(1)), SurfaceError);
  const std::uint64_t refused = preparer.cleanings();
  preparer.setMeasuredCounterSurface(rough(2));
  const PreparedScan first = preparer.prepare(rough(1));
  const PreparedScan second = preparer.prepare(rough(3));
  EXPECT_EQ(preparer.cleanings() - refused, 3U);  // two scans under one counter-surface
  EXPECT_TRUE(showSamePixels(first.surfaces.upper, second.surfaces.upper));
}

TEST(ScanPreparer, AnotherCounterSurfaceOrPoseTakesNoCleaningOfTheScan) {
  Configuration configuration = cleaning(CounterSurfaceType::kTopic);
  configuration.preprocessing.refine.factor = 2;
  SurfacePose pose;
  pose.offset_x = 20e-9;
  ScanPreparer preparer(configuration);
  preparer.setMeasuredCounterSurface(rough(2));
  PreparedScan prepared = preparer.prepare(rough(1));
  const PreparedScan before = prepared;
  const std::uint64_t cleanings = preparer.cleanings();

  preparer.setMeasuredCounterSurface(rough(3));
  preparer.setCounterSurfacePose(pose);
  preparer.mount(prepared);
  EXPECT_EQ(preparer.cleanings() - cleanings, 1U) << "the new counter-surface alone";
  EXPECT_TRUE(showSamePixels(prepared.model_surfaces.lower, before.model_surfaces.lower));
  ScanPreparer other(configuration);
  other.setMeasuredCounterSurface(rough(3));
  other.setCounterSurfacePose(pose);
  const PreparedScan expected = other.prepare(rough(1));
  EXPECT_FALSE(areEqual(prepared.surfaces.upper, before.surfaces.upper));
  EXPECT_EQ(ScanPredictor(configuration).predict(prepared).pull_off_force,
            ScanPredictor(configuration).predict(expected).pull_off_force);

  preparer.setMeasuredCounterSurface(
      analytic::withInvalidPixel(analytic::flat(64, 96, 5e-9, 5e-9), 0, 0));
  pose.offset_x = 1.0;  // far away
  preparer.setCounterSurfacePose(pose);
  const PreparedScan kept = prepared;
  EXPECT_THROW(preparer.mount(prepared), SurfaceError);
  EXPECT_TRUE(showSamePixels(prepared.surfaces.upper, kept.surfaces.upper));
}

/// The one warning about what the scan meets; empty if there is none.
std::string counterWarning(const PreparedScan& prepared) {
  EXPECT_LE(prepared.counter_warnings.size(), 1U) << prepared.counter_warnings.front();
  return prepared.counter_warnings.empty() ? "" : prepared.counter_warnings.front();
}

TEST(ScanPreparer, ARefusalSaysWhatLooksWrongInTheScan) {
  cv::Mat heights = rough(1).asDouble().heights().clone();
  heights.rowRange(32, 64).setTo(std::numeric_limits<double>::quiet_NaN());  // stopped half-way
  Configuration configuration;
  configuration.preprocessing.fill.enabled = true;
  try {
    ScanPreparer(configuration).prepare({heights, 5e-9, 5e-9});
    FAIL() << "half of a scan was filled";
  } catch (const SurfaceError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("preprocessing/fill/max_fraction"), std::string::npos) << text;
    EXPECT_NE(text.find("32 of 64 rows were not measured"), std::string::npos) << text;
  }
}

TEST(ScanPreparer, SaysThatTheScanMeetsItsOwnCast) {
  const ScratchFolder folder;
  writeScan(folder.file("same.tiff"), rough(1), "a counter-surface");
  Configuration configuration;
  configuration.counter_surface.type = CounterSurfaceType::kFile;
  configuration.counter_surface.file = folder.file("same.tiff");
  configuration.counter_surface.facing = CounterSurfaceFacing::kDown;
  EXPECT_NE(counterWarning(ScanPreparer(configuration).prepare(rough(1))).find("as its cast does"),
            std::string::npos);
  EXPECT_EQ(counterWarning(ScanPreparer(configuration).prepare(rough(2))), "");
  configuration.counter_surface.facing = CounterSurfaceFacing::kUp;
  EXPECT_EQ(counterWarning(ScanPreparer(configuration).prepare(rough(1))), "");
}

TEST(ScanPreparer, SaysThatFeaturesHavePulledThePlane) {
  const HeightMap scan = analytic::sine(64, 96, 10e-9, 20e-9, 2e-9, 3, 0);
  cv::Mat heights = scan.heights().clone();
  heights.colRange(0, 30) += 100e-9;
  Configuration configuration;
  configuration.preprocessing.level.shape = LevelShape::kPlane;
  PreparedScan prepared =
      ScanPreparer(configuration).prepare({heights, scan.pitchX(), scan.pitchY()});
  ASSERT_EQ(prepared.warnings.size(), 1u);
  EXPECT_NE(prepared.warnings[0].find("set preprocessing/level_robust to true"), std::string::npos)
      << prepared.warnings[0];
  EXPECT_GT(prepared.record.steps[0].tilt_left, 30e-9);
  configuration.preprocessing.level.robust = true;
  prepared = ScanPreparer(configuration).prepare({heights, scan.pitchX(), scan.pitchY()});
  EXPECT_TRUE(prepared.warnings.empty());
  EXPECT_LT(prepared.record.steps[0].tilt_left, 1e-9);
  EXPECT_NE(recordLines(prepared.record)[0].find("; tilt and bow left "), std::string::npos);
}

TEST(ScanPreparer, SaysThatAScanIsTiltedUntilItIsLevelled) {
  const HeightMap scan = rough(1);
  cv::Mat tilted = scan.asDouble().heights().clone();
  for (int row = 0; row < tilted.rows; ++row) tilted.row(row) += 1e-9 * row;
  const HeightMap aslant(tilted, scan.pitchX(), scan.pitchY());
  Configuration configuration;
  const std::vector<std::string> warnings = ScanPreparer(configuration).prepare(aslant).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("the scan is tilted"), std::string::npos) << warnings[0];
  configuration.preprocessing.level.shape = LevelShape::kPlane;
  EXPECT_TRUE(ScanPreparer(configuration).prepare(aslant).warnings.empty());
}

TEST(ScanPreparer, SaysThatAFilterLongerThanTheScanLeavesNothing) {
  Configuration configuration;
  configuration.preprocessing.low_pass.cutoff_wavelength =
      1e-6;  // um for nm; the scan is half as wide
  const std::vector<std::string> warnings = ScanPreparer(configuration).prepare(rough(1)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("longer than the scan's width"), std::string::npos) << warnings[0];
  EXPECT_EQ(warnings[0].find(','), std::string::npos);
  configuration.preprocessing.low_pass.cutoff_wavelength = 50e-9;
  EXPECT_TRUE(ScanPreparer(configuration).prepare(rough(1)).warnings.empty());
}

TEST(ScanPreparer, SaysHowMuchOfTheScanACounterSurfaceCovers) {
  const ScratchFolder folder;
  const HeightMap scan = rough(1);  // 64 x 96
  const HeightMap quarter(rough(2).heights()(cv::Rect(0, 0, 48, 32)).clone(), scan.pitchX(),
                          scan.pitchY());
  writeScan(folder.file("quarter.tiff"), quarter, "a counter-surface");
  writeScan(folder.file("whole.tiff"), rough(2), "a counter-surface");
  const std::string a_quarter = "the counter-surface covers 25 % of the scan";
  Configuration configuration = cleaning(CounterSurfaceType::kFile);
  configuration.counter_surface.file = folder.file("quarter.tiff");
  EXPECT_EQ(counterWarning(ScanPreparer(configuration).prepare(scan)).find(a_quarter), 0U);

  configuration.counter_surface.file = folder.file("whole.tiff");
  ScanPreparer of_file(configuration);
  PreparedScan prepared = of_file.prepare(scan);
  EXPECT_EQ(counterWarning(prepared), "");
  SurfacePose pose;  // of the settings or of tf
  pose.offset_x = 48 * scan.pitchX();
  pose.offset_y = -32 * scan.pitchY();
  of_file.setCounterSurfacePose(pose);
  of_file.mount(prepared);
  EXPECT_EQ(counterWarning(prepared).find(a_quarter), 0U);
  EXPECT_EQ(counterWarning(of_file.prepare(scan)).find(a_quarter), 0U);

  ScanPreparer of_topic(cleaning(CounterSurfaceType::kTopic));
  HeightMap holed = rough(2).asDouble();
  cv::Mat heights = holed.heights().clone();
  for (int row = 0; row < heights.rows; ++row) {  // no whole lines, which would be said apart
    for (int col = 0; col < heights.cols; ++col) {
      if ((row + col) % 4 != 0)
        heights.at<double>(row, col) = std::numeric_limits<double>::quiet_NaN();
    }
  }
  of_topic.setMeasuredCounterSurface({heights, scan.pitchX(), scan.pitchY()});
  EXPECT_EQ(counterWarning(of_topic.prepare(scan)).find(a_quarter), 0U);
  of_topic.setMeasuredCounterSurface(rough(2));
  EXPECT_EQ(counterWarning(of_topic.prepare(scan)), "");
  EXPECT_EQ(counterWarning(ScanPreparer(cleaning(CounterSurfaceType::kGaussian)).prepare(scan)),
            "");
}

TEST(ScanPreparer, RefusesWhatNoInstrumentGivesUnlessItIsMeant) {
  const HeightMap scan = rough(1);
  const HeightMap in_nanometres(scan.asDouble().heights() * 1e9, 5e-9, 5e-9);
  const HeightMap in_metres(scan.heights(), 20.0, 20.0);
  for (const auto& [implausible, part] :
       {std::make_pair(in_nanometres, "more than the scan's width"),
        std::make_pair(in_metres, "pitch_x 20 m is above 1 mm")}) {
    Configuration configuration = cleaning();
    try {
      ScanPreparer(configuration).prepare(implausible);
      FAIL() << part;
    } catch (const SurfaceError& error) {
      EXPECT_EQ(std::string(error.what()).find("implausible: "), 0U) << error.what();
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("limits/accept_implausible: true"),
                std::string::npos)
          << error.what();
    }
    configuration.limits.accept_implausible = true;
    const std::vector<std::string> warnings =
        ScanPreparer(configuration).prepare(implausible).warnings;
    ASSERT_FALSE(warnings.empty());
    EXPECT_NE(warnings.front().find(part), std::string::npos) << "still said";
    Configuration topic = cleaning(CounterSurfaceType::kTopic);
    ScanPreparer under(topic);
    under.setMeasuredCounterSurface(implausible);
    EXPECT_THROW(under.prepare(scan), SurfaceError) << part;
  }
}

TEST(ScanPreparer, TakesAScanWhoseDamageTheCleaningMends) {
  cv::Mat heights = rough(1).asDouble().heights().clone();
  heights.at<double>(20, 30) = 1e-3;
  const HeightMap damaged(heights, 5e-9, 5e-9);
  Configuration configuration = cleaning();
  EXPECT_THROW(ScanPreparer(configuration).prepare(damaged), SurfaceError);
  configuration.preprocessing.spikes.enabled = true;
  EXPECT_NO_THROW(ScanPreparer(configuration).prepare(damaged));
}

TEST(ScanPreparer, LooksAtCounterSurfacesAsAtScans) {
  const ScratchFolder folder;
  const HeightMap scan = rough(1);
  const HeightMap coarse(rough(2).heights(), 5e-6, 5e-6);  // um for nm
  EXPECT_EQ(ScanPreparer(cleaning()).prepare(coarse).warnings, scanWarnings(coarse));
  writeScan(folder.file("coarse.tiff"), coarse, "a counter-surface");
  Configuration configuration = cleaning(CounterSurfaceType::kFile);
  configuration.counter_surface.file = folder.file("coarse.tiff");
  const std::string of_file = counterWarning(ScanPreparer(configuration).prepare(scan));
  EXPECT_NE(of_file.find("coarse.tiff: rms slope"), std::string::npos) << of_file;
  EXPECT_NE(of_file.find("was 5e-09 m meant?"), std::string::npos) << of_file;

  ScanPreparer of_topic(cleaning(CounterSurfaceType::kTopic));
  of_topic.setMeasuredCounterSurface(
      {rough(2).asDouble().heights() * 1e-9, scan.pitchX(), scan.pitchY()});
  const std::string measured = counterWarning(of_topic.prepare(scan));
  EXPECT_EQ(measured.find("the counter-surface: rms slope"), 0U) << measured;
}

TEST(ScanPreparer, RefusesAMeasuredCounterSurfaceThatMayFaceEitherWay) {
  ScanPreparer preparer{Configuration()};
  const PreparedScan before = preparer.prepare(rough(1));
  EXPECT_THROW(preparer.setMeasuredCounterSurface(rough(2)), OptionsError);
  EXPECT_TRUE(preparer.prepare(rough(1)).surfaces.upperIsPlane());
}

}  // namespace
}  // namespace mems_stiction
