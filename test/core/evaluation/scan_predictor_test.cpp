#include "mems_stiction/evaluation/scan_predictor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "height_map/validity.hpp"
#include "import/scan_writer.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "preprocess/tip_correction.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/paper_options.hpp"
#include "support/scratch_folder.hpp"
#include "surface/counter_surface.hpp"
#include "surface/gaussian_surface.hpp"
#include "surface/self_affine_surface.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 5e-9;

/// All contacts elastic: how far plastic ones grow hangs on the last pixel of them.
Configuration pressed(double load = 1e-6) {
  Configuration configuration = paperConfiguration();
  configuration.model.deformation = Deformation::kElastic;
  configuration.model.load.mechanical_load = load;
  return configuration;
}

HeightMap rough(int seed = 5, int rows = 96, int cols = 128) {
  GaussianSurfaceOptions options;
  options.rows = rows;
  options.cols = cols;
  options.pitch_x = options.pitch_y = kPitch;
  options.rms_height = 2e-9;
  options.correlation_length_x = options.correlation_length_y = 40e-9;
  options.seed = seed;
  return gaussianSurface(options);
}

// ------------------------------------------------------------------ cleaning

TEST(ScanPreparer, RecordsEveryStep) {
  Configuration configuration = pressed();
  configuration.preprocessing.offset.enabled = true;
  configuration.preprocessing.level.shape = LevelShape::kPolynomial;
  configuration.preprocessing.refine.factor = 2;
  const PreparedScan prepared = ScanPreparer(configuration).prepare(rough());
  ASSERT_EQ(prepared.record.steps.size(), 3u);
  EXPECT_EQ(prepared.record.steps[0].name, "offset");
  EXPECT_EQ(prepared.record.steps[1].name, "level");
  EXPECT_EQ(prepared.record.steps[2].name, "refine");
  EXPECT_TRUE(ScanPreparer(pressed()).prepare(rough()).record.steps.empty());
}

TEST(ScanPredictor, SaysTheSameOfAScanThatItHasSeen) {
  Configuration configuration = pressed();
  configuration.preprocessing.refine.factor = 2;
  Configuration other = configuration;
  other.model.formulation = "separation_curve";
  other.model.load = LoadOptions();
  other.model.load.pressure = 5e6;
  for (const Configuration& second : {configuration, other}) {
    ScanPredictor predictor(configuration);
    const PreparedScan prepared = predictor.preparer().prepare(rough());
    predictor.predict(prepared);
    predictor.setOptions(second.model);
    const Prediction again = predictor.predictAgain(prepared);
    const Prediction fresh = ScanPredictor(second).predict(rough());
    EXPECT_EQ(again.pull_off_force, fresh.pull_off_force);
    EXPECT_EQ(again.mean_gap, fresh.mean_gap);
    EXPECT_EQ(again.rms_height, fresh.rms_height);
    EXPECT_EQ(again.composite_rms_height, fresh.composite_rms_height);
    EXPECT_EQ(again.roughness.sq, fresh.roughness.sq);
    EXPECT_EQ(cv::countNonZero(again.contact_map != fresh.contact_map), 0);
    EXPECT_EQ(cv::countNonZero(again.deformed_lower != fresh.deformed_lower), 0);
  }
}

