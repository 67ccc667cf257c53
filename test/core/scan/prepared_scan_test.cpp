#include "mems_stiction/scan/prepared_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/preprocess/refine.hpp"
#include "mems_stiction/scan/scan_predictor.hpp"
#include "mems_stiction/surface/gaussian_surface.hpp"
#include "support/analytic_surfaces.hpp"

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
  return configuration;
}

bool showSamePixels(const HeightMap& a, const HeightMap& b) {
  return !a.empty() && a.heights().data == b.heights().data && a.heights().size() == b.heights().size();
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
  ScanPreparer preparer(configuration);
  preparer.setMeasuredCounterSurface(rough(2));
  const auto message = std::make_shared<HeightMap>(rough(1));
  preparer.prepare({message->heights(), message->pitchX(), message->pitchY(), message});
  EXPECT_EQ(message.use_count(), 1);
  const auto counter_message = std::make_shared<HeightMap>(rough(3));
  preparer.setMeasuredCounterSurface(
      {counter_message->heights(), counter_message->pitchX(), counter_message->pitchY(), counter_message});
  EXPECT_EQ(preparer.prepare(rough(1)).surfaces.upper.heights().data, counter_message->heights().data);
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
  EXPECT_TRUE(areEqual(fine.model_surfaces.lower, refined(plain.surfaces.lower, configuration.preprocessing.refine)));
  EXPECT_TRUE(areEqual(fine.model_surfaces.upper, refined(plain.surfaces.upper, configuration.preprocessing.refine)));
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

  preparer.setMeasuredCounterSurface(analytic::withInvalidPixel(analytic::flat(64, 96, 5e-9, 5e-9), 0, 0));
  pose.offset_x = 1.0;  // far away
  preparer.setCounterSurfacePose(pose);
  const PreparedScan kept = prepared;
  EXPECT_THROW(preparer.mount(prepared), SurfaceError);
  EXPECT_TRUE(showSamePixels(prepared.surfaces.upper, kept.surfaces.upper));
}

}  // namespace
}  // namespace mems_stiction
