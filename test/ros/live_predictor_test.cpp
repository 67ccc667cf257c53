#include "ros/live_predictor.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <boost/make_shared.hpp>

#include "evaluation/frame_load.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "ros/display_conversion.hpp"
#include "ros/prediction_conversion.hpp"
#include "station/contact_cycles.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

ReceivedScan scanOf(const HeightMap& surface) {
  return {std_msgs::Header(), surface, std::nullopt, {}};
}

ReceivedScan roughScan(int seed = 3) {
  GaussianSurfaceOptions options;
  options.rows = 96;
  options.cols = 128;
  options.rms_height = 8e-9;
  options.seed = seed;
  return scanOf(gaussianSurface(options));
}

/// Soft, so that contacts leave their mark; hard enough that they come to rest.
Configuration softConfiguration() {
  Configuration configuration;
  configuration.model.lower.hardness = 8e9;
  configuration.model.load.mechanical_load = 2e-6;
  configuration.model.interface.insulator_thickness = 100e-9;
  return configuration;
}

void setLoad(LivePredictor& predictor, double voltage, double mechanical_load) {
  RunningSettings settings = predictor.settings().current();
  settings.load.voltage = voltage;
  settings.load.mechanical_load = mechanical_load;
  predictor.settings().change(settings);
}

/// Every figure, wall time apart.
void expectSame(const PredictedScan& left, const PredictedScan& right) {
  StictionPrediction a = predictionMessage(left, {});
  StictionPrediction b = predictionMessage(right, {});
  a.processing_time = b.processing_time = 0.0;
  std::ostringstream text_a, text_b;
  text_a.precision(17), text_b.precision(17);
  text_a << a, text_b << b;
  EXPECT_EQ(text_a.str(), text_b.str());
}

TEST(LivePredictor, TheFiguresDoNotDependOnWhatElseIsAskedFor) {
  LivePredictor predictor(softConfiguration(), false);
  const ReceivedScan scan = roughScan();
  OutputOptions little;
  little.deformed_surfaces = little.contact_map = little.asperities = false;
  const PredictedScan small = predictor.predictScan(scan, little);
  const PredictedScan full = predictor.predictScan(scan, OutputOptions());
  expectSame(small, full);
  EXPECT_TRUE(small.prediction.deformed_lower.empty());
  EXPECT_TRUE(small.prediction.contact_map.empty());
  EXPECT_FALSE(full.prediction.deformed_lower.empty());
}