TEST(ScanPredictor, MapsOfARefinedScanHaveItsOwnSizeAndFrame) {
  // A sphere whose apex lies on a pixel, away from the middle: where it is found must not depend on
  // the refinement.
  const HeightMap scan =
      analytic::paraboloid(61, 81, kPitch, kPitch, 1e-6, 10 * kPitch, -7 * kPitch);
  Configuration configuration = pressed(2e-7);
  configuration.model.deformation = Deformation::kThreeRegimes;  // so that something goes down
  const Prediction plain = ScanPredictor(configuration).predict(scan);
  for (const int factor : {2, 3}) {
    configuration.preprocessing.refine.factor = factor;
    ScanPredictor refining(configuration);
    const Prediction refined = refining.predict(scan);
    ASSERT_EQ(refined.status, Status::kEquilibrium);
    EXPECT_EQ(refined.deformed_lower.size(), scan.heights().size());
    EXPECT_EQ(refined.deformed_upper.size(), scan.heights().size());
    EXPECT_EQ(refined.contact_map.size(), scan.heights().size());
    EXPECT_NEAR(refined.nominal_area / plain.nominal_area, 1.0, 1e-12);
    EXPECT_NEAR(refined.pull_off_force / plain.pull_off_force, 1.0,
                0.15);  // chi follows the radius, the contact chi
    ASSERT_EQ(refined.asperities.size(), 1u);
    EXPECT_NEAR(refined.asperities[0].x, plain.asperities[0].x, 0.51 * kPitch);
    EXPECT_NEAR(refined.asperities[0].y, plain.asperities[0].y, 0.51 * kPitch);
    EXPECT_NEAR(refined.median_contact_pixels * kPitch * kPitch, refined.contact_area,
                1e-12 * refined.contact_area);
    // Untouched pixels keep their heights to the bit; what went down lies where the contact is.
    const cv::Mat untouched = refined.contact_map == 0;
    cv::Mat change = refining.preparer().prepare(scan).surfaces.lower.asDouble().heights() -
                     refined.deformed_lower;
    EXPECT_GT(change.at<double>(23, 50), 0.0);
    change.setTo(0.0, refined.contact_map != 0);
    EXPECT_EQ(cv::countNonZero(change), 0);
    EXPECT_GT(cv::countNonZero(untouched), 0);
  }
}

TEST(ScanPredictor, RefinementLeavesTheTiltedCounterSurfaceWhereItIs) {
  const HeightMap scan = rough();
  Configuration configuration = pressed();
  configuration.counter_surface.pose.tilt_x = 0.01;
  const Prediction plain = ScanPredictor(configuration).predict(scan);
  configuration.preprocessing.refine.factor = 2;
  const Prediction refined = ScanPredictor(configuration).predict(scan);
  EXPECT_NEAR(refined.composite_rms_height / plain.composite_rms_height, 1.0, 0.02);
  cv::Mat untouched = refined.deformed_upper - plain.deformed_upper;
  untouched.setTo(0.0, (refined.contact_map | plain.contact_map) != 0);
  EXPECT_LT(cv::norm(untouched, cv::NORM_INF), 1e-20);
}

TEST(ScanPredictor, TooManyMissingPixelsAreRefusedInWords) {
  Configuration configuration = pressed();
  configuration.preprocessing.fill.enabled = true;
  configuration.preprocessing.fill.max_fraction = 1e-5;
  ScanPredictor predictor(configuration);
  try {
    predictor.predict(analytic::withInvalidPixel(rough(), 3, 4));
    FAIL() << "was accepted";
  } catch (const SurfaceError& error) {
    EXPECT_NE(std::string(error.what()).find("max_fraction"), std::string::npos) << error.what();
  }
}

// ------------------------------------------------------------------ counter-surfaces

TEST(CounterSurface, ATiltedPlaneIsATiltedScanTheOtherWayRound) {
  const HeightMap scan = rough();
  Configuration configuration = pressed();
  configuration.counter_surface.pose.tilt_x = std::atan(0.02);
  configuration.counter_surface.pose.tilt_y = std::atan(-0.01);
  const Prediction tilted_plane = ScanPredictor(configuration).predict(scan);
  const HeightMap slope =
      analytic::tiltedPlane(scan.rows(), scan.cols(), kPitch, kPitch, -0.02, 0.01);
  const Prediction tilted_scan = ScanPredictor(pressed()).predict(analytic::sum(scan, slope));
  EXPECT_NEAR(tilted_plane.contact_area, tilted_scan.contact_area, 1e-9 * tilted_scan.contact_area);
  EXPECT_NE(tilted_plane.contact_area, ScanPredictor(pressed()).predict(scan).contact_area);
}

TEST(CounterSurface, APoseGivenLaterIsThatOfTheConfiguration) {
  const HeightMap scan = rough();
  for (const CounterSurfaceType type : {CounterSurfaceType::kFlat, CounterSurfaceType::kGaussian,
                                        CounterSurfaceType::kSelfAffine}) {
    Configuration configuration = pressed();
    configuration.counter_surface.type = type;
    configuration.counter_surface.self_affine.rolloff_wavelength = 300e-9;
    SurfacePose pose;
    pose.tilt_x = 0.005;
    pose.rotation = 0.3;
    pose.offset_y = 33e-9;
    ScanPredictor moved(configuration);
    const Prediction before = moved.predict(scan);
    moved.preparer().setCounterSurfacePose(pose);
    const Prediction after = moved.predict(scan);
    configuration.counter_surface.pose = pose;
    EXPECT_EQ(after.pull_off_force, ScanPredictor(configuration).predict(scan).pull_off_force);
    EXPECT_NE(after.deformed_upper.at<double>(0, 0), before.deformed_upper.at<double>(0, 0));

    pose.tilt_x = 2.0;
    EXPECT_THROW(moved.preparer().setCounterSurfacePose(pose), OptionsError);
    EXPECT_EQ(moved.preparer().counterSurfacePose().tilt_x, 0.005);
    EXPECT_EQ(moved.predict(scan).pull_off_force, after.pull_off_force);
  }
}

TEST(CounterSurface, GeneratedOnesAreThoseOfTheSeedOnEveryGrid) {
  Configuration configuration = pressed();
  configuration.model.output.deformed_surfaces = true;
  configuration.counter_surface.type = CounterSurfaceType::kGaussian;
  configuration.counter_surface.gaussian.gaussian.rms_height = 5e-9;
  configuration.counter_surface.gaussian.gaussian.correlation_length_x = 30e-9;
  configuration.counter_surface.gaussian.gaussian.correlation_length_y = 60e-9;
  ScanPredictor predictor(configuration);
  const HeightMap scan = rough();
  const double first = predictor.predict(scan).pull_off_force;
  predictor.predict(rough(7, 64, 200));  // another grid between
  EXPECT_EQ(predictor.predict(scan).pull_off_force, first);
  EXPECT_EQ(ScanPredictor(configuration).predict(scan).pull_off_force, first);
  const double sq_upper = std::sqrt(std::pow(predictor.predict(scan).composite_rms_height, 2) -
                                    std::pow(predictor.predict(scan).rms_height, 2));
  EXPECT_NEAR(sq_upper, 5e-9, 1e-14);
  configuration.counter_surface.seed = 2;
  EXPECT_NE(ScanPredictor(configuration).predict(scan).pull_off_force, first);
}

TEST(CounterSurface, GeneratedSummitsPointTowardsTheScan) {
  CounterSurfaceOptions options;
  options.type = CounterSurfaceType::kGaussian;
  options.gaussian.skewness = 1.0;
  options.gaussian.kurtosis = 5.0;
  options.gaussian.gaussian.correlation_length_x = options.gaussian.gaussian.correlation_length_y =
      10e-9;
  const HeightMap mounted = generatedCounterSurface(rough(1, 256, 256), options);
  const HeightStatistics heights = heightStatistics(mounted);
  EXPECT_GT(-heights.min, 1.3 * heights.max) << "high summits reach down";
}