TEST(LivePredictor, VoltageActsBySquareAndARefusalChangesNothing) {
  LivePredictor predictor(softConfiguration(), false);
  EXPECT_FALSE(predictor.predictLastScan());
  predictor.predictScan(roughScan(), OutputOptions());
  setLoad(predictor, 1e-3, 2e-6);  // so small that the gap stays the same
  const double once = predictor.predictLastScan()->prediction.electrostatic_force;
  setLoad(predictor, 2e-3, 2e-6);
  const double twice = predictor.predictLastScan()->prediction.electrostatic_force;
  ASSERT_GT(once, 0.0);
  EXPECT_NEAR(twice / once, 4.0, 1e-9);
  for (const double refused : {1e9, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(setLoad(predictor, refused, 0.0), OptionsError) << refused;
    EXPECT_THROW(setLoad(predictor, 0.0, refused), OptionsError) << refused;
  }
  EXPECT_THROW(setLoad(predictor, 0.0, -1e-9), OptionsError);
  EXPECT_EQ(predictor.settings().current().load.voltage, 2e-3);
  EXPECT_EQ(predictor.settings().current().load.mechanical_load, 2e-6);
}

TEST(LivePredictor, ASinglePredictionEqualsTheScansAndLeavesNoTrace) {
  LivePredictor predictor(softConfiguration(), true);
  const ReceivedScan scan = roughScan();
  const PredictedScan single = predictor.predictOnce(scan, 0.0, 2e-6);
  EXPECT_FALSE(predictor.lastScan());
  const PredictedScan live = predictor.predictScan(scan, OutputOptions());
  expectSame(single, live);
  expectSame(single, predictor.predictOnce(scan, 0.0, 2e-6));
  predictor.predictOnce(scan, 1.0, 1e-6);
  EXPECT_EQ(predictor.settings().current().load.mechanical_load, 2e-6);
  expectSame(*predictor.predictLastScan(), live);
}

TEST(LivePredictor, AccumulatedDeformationIsTheNextScansSurface) {
  Configuration configuration = softConfiguration();
  configuration.model.load.mechanical_load = 1e-4;
  LivePredictor predictor(configuration, true);
  const ReceivedScan scan = roughScan();
  const PredictedScan first_scan = predictor.predictScan(scan, OutputOptions());
  const Prediction& first = first_scan.prediction;
  ASSERT_GT(first.plastic_count + first.elasto_plastic_count, 0);
  const Prediction second = predictor.predictScan(scan, OutputOptions()).prediction;

  // What is shown is what was predicted: the mark of the first contact.
  EXPECT_EQ(cv::norm(predictor.lastSurface().heights(), first.deformed_lower, cv::NORM_INF), 0.0);
  ScanPredictor fresh(configuration);
  const Prediction expected =
      fresh.predict(HeightMap(first.deformed_lower, scan.surface.pitchX(), scan.surface.pitchY()));
  EXPECT_NEAR(second.pull_off_force, expected.pull_off_force, 1e-9 * expected.pull_off_force);
  EXPECT_NE(second.approach, first.approach) << "first touch is another now";
  // The third meets the marks of both.
  predictor.predictScan(scan, OutputOptions());
  EXPECT_EQ(cv::norm(predictor.lastSurface().heights(), second.deformed_lower, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(second.deformed_lower, first.deformed_lower, cv::NORM_INF), 1e-12);

  predictor.resetSurface();
  expectSame(predictor.predictScan(scan, OutputOptions()), first_scan);
}

/// Live scans of one surface, and as many contacts of it.
void expectSameAsCycles(const Configuration& configuration, const ReceivedScan& scan) {
  LivePredictor live(configuration, true);
  LivePredictor cycling(configuration, false);
  if (configuration.counter_surface.type == CounterSurfaceType::kTopic) {
    live.setCounterSurface(roughScan(4));
    cycling.setCounterSurface(roughScan(4));
  }
  const StationCase station_case = cycling.stationCase(&scan);
  const ContactCyclesResult cycled =
      cycleContacts(onFrame(configuration.model, configuration.device, station_case.scan.surfaces),
                    station_case.scan.model_surfaces, 4, configuration.device, {}, {});
  for (const ContactCycle& cycle : cycled.cycles) {
    const Prediction contact = live.predictScan(scan, OutputOptions()).prediction;
    EXPECT_EQ(contact.pull_off_force, cycle.pull_off_force) << cycle.cycle;
    EXPECT_EQ(contact.van_der_waals_force, cycle.van_der_waals_force) << cycle.cycle;
    EXPECT_EQ(contact.contact_fraction, cycle.contact_fraction) << cycle.cycle;
    EXPECT_EQ(contact.asperity_count, cycle.asperity_count) << cycle.cycle;
  }
  EXPECT_NE(cycled.cycles[1].pull_off_force, cycled.cycles[0].pull_off_force)
      << "a contact that leaves no mark";
}

TEST(LivePredictor, AccumulatedDeformationIsThatOfCyclesToTheBit) {
  Configuration configuration = softConfiguration();
  configuration.model.load.mechanical_load = 1e-4;
  expectSameAsCycles(configuration, roughScan());  // the scan alone flows
  configuration.model.upper.hardness = configuration.model.lower.hardness;
  expectSameAsCycles(configuration, roughScan());
  configuration.counter_surface.type = CounterSurfaceType::kTopic;
  configuration.counter_surface.facing = CounterSurfaceFacing::kDown;
  expectSameAsCycles(configuration, roughScan());
  configuration.preprocessing.level.shape = LevelShape::kPlane;
  expectSameAsCycles(configuration, roughScan());
  configuration.preprocessing.refine.factor = 2;
  expectSameAsCycles(configuration, roughScan());
  configuration.model.formulation = "paper";
  expectSameAsCycles(configuration, roughScan());
}

TEST(LivePredictor, TheSoftCounterSurfaceIsWornToo) {
  Configuration configuration = softConfiguration();
  configuration.model.load.mechanical_load = 1e-4;
  std::swap(configuration.model.lower.hardness, configuration.model.upper.hardness);
  configuration.model.lower.hardness =
      100.0 * configuration.model.upper.hardness;  // the plane alone flows
  expectSameAsCycles(configuration, roughScan());
}

TEST(LivePredictor, AGivenScanIsTakenAsItWasMadeAndTheLastOneAsTheContactsLeftIt) {
  Configuration configuration = softConfiguration();
  configuration.model.load.mechanical_load = 1e-4;
  LivePredictor predictor(configuration, true);
  const ReceivedScan scan = roughScan();
  const cv::Mat unworn = predictor.stationCase(&scan).scan.surfaces.lower.asDouble().heights();
  predictor.predictScan(scan, OutputOptions());
  predictor.predictScan(scan, OutputOptions());
  const auto distance = [&](const StationCase& found) {
    return cv::norm(found.scan.surfaces.lower.asDouble().heights(), unworn, cv::NORM_INF);
  };
  EXPECT_EQ(distance(predictor.stationCase(&scan)), 0.0);
  EXPECT_GT(distance(predictor.stationCase(nullptr)), 0.0);
}

TEST(LivePredictor, WearIsMeasuredOnTheLevelledSurface) {
  Configuration configuration = softConfiguration();
  LivePredictor plain(configuration, true);
  configuration.preprocessing.level.shape = LevelShape::kPlane;
  LivePredictor levelling(configuration, true);
  const ReceivedScan flat = roughScan();
  cv::Mat tilted = flat.surface.heights().clone();
  for (int col = 0; col < tilted.cols; ++col) tilted.col(col) += 1e-9 * col + 1e-6;
  const ReceivedScan tilted_scan =
      scanOf(HeightMap(tilted, flat.surface.pitchX(), flat.surface.pitchY()));
  const ReceivedScan levelled_scan =
      scanOf(ScanPreparer(configuration).prepare(flat.surface).surfaces.lower);
  plain.predictScan(levelled_scan, OutputOptions());
  levelling.predictScan(tilted_scan, OutputOptions());
  const double once = plain.predictScan(levelled_scan, OutputOptions()).prediction.pull_off_force;
  const double levelled =
      levelling.predictScan(tilted_scan, OutputOptions()).prediction.pull_off_force;
  EXPECT_NEAR(levelled, once, 1e-6 * once);
}

TEST(LivePredictor, AnotherSizeIsAnotherSurface) {
  LivePredictor predictor(softConfiguration(), true);
  predictor.predictScan(roughScan(), OutputOptions());
  GaussianSurfaceOptions options;
  options.rows = 64;
  options.cols = 64;
  options.correlation_length_x = options.correlation_length_y = 40e-9;
  const ReceivedScan other = scanOf(gaussianSurface(options));
  LivePredictor fresh(softConfiguration(), true);
  expectSame(predictor.predictScan(other, OutputOptions()),
             fresh.predictScan(other, OutputOptions()));
}

TEST(LivePredictor, WaitsForTheCounterSurfaceOfTheTopic) {
  Configuration configuration = softConfiguration();
  configuration.counter_surface.type = CounterSurfaceType::kTopic;
  configuration.counter_surface.facing = CounterSurfaceFacing::kDown;
  LivePredictor predictor(configuration, false);
  const ReceivedScan scan = roughScan(3);
  EXPECT_THROW(predictor.predictScan(scan, OutputOptions()), SurfaceError);
  EXPECT_FALSE(predictor.lastScan());
  predictor.setCounterSurface(roughScan(4));
  PredictedScan predicted = predictor.predictScan(scan, OutputOptions());
  PredictedScan expected = predicted;
  expected.prediction = ScanPredictor(configuration).predict(scan.surface, roughScan(4).surface);
  expectSame(predicted, expected);
}

TEST(LivePredictor, AScanIsCleanedOnceForAllWhoAskForIt) {
  Configuration configuration = softConfiguration();
  configuration.preprocessing.level.shape = LevelShape::kPlane;
  configuration.preprocessing.refine.factor = 2;
  configuration.counter_surface.type = CounterSurfaceType::kTopic;
  configuration.counter_surface.facing = CounterSurfaceFacing::kDown;
  configuration.device.spring_stiffness = configuration.device.travel =
      configuration.device.contact_area = 1e-6;
  LivePredictor predictor(configuration, true);
  predictor.setCounterSurface(roughScan(4));
  std::uint64_t expected = 1;  // the counter-surface
  for (int scan = 0; scan < 3; ++scan) {
    const PredictedScan live =
        predictor.predictScan(roughScan(3), OutputOptions());  // worn from the second on
    EXPECT_EQ(predictor.cleanings(), ++expected);
    EXPECT_EQ(predictor.lastSurface().rows(), 96);  // the preview
    RunningSettings settings = predictor.settings().current();
    settings.interface.work_of_adhesion *= 1.5;
    settings.load.voltage = 1.0;
    predictor.settings().change(settings);
    EXPECT_NE(predictor.predictLastScan()->prediction.pull_off_force,
              live.prediction.pull_off_force);
    const StationCase station_case = predictor.stationCase(nullptr);
    EXPECT_EQ(station_case.scan.model_surfaces.lower.rows(), 2 * 96);
    EXPECT_EQ(station_case.settings->model.load.voltage, 1.0);
    EXPECT_EQ(predictor.cleanings(), expected);
  }
  const ReceivedScan given = roughScan(5);
  predictor.stationCase(&given);
  predictor.predictOnce(given, 0.0, 1e-6);
  EXPECT_EQ(predictor.cleanings(), expected += 2)
      << "of scans that are not kept, once for each call";
  predictor.setCounterSurface(roughScan(6));
  predictor.predictLastScan();
  predictor.stationCase(nullptr);
  EXPECT_EQ(predictor.cleanings(), expected += 1) << "the new counter-surface alone";
  predictor.resetSurface();
  predictor.predictLastScan();
  predictor.stationCase(nullptr);
  EXPECT_EQ(predictor.cleanings(), expected) << "the last scan is there without the wear";
}

TEST(LivePredictor, TheLastScanMeetsTheNewestCounterSurfaceAndForgetsItsWear) {
  Configuration configuration = softConfiguration();
  configuration.preprocessing.level.shape = LevelShape::kPlane;
  configuration.counter_surface.type = CounterSurfaceType::kTopic;
  configuration.counter_surface.facing = CounterSurfaceFacing::kDown;
  LivePredictor predictor(configuration, true);
  predictor.setCounterSurface(roughScan(4));
  predictor.predictScan(roughScan(3), OutputOptions());
  predictor.predictScan(roughScan(3), OutputOptions());
  const double worn = predictor.predictLastScan()->prediction.pull_off_force;
  predictor.setCounterSurface(roughScan(5));
  EXPECT_NE(predictor.predictLastScan()->prediction.pull_off_force, worn);
  predictor.resetSurface();
  EXPECT_EQ(predictor.predictLastScan()->prediction.pull_off_force,
            ScanPredictor(configuration)
                .predict(roughScan(3).surface, roughScan(5).surface)
                .pull_off_force);

  GaussianSurfaceOptions other;
  other.rows = other.cols = 64;
  predictor.setCounterSurface(scanOf(gaussianSurface(other)));
  for (int i = 0; i < 2; ++i)
    EXPECT_THROW(predictor.predictLastScan(), SurfaceError) << "its grid is another";
  EXPECT_EQ(predictor.lastSurface().rows(), 96);
  predictor.setCounterSurface(roughScan(4));
  EXPECT_TRUE(predictor.predictLastScan());
}

/// A 32FC1 scan that shows the pixels of its message, which nobody else holds.
ReceivedScan shownScan(int seed, boost::weak_ptr<const sensor_msgs::Image>& watched) {
  const HeightMap surface = roughScan(seed).surface;
  const sensor_msgs::ImageConstPtr message = heightImage(surface.heights(), std_msgs::Header());
  watched = message;
  ScanOptions options;
  options.pitch_x = surface.pitchX();
  options.pitch_y = surface.pitchY();
  return receiveScan(message, options);
}

TEST(LivePredictor, ALongRunHoldsThePixelsOfItsScanAndCounterSurface) {
  Configuration configuration = softConfiguration();
  configuration.counter_surface.type = CounterSurfaceType::kTopic;
  configuration.counter_surface.facing = CounterSurfaceFacing::kDown;
  LivePredictor predictor(configuration, false);
  boost::weak_ptr<const sensor_msgs::Image> scan_message, counter_message;
  predictor.setCounterSurface(shownScan(4, counter_message));
  {
    std::optional<ReceivedScan> given = shownScan(3, scan_message);
    const cv::Mat expected = given->surface.heights().clone();
    const StationCase station_case = predictor.stationCase(&*given);
    given.reset();
    predictor.setCounterSurface(roughScan(5));
    ASSERT_FALSE(scan_message.expired());
    ASSERT_FALSE(counter_message.expired());
    EXPECT_EQ(station_case.scan.surfaces.lower.heights().data, scan_message.lock()->data.data());
    EXPECT_EQ(cv::norm(station_case.scan.surfaces.lower.heights(), expected, cv::NORM_INF), 0.0);
  }
  EXPECT_TRUE(scan_message.expired());
  EXPECT_TRUE(counter_message.expired());
}

TEST(LivePredictor, EverySettingChangesAtOnceOrNone) {
  LivePredictor predictor(softConfiguration(), false);
  const ReceivedScan scan = roughScan();
  const PredictedScan before = predictor.predictScan(scan, OutputOptions());
  EXPECT_EQ(before.verdict.sticks, Sticks::kUnknown);

  RunningSettings options = predictor.settings().current();
  options.interface.work_of_adhesion *= 2.0;
  options.device.spring_stiffness = 1e-6;  // so weak that it surely sticks
  options.device.travel = 1e-6;
  options.device.contact_area = before.prediction.nominal_area;
  options.device.electrode_gap = 1e-7;  // less than the travel
  EXPECT_THROW(predictor.settings().change(options), OptionsError);
  expectSame(*predictor.predictLastScan(), before);

  options.device.electrode_gap = 0.0;
  predictor.settings().change(options);
  const PredictedScan after = *predictor.predictLastScan();
  EXPECT_GT(after.prediction.pull_off_force, before.prediction.pull_off_force);
  EXPECT_NEAR(after.verdict.margin, 1e-12 / after.prediction.pull_off_force,
              1e-9 * after.verdict.margin);
  EXPECT_EQ(after.verdict.sticks, Sticks::kYes);
  expectSame(predictor.predictOnce(scan, 0.0, 2e-6), after);
}

TEST(LivePredictor, TheVerdictDoesNotDependOnWhoListens) {
  Configuration configuration = softConfiguration();
  configuration.device.spring_stiffness = 1.0;
  configuration.device.travel = 1e-6;
  configuration.device.contact_area = 96 * 128 * 10e-9 * 10e-9;  // of roughScan()
  LivePredictor predictor(configuration, false);
  OutputOptions nothing;
  nothing.deformed_surfaces = nothing.contact_map = nothing.asperities = false;
  const PredictedScan alone = predictor.predictScan(roughScan(), nothing);
  EXPECT_LT(alone.verdict.margin_lower, alone.verdict.margin);
  expectSame(alone, predictor.predictScan(roughScan(), OutputOptions()));
}

TEST(LivePredictor, TheScansPoseIsThatOfTheParameters) {
  Configuration configuration = softConfiguration();
  configuration.counter_surface.type = CounterSurfaceType::kGaussian;
  SurfacePose pose;
  pose.offset_x = 37e-9;
  pose.rotation = 0.3;
  pose.tilt_x = 1e-3;
  LivePredictor by_scan(configuration, false);
  configuration.counter_surface.pose = pose;
  LivePredictor by_parameter(configuration, false);
  ReceivedScan scan = roughScan();
  const PredictedScan expected = by_parameter.predictScan(scan, OutputOptions());
  const double mated = by_scan.predictScan(scan, OutputOptions()).prediction.pull_off_force;
  EXPECT_NE(mated, expected.prediction.pull_off_force);
  scan.counter_surface_pose = pose;
  expectSame(by_scan.predictScan(scan, OutputOptions()), expected);
  expectSame(*by_scan.predictLastScan(), expected);
  expectSame(by_scan.predictOnce(scan, 0.0, 2e-6), expected);
  const HeightMap upper = by_scan.stationCase(nullptr).scan.surfaces.upper;
  const HeightMap expected_upper = by_parameter.stationCase(nullptr).scan.surfaces.upper;
  EXPECT_EQ(cv::norm(upper.heights(), expected_upper.heights(), cv::NORM_INF), 0.0);
}

TEST(PredictionConversion, CarriesEveryContact) {
  LivePredictor predictor(softConfiguration(), false);
  const Prediction prediction = predictor.predictScan(roughScan(), OutputOptions()).prediction;
  std_msgs::Header header;
  header.frame_id = "stage";
  const AsperityArray message = asperitiesMessage(prediction, header);
  ASSERT_EQ(message.asperities.size(), static_cast<std::size_t>(prediction.asperity_count));
  EXPECT_EQ(message.header.frame_id, "stage");
  EXPECT_EQ(message.asperities[0].composite_radius, prediction.asperities[0].composite_radius);
  EXPECT_EQ(message.asperities[0].regime, static_cast<int>(prediction.asperities[0].regime));
}

TEST(DisplayConversion, KeepsToItsLimitsAndLeavesInvalidCellsOut) {
  Configuration configuration = softConfiguration();
  configuration.model.load.mechanical_load = 1e-4;  // more contacts than discs
  LivePredictor predictor(configuration, false);
  ReceivedScan scan = roughScan();
  cv::Mat heights = scan.surface.heights().clone();
  heights.rowRange(0, 10).setTo(std::nan(""));
  scan.surface = HeightMap(heights, scan.surface.pitchX(), scan.surface.pitchY());
  const Prediction prediction = predictor.predictScan(scan, OutputOptions()).prediction;
  DisplayOptions display;
  EXPECT_EQ(surfacePoints(prediction, scan.surface, {}, display).width, 86U * 128U);
  display.max_points = 500;
  const auto cloud = surfacePoints(prediction, scan.surface, {}, display);
  EXPECT_LE(cloud.width, 500U);
  EXPECT_GT(cloud.width, 250U);
  display.max_markers = 2;
  // What removes the markers before, the line of text, two discs.
  ASSERT_GT(prediction.asperity_count, 2);
  EXPECT_EQ(asperityMarkers(prediction, scan.surface, {}, display).markers.size(), 4U);
}

TEST(DisplayConversion, FillsTheViewWhateverTheSizeOfTheScan) {
  const ReceivedScan scan = roughScan();  // 96 x 128 pixels
  const cv::Mat& heights = scan.surface.heights();
  std_msgs::Header header;
  header.frame_id = "stage";
  for (const double pitch : {1e-9, 1e-6}) {
    const HeightMap surface(heights, pitch, pitch);
    const Prediction prediction = LivePredictor(softConfiguration(), false)
                                      .predictScan(scanOf(surface), OutputOptions())
                                      .prediction;
    DisplayOptions display;
    const auto cloud = surfacePoints(prediction, surface, header, display);
    EXPECT_EQ(cloud.header.frame_id, "stiction_view");
    sensor_msgs::PointCloud2ConstIterator<float> first(cloud, "x");
    // The first pixel is the upper left one: 127 and 95 pitches across, about the origin, the
    // longer side 128 of 10 m.
    EXPECT_NEAR(first[0], -0.5 * 127 / 128 * kViewSize, 1e-5);
    EXPECT_NEAR(first[1], 0.5 * 95 / 128 * kViewSize, 1e-5);
    const auto markers = asperityMarkers(prediction, surface, header, display);
    EXPECT_NE(markers.markers[1].text.find(pitch < 1e-8 ? "128 nm x 96 nm" : "128 um x 96 um"),
              std::string::npos)
        << markers.markers[1].text;

    display.frame = "";
    display.scale = 1e6;
    display.height_exaggeration = 4.0;
    const auto stated = surfacePoints(prediction, surface, header, display);
    EXPECT_EQ(stated.header.frame_id, "stage");
    sensor_msgs::PointCloud2ConstIterator<float> corner(stated, "x");
    EXPECT_NEAR(corner[0] / (-63.5 * pitch * 1e6), 1.0, 1e-6);
    EXPECT_NEAR(corner[2] / (corner[3] * 4e6), 1.0, 1e-6);  // z against the height about the mean
    EXPECT_NE(
        asperityMarkers(prediction, surface, header, display).markers[1].text.find("heights x 4,"),
        std::string::npos);
  }
}

/// So stiff that it comes off from everything.
Configuration deviceConfiguration() {
  Configuration configuration = softConfiguration();
  configuration.device.spring_stiffness = 1000.0;
  configuration.device.travel = 1e-6;
  configuration.device.contact_area = 96 * 128 * 10e-9 * 10e-9;  // of roughScan()
  return configuration;
}

/// Of summits that hold on many pixels.
ReceivedScan scanOfPart(int seed, const std::string& part_id) {
  GaussianSurfaceOptions options;
  options.rows = 96;
  options.cols = 128;
  options.rms_height = 3e-9;
  options.correlation_length_x = options.correlation_length_y = 100e-9;
  options.seed = seed;
  ReceivedScan scan = scanOf(gaussianSurface(options));
  scan.header.stamp = ros::Time(seed, 0);
  scan.identity = {"place " + std::to_string(seed), part_id};
  return scan;
}

TEST(LivePredictor, AScanThatNamesItsPartCountsForIt) {
  LivePredictor predictor(deviceConfiguration(), false);
  EXPECT_FALSE(predictor.predictScan(roughScan(), OutputOptions()).part);
  std::vector<ScanStatement> statements;
  PredictedScan last;
  for (const int seed : {3, 4, 5}) {
    last = predictor.predictScan(scanOfPart(seed, "lot 3"), OutputOptions());
    statements.push_back(statementOf(last.provenance.scan_name, last.prediction, last.verdict));
    predictor.predictScan(scanOfPart(seed, "another"), OutputOptions());  // they take turns
  }
  const PooledVerdict expected = pooledVerdictOf(statements);
  ASSERT_TRUE(last.part);
  EXPECT_EQ(last.part->scan_count, 3);
  EXPECT_EQ(last.part->sticks, Sticks::kNo) << last.part->reason;
  EXPECT_EQ(last.part->margin.value, expected.margin.value);
  EXPECT_EQ(last.part->margin.lower, expected.margin.lower);
  EXPECT_EQ(last.part->reason, expected.reason);
  EXPECT_EQ(last.pool_settings_hash, last.provenance.settings_hash);
  EXPECT_LT(last.part->margin.worst, last.part->margin.value);
}

TEST(LivePredictor, AnotherLookAtTheSameScanCountsOnce) {
  LivePredictor predictor(deviceConfiguration(), false);
  predictor.predictScan(scanOfPart(3, "lot 3"), OutputOptions());
  EXPECT_FALSE(predictor.predictLastScan()->part);
  EXPECT_FALSE(predictor.predictOnce(scanOfPart(4, "lot 3"), 0.0, 2e-6).part);
  EXPECT_EQ(predictor.predictScan(scanOfPart(3, "lot 3"), OutputOptions()).part->scan_count,
            1);  // played again
  EXPECT_EQ(predictor.predictScan(scanOfPart(5, "lot 3"), OutputOptions()).part->scan_count, 2);
}

TEST(LivePredictor, AScanThatIsJudgedAgainCountsSoForItsPart) {
  LivePredictor predictor(deviceConfiguration(), false);
  const auto predicted = [&](int seed, const std::string& part) {
    const ReceivedScan scan = scanOfPart(seed, part);
    const PredictedScan result = predictor.predictScan(scan, OutputOptions());
    return std::pair(
        ScanOfPart{scan.header, result.provenance, result.pool_settings_hash, result.scan_id},
        result.verdict);
  };
  auto [first, verdict] = predicted(3, "lot 3");
  const ScanOfPart second = predicted(4, "lot 3").first;
  verdict.judge = Judge::kHalfSpace;
  const std::optional<PartNews> news = predictor.judgeAgain(first, verdict);
  ASSERT_TRUE(news);
  EXPECT_EQ(news->verdict.scan_count, 2);
  EXPECT_EQ(news->verdict.verdict_by, "prediction and half_space");
  EXPECT_EQ(news->last.provenance.scan_name,
            "place 4");  // the scan that came last, not the one that was judged
  EXPECT_EQ(news->last.header.stamp, second.header.stamp);

  predicted(5, "another");
  EXPECT_EQ(predictor.judgeAgain(second, verdict)->verdict.verdict_by, "half_space");
  EXPECT_EQ(predictor.judgeAgain(first, verdict)->last.header.stamp, second.header.stamp);
  EXPECT_EQ(predictor.newestOf(first).id, second.id);
  EXPECT_EQ(predictor.newestOf(second).id, second.id);
  const ScanOfPart lone = predicted(6, "").first;
  EXPECT_FALSE(predictor.judgeAgain(lone, verdict));
  predicted(7, "");
  EXPECT_EQ(predictor.newestOf(lone).id, lone.id);
}

TEST(LivePredictor, ScansWithoutAStampAreJudgedAgainEachByItself) {
  LivePredictor predictor(deviceConfiguration(), false);
  std::vector<ScanOfPart> scans;
  Verdict verdict;
  for (const int seed : {3, 4}) {
    ReceivedScan scan = scanOfPart(seed, "lot 3");
    scan.header.stamp = ros::Time();
    const PredictedScan predicted = predictor.predictScan(scan, OutputOptions());
    EXPECT_EQ(predicted.part->scan_count, seed - 2);
    EXPECT_EQ(predictor.predictLastScan()->scan_id, predicted.scan_id);
    scans.push_back(
        {scan.header, predicted.provenance, predicted.pool_settings_hash, predicted.scan_id});
    verdict = predicted.verdict;
  }
  verdict.judge = Judge::kHalfSpace;
  EXPECT_EQ(predictor.judgeAgain(scans[0], verdict)->verdict.verdict_by,
            "prediction and half_space");
  EXPECT_EQ(predictor.judgeAgain(scans[1], verdict)->verdict.verdict_by, "half_space");
}

TEST(LivePredictor, FiguresOfTheLastScanAreThoseOfItsNewestPrediction) {
  Configuration configuration = softConfiguration();
  configuration.model.load.mechanical_load = 1e-4;  // flows
  LivePredictor predictor(configuration, true);
  EXPECT_FALSE(predictor.lastFigures());
  const auto expectFigures = [&](const PredictedScan& expected) {
    const std::optional<LoadFigures> figures = predictor.lastFigures();
    ASSERT_TRUE(figures);
    EXPECT_EQ(figures->pull_off_force, expected.prediction.pull_off_force);
    EXPECT_EQ(figures->contact_area, expected.prediction.contact_area);
    EXPECT_EQ(figures->electrostatic_force, expected.prediction.electrostatic_force);
  };
  expectFigures(predictor.predictScan(roughScan(), OutputOptions()));
  expectFigures(predictor.predictScan(roughScan(), OutputOptions()));
  const double worn = predictor.lastFigures()->contact_area;
  setLoad(predictor, 1e-3, 5e-5);
  const LoadFigures changed = *predictor.lastFigures();
  EXPECT_NE(changed.contact_area, worn);
  expectFigures(*predictor.predictLastScan());
  predictor.resetSurface();
  EXPECT_NE(predictor.lastFigures()->contact_area, changed.contact_area);
}

TEST(LivePredictor, ScansUnderAnotherLoadAreAPoolOfTheirOwn) {
  LivePredictor predictor(deviceConfiguration(), false);
  const ReceivedScan scan = scanOfPart(3, "lot 3");
  const PredictedScan predicted = predictor.predictScan(scan, OutputOptions());
  const ScanOfPart first{scan.header, predicted.provenance, predicted.pool_settings_hash,
                         predicted.scan_id};
  setLoad(predictor, 0.0, 4e-6);
  const PredictedScan other = predictor.predictScan(scanOfPart(4, "lot 3"), OutputOptions());
  EXPECT_EQ(other.part->scan_count, 1);
  // it overtakes the scan of the other pool all the same, but is not its last
  const std::optional<PartNews> news = predictor.judgeAgain(first, Verdict());
  ASSERT_TRUE(news);
  EXPECT_EQ(news->last.id, first.id);
  EXPECT_EQ(predictor.newestOf(first).id, other.scan_id);
  setLoad(predictor, 0.0, 2e-6);
  EXPECT_EQ(predictor.predictScan(scanOfPart(5, "lot 3"), OutputOptions()).part->scan_count, 2);
}

TEST(LivePredictor, APoseThatComesWithEachScanLeavesThemOneCase) {
  LivePredictor predictor(deviceConfiguration(), false);
  for (const int seed : {3, 4}) {
    ReceivedScan scan = scanOfPart(seed, "lot 3");
    scan.counter_surface_pose = SurfacePose();
    scan.counter_surface_pose->offset_x = 1e-9 * seed;
    const PredictedScan predicted = predictor.predictScan(scan, OutputOptions());
    EXPECT_EQ(predicted.part->scan_count, seed - 2);
    EXPECT_NE(predicted.pool_settings_hash, predicted.provenance.settings_hash);
  }
}

}  // namespace
}  // namespace mems_stiction