TEST(CounterSurface, SettingsThatTheGridCannotHoldAreRefusedInOneLine) {
  Configuration configuration = pressed();
  configuration.counter_surface.type = CounterSurfaceType::kSelfAffine;
  configuration.counter_surface.self_affine.rolloff_wavelength = 1e-3;
  ScanPredictor predictor(configuration);
  try {
    predictor.predict(rough());
    FAIL() << "was accepted";
  } catch (const SurfaceError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("counter_surface/self_affine/rolloff_wavelength"), std::string::npos)
        << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

TEST(CounterSurface, AFileIsTheMeasuredSurfaceOfATopic) {
  const ScratchFolder folder;
  const HeightMap measured = rough(9);
  writeScan(folder.file("counter.tiff"), measured, "a counter-surface");
  for (const CounterSurfaceFacing facing :
       {CounterSurfaceFacing::kDown, CounterSurfaceFacing::kUp}) {
    Configuration configuration = pressed();
    configuration.preprocessing.level.shape = LevelShape::kPlane;
    configuration.counter_surface.facing = facing;
    configuration.counter_surface.type = CounterSurfaceType::kTopic;
    const Prediction topic = ScanPredictor(configuration).predict(rough(), measured);
    configuration.counter_surface.type = CounterSurfaceType::kFile;
    configuration.counter_surface.file = folder.file("counter.tiff");
    ScanPredictor predictor(configuration);
    const Prediction file = predictor.predict(rough());
    EXPECT_EQ(file.pull_off_force, topic.pull_off_force);
    EXPECT_EQ(file.composite_rms_height, topic.composite_rms_height);
    // Another size is resampled, where it lies over the scan.
    const Prediction wider = predictor.predict(rough(3, 96, 160));
    EXPECT_NEAR(wider.invalid_fraction, 0.2, 1e-12);
  }
}

TEST(CounterSurface, AFileThatCannotBeUsedIsRefusedAtTheStart) {
  const ScratchFolder folder;
  Configuration configuration = paperConfiguration();
  configuration.counter_surface.type = CounterSurfaceType::kFile;
  configuration.counter_surface.facing = CounterSurfaceFacing::kUp;
  configuration.counter_surface.file = folder.file("none.tiff");
  try {
    ScanPredictor predictor(configuration);
    FAIL() << "was accepted";
  } catch (const OptionsError& error) {
    ASSERT_EQ(error.violations().size(), 1u);
    EXPECT_NE(error.violations()[0].find("none.tiff: there is no such file"), std::string::npos)
        << error.what();
  }
}

TEST(CounterSurface, TheTipComesOffTheSideThatItTouched) {
  // A sphere as a blunt tip draws it, mounted upside down: corrected, it is the sharp one again,
  // from either statement.
  TipOptions tip;
  tip.radius = 200e-9;
  const HeightMap sharp = analytic::paraboloid(81, 81, kPitch, kPitch, 300e-9);
  const HeightMap drawn = tipImaged(sharp, tip);
  const HeightMap scan = analytic::flat(81, 81, kPitch, kPitch);
  Configuration configuration = pressed(1e-7);
  configuration.model.interface.hamaker_constant = 0.0;
  configuration.counter_surface.type = CounterSurfaceType::kTopic;
  configuration.counter_surface.facing = CounterSurfaceFacing::kUp;
  configuration.preprocessing.tip = tip;
  const double up = ScanPredictor(configuration).predict(scan, drawn).pull_off_force;
  configuration.counter_surface.facing = CounterSurfaceFacing::kDown;
  const double down = ScanPredictor(configuration).predict(scan, turnedOver(drawn)).pull_off_force;
  configuration.preprocessing.tip = TipOptions();
  const double expected =
      ScanPredictor(configuration).predict(scan, turnedOver(sharp)).pull_off_force;
  EXPECT_EQ(up, down);
  EXPECT_NEAR(up / expected, 1.0, 0.05);
  EXPECT_GT(ScanPredictor(configuration).predict(scan, turnedOver(drawn)).pull_off_force,
            1.3 * expected);
}

// ------------------------------------------------------------------ resolution

TEST(Resolution, FewPixelsAndBluntTipsSetTheirFlags) {
  const HeightMap coarse = analytic::paraboloid(41, 41, 40e-9, 40e-9, 1e-6, 7e-9, 3e-9);
  const HeightMap fine = analytic::paraboloid(301, 301, 2e-9, 2e-9, 1e-6, 0.7e-9, 0.3e-9);
  Configuration configuration = pressed(1e-6);
  const Prediction of_coarse = ScanPredictor(configuration).predict(coarse);
  const Prediction of_fine = ScanPredictor(configuration).predict(fine);
  EXPECT_TRUE(of_coarse.is_resolution_limited) << of_coarse.median_contact_pixels;
  EXPECT_FALSE(of_fine.is_resolution_limited) << of_fine.median_contact_pixels;
  EXPECT_EQ(of_fine.median_contact_pixels * fine.cellArea(), of_fine.contact_area);
  EXPECT_NEAR(of_fine.median_composite_radius, 1e-6, 0.03e-6);
  EXPECT_FALSE(of_fine.is_tip_limited);
  configuration.resolution.tip_radius = 1.5e-6;
  EXPECT_TRUE(ScanPredictor(configuration).predict(fine).is_tip_limited);
  configuration.resolution.tip_radius = 0.5e-6;
  EXPECT_FALSE(ScanPredictor(configuration).predict(fine).is_tip_limited);
  configuration.resolution.min_contact_pixels = 0.0;
  EXPECT_FALSE(ScanPredictor(configuration).predict(coarse).is_resolution_limited);
}

TEST(Resolution, AStatedTipCountsTheContactsThatItHasDrawn) {
  const HeightMap scan = analytic::paraboloid(301, 301, 2e-9, 2e-9, 1e-6, 0.7e-9, 0.3e-9);
  Configuration configuration = pressed(1e-6);
  Prediction prediction = ScanPredictor(configuration).predict(scan);
  EXPECT_TRUE(std::isnan(prediction.tip_limit));
  EXPECT_EQ(prediction.below_tip_count, -1);
  configuration.resolution.tip_radius = 0.4e-6;  // half of its curvature is more than the summit's
  prediction = ScanPredictor(configuration).predict(scan);
  EXPECT_EQ(prediction.tip_limit, 0.0);
  EXPECT_EQ(prediction.below_tip_count, 0);
  configuration.resolution.tip_radius = 0.0;
  configuration.preprocessing.tip.radius =
      0.8e-6;  // sharper than any tip of 0.8 um: its own shape all over
  prediction = ScanPredictor(configuration)
                   .predict(analytic::paraboloid(301, 301, 2e-9, 2e-9, 1e-6, 0.7e-9, 0.3e-9));
  EXPECT_GT(prediction.tip_limit, 0.0);
  EXPECT_EQ(prediction.below_tip_count, prediction.pull_off_contact_count);
}

TEST(Resolution, TheDefaultLimitIsWhereASpheresRadiusIsWithinFivePercent) {
  // What config/stiction.yaml says about 12 pixels.
  Configuration configuration = paperConfiguration();
  configuration.model.interface.hamaker_constant = 0.0;
  configuration.model.deformation = Deformation::kElastic;
  ScanPredictor predictor(configuration);
  int count = 0;
  int far = 0;
  for (int i = 0; i < 300; ++i) {
    const double pitch = 1e-9 * std::pow(10.0, 1.6 * std::fmod(0.618034 * i, 1.0));
    const double x = pitch * (std::fmod(0.754878 * i, 1.0) - 0.5);
    const double y = pitch * (std::fmod(0.569840 * i, 1.0) - 0.5);
    const Prediction prediction =
        predictor.predict(analytic::paraboloid(61, 61, pitch, pitch, 1e-6, x, y));
    if (prediction.status != Status::kEquilibrium || prediction.is_resolution_limited) continue;
    ++count;
    if (std::fabs(prediction.median_composite_radius / 1e-6 - 1.0) > 0.05) ++far;
  }
  EXPECT_GT(count, 100);
  EXPECT_LT(far, 0.05 * count);
}

TEST(Decimated, TakesMeansOfBlocksAndLeavesOutTheRest) {
  cv::Mat heights = (cv::Mat_<double>(3, 5) << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  heights.at<double>(0, 2) = std::numeric_limits<double>::quiet_NaN();
  const HeightMap half = decimated(HeightMap(heights, 1.0, 2.0), 2);
  ASSERT_EQ(half.rows(), 1);
  ASSERT_EQ(half.cols(), 2);
  EXPECT_EQ(half.height(0, 0), 4.0);
  EXPECT_EQ(half.height(0, 1), 7.0);  // of three
  EXPECT_EQ(half.pitchX(), 2.0);
  EXPECT_EQ(half.pitchY(), 4.0);
  EXPECT_THROW(decimated(half, 2), SurfaceError);
}

TEST(Convergence, FullResolutionIsThePredictionAndAResolvedSphereHardlyMoves) {
  const HeightMap sphere = analytic::paraboloid(240, 240, 2e-9, 2e-9, 1e-6, 0.7e-9, 0.3e-9);
  ScanPredictor predictor(pressed(1e-6));
  const std::vector<ConvergenceRow> rows =
      predictor.convergence(predictor.preparer().prepare(sphere));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].pull_off_force, predictor.predict(sphere).pull_off_force);
  EXPECT_EQ(rows[0].pull_off_force_ratio, 1.0);
  EXPECT_EQ(rows[1].rows, 120);
  EXPECT_EQ(rows[2].pitch_x, 8e-9);
  for (const ConvergenceRow& row : rows) {
    EXPECT_NEAR(row.pull_off_force_ratio, 1.0, 0.025 * row.decimation);
    EXPECT_NEAR(row.contact_area_ratio, 1.0, 0.1);
  }
  const std::string table = convergenceTable(rows, "# ");
  for (const char* part :
       {"# full ", "# half ", "# quarter ", "240 x 240", "From half to full resolution"}) {
    EXPECT_NE(table.find(part), std::string::npos) << table;
  }
}

TEST(Convergence, AllResolutionsSeeTheSameAreaAndTheSameCounterSurface) {
  Configuration configuration = pressed();
  configuration.counter_surface.type = CounterSurfaceType::kGaussian;
  ScanPredictor predictor(configuration);
  const std::vector<ConvergenceRow> rows =
      predictor.convergence(predictor.preparer().prepare(rough(4, 131, 130)));
  for (const ConvergenceRow& row : rows) {
    EXPECT_EQ(row.rows * row.decimation, 128);
    EXPECT_EQ(row.cols * row.decimation, 128);
    EXPECT_EQ(row.status, Status::kEquilibrium);
  }
  ScanPredictor on_a_plane(pressed());
  const PreparedScan small =
      on_a_plane.preparer().prepare(analytic::paraboloid(15, 64, kPitch, kPitch, 1e-6));
  EXPECT_THROW(on_a_plane.convergence(small), SurfaceError);
}

// ------------------------------------------------------------------ roughness

TEST(ScanPredictor, TheTimeOfAPredictionContainsThatOfItsPreparation) {
  Configuration configuration = pressed();
  configuration.limits.max_time = 0.0;
  ScanPredictor predictor(configuration);
  PreparedScan prepared = predictor.preparer().prepare(rough());
  EXPECT_GT(prepared.preparation_time, 0.0);
  prepared.preparation_time = 1000.0;  // longer than any prediction of a small frame
  EXPECT_GT(predictor.predict(prepared).processing_time, 1000.0);
  prepared.preparation_time = 0.0;
  EXPECT_LT(predictor.predict(prepared).processing_time, 1000.0);
}

TEST(SpatialRoughness, IsThatOfTheCleanedScanWhenAskedFor) {
  const HeightMap scan = rough(5, 256, 256);
  Configuration configuration = pressed();
  EXPECT_TRUE(std::isnan(ScanPredictor(configuration).predict(scan).spatial_roughness.sal));
  configuration.spatial_roughness.enabled = true;
  const SpatialRoughness roughness = ScanPredictor(configuration).predict(scan).spatial_roughness;
  // sigma^2 exp(-r^2/l^2) falls to 0.2 at l sqrt(ln 5); m2 = 2 sigma^2/l^2, alpha = 3, within a
  // sample's scatter
  EXPECT_NEAR(roughness.sal / (40e-9 * std::sqrt(std::log(5.0))), 1.0, 0.15);
  EXPECT_GT(roughness.str, 0.7);
  EXPECT_NEAR(roughness.m0 / 4e-18, 1.0, 0.15);
  EXPECT_NEAR(roughness.m2 / (2.0 * 4e-18 / 1.6e-15), 1.0, 0.15);
  EXPECT_NEAR(roughness.nayak, 3.0, 0.5);
  EXPECT_GT(roughness.summit_density, 0.0);
  EXPECT_GT(roughness.mean_summit_radius, 0.0);
}

TEST(SpatialRoughness, HurstIsThatOfASelfAffineSurface) {
  SelfAffineSurfaceOptions surface;
  surface.hurst_exponent = 0.7;
  surface.rolloff_wavelength = 5e-6;
  surface.cutoff_wavelength = 20e-9;
  SpatialRoughnessOptions options;
  EXPECT_NEAR(spatialRoughness(selfAffineSurface(surface), options).hurst, 0.7, 0.1);
  const SpatialRoughness tiny =
      spatialRoughness(analytic::paraboloid(5, 5, 1e-9, 1e-9, 1e-6), options);
  EXPECT_TRUE(std::isnan(tiny.hurst));
}

// ------------------------------------------------------------------ round-off

TEST(ScanPredictor, RoundOffDoesNotDecideWhichPixelsOfARingTouch) {
  for (const double pitch : {2e-9, 5e-9, 10e-9, 20e-9}) {
    const HeightMap sphere = analytic::paraboloid(301, 301, pitch, pitch, 2e-6);
    cv::Mat noise(sphere.heights().size(), CV_64FC1);
    cv::RNG(3).fill(noise, cv::RNG::NORMAL, 0.0, 1e-18);
    ScanPredictor predictor(pressed(1e-7));
    const double exact = predictor.predict(sphere).pull_off_force;
    const HeightMap rounded(sphere.heights() + noise, pitch, pitch);
    EXPECT_NEAR(predictor.predict(rounded).pull_off_force / exact, 1.0, 1e-6) << pitch;
  }
}

}  // namespace
}  // namespace mems_stiction
