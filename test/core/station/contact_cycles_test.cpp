#include "station/contact_cycles.hpp"

#include <atomic>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/paper_options.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

constexpr double kNm = 1e-9;

HeightMap rough() {
  GaussianSurfaceOptions options;
  options.rows = 256;
  options.cols = 240;
  options.rms_height = 5 * kNm;
  options.correlation_length_x = options.correlation_length_y = 100 * kNm;
  return gaussianSurface(options);
}

Options pressed(double hardness) {
  Options options = paperOptions();
  options.lower.hardness = options.upper.hardness = hardness;
  options.load.mechanical_load = 3e-5;
  return options;
}

ContactCyclesResult cycled(const Options& options, const HeightMap& lower, int count,
                           const DeviceOptions& device = DeviceOptions()) {
  return cycleContacts(options, lower, count, device, {}, {});
}

TEST(ContactCycles, elasticSurfacesComeBackUnchanged) {
  Options options = pressed(12e9);
  options.deformation = Deformation::kElastic;
  const ContactCyclesResult result = cycled(options, rough(), 4);
  ASSERT_EQ(result.cycles.size(), 4u);
  for (const ContactCycle& cycle : result.cycles) {
    EXPECT_EQ(cycle.largest_change, 0.0);
    EXPECT_EQ(cycle.status, Status::kEquilibrium);
    EXPECT_EQ(cycle.asperity_count, result.cycles[0].asperity_count);
    EXPECT_EQ(cycle.pull_off_force, result.cycles[0].pull_off_force);
  }
}

TEST(ContactCycles, firstContactIsThePrediction) {
  const Options options = pressed(3e9);
  const Prediction prediction = AdhesionModel(options).predict(rough());
  const ContactCyclesResult result = cycled(options, rough(), 1);
  EXPECT_EQ(result.cycles[0].pull_off_force, prediction.pull_off_force);
  EXPECT_EQ(result.cycles[0].contact_area, prediction.contact_area);
  EXPECT_EQ(cv::norm(result.surfaces.lower.heights(), prediction.deformed_lower, cv::NORM_INF),
            0.0);
  EXPECT_EQ(cv::norm(result.surfaces.upper.heights(), prediction.deformed_upper, cv::NORM_INF),
            0.0);
}

TEST(ContactCycles, eachStartsFromTheSurfacesThatTheLastOneLeft) {
  const Options options = pressed(3e9);
  const ContactCyclesResult two = cycled(options, rough(), 2);
  const ContactCyclesResult one = cycled(options, rough(), 1);
  const ContactCyclesResult next = cycleContacts(options, one.surfaces, 1, DeviceOptions(), {}, {});
  EXPECT_EQ(two.cycles[1].pull_off_force, next.cycles[0].pull_off_force);
  EXPECT_EQ(two.cycles[1].rms_height, next.cycles[0].rms_height);
  EXPECT_EQ(cv::norm(two.surfaces.lower.heights(), next.surfaces.lower.heights(), cv::NORM_INF),
            0.0);
}

TEST(ContactCycles, softSurfacesFlattenHoldMoreAndShakeDown) {
  const ContactCyclesResult result = cycled(pressed(9e9), rough(), 30);
  ASSERT_TRUE(result.is_complete);
  const ContactCycle& first = result.cycles.front();
  const ContactCycle& last = result.cycles.back();
  Options elastic = pressed(9e9);
  elastic.deformation = Deformation::kElastic;
  EXPECT_GT(first.contact_area, 1.5 * cycled(elastic, rough(), 1).cycles[0].contact_area);
  // flattened contacts are elastic: they need less area from the second time on, and keep it
  EXPECT_NEAR(last.contact_area, result.cycles[1].contact_area, 0.03 * last.contact_area);
  EXPECT_GT(last.pull_off_force, first.pull_off_force);
  EXPECT_LT(last.rms_height, first.rms_height);
  EXPECT_LT(last.largest_change, 0.01 * first.largest_change);
  for (std::size_t i = 1; i < result.cycles.size(); ++i) {
    EXPECT_EQ(result.cycles[i].cycle, static_cast<int>(i) + 1);
    EXPECT_LE(result.cycles[i].rms_height, result.cycles[i - 1].rms_height * (1.0 + 1e-9));
  }
}

TEST(ContactCycles, namesTheFirstThatSticks) {
  const HeightMap scan = rough();
  const Options options = pressed(3e9);
  DeviceOptions device;
  device.travel = 1e-6;
  device.contact_area = scan.cellArea() * scan.rows() * scan.cols();
  device.spring_stiffness =
      1e6 * cycled(options, scan, 1).cycles[0].pull_off_force;  // margin 1 in the first contact
  const ContactCyclesResult close = cycled(options, scan, 2, device);
  EXPECT_NEAR(close.cycles[0].margin, 1.0, 1e-9);
  EXPECT_EQ(close.cycles[0].sticks, Sticks::kMarginal);
  EXPECT_EQ(close.first_sticking_cycle, 0);
  device.spring_stiffness *= 1e-3;
  EXPECT_EQ(cycled(options, scan, 2, device).first_sticking_cycle, 1);
}

TEST(ContactCycles, aLargerDeviceFollowsItsFrame) {
  const HeightMap scan = rough();
  const Options options = pressed(3e9);
  DeviceOptions device;
  device.travel = 1e-6;
  device.spring_stiffness = 10.0;
  device.contact_area = 100.0 * scan.cellArea() * scan.rows() * scan.cols();
  EXPECT_TRUE(std::isnan(cycled(options, scan, 1, device).cycles[0].margin));
  DeviceScale scale;
  scale.frame_pull_off_force = cycled(options, scan, 1).cycles[0].pull_off_force;
  scale.device.pull_off_force = 5.0 * scale.frame_pull_off_force;
  scale.device.force_factors = {0.7, 1.0, 1.5};
  const ContactCyclesResult result =
      cycleContacts(options, scan, 2, device, {}, {}, {{0.0, 0.0, scale}});
  ASSERT_NE(result.cycles[1].pull_off_force, result.cycles[0].pull_off_force);
  for (const ContactCycle& cycle : result.cycles) {
    EXPECT_NEAR(cycle.margin * 5.0 * cycle.pull_off_force / 1e-5, 1.0, 1e-12);
  }
}

TEST(ContactCycles, leavesInvalidPixelsAndTheGivenScanAlone) {
  const HeightMap scan = analytic::withInvalidPixel(rough(), 7, 9);
  const cv::Mat before = scan.heights().clone();
  const ContactCyclesResult result = cycled(pressed(3e9), analytic::asSingle(scan), 3);
  EXPECT_TRUE(std::isnan(result.surfaces.lower.height(7, 9)));
  EXPECT_TRUE(std::isfinite(result.cycles[2].largest_change));
  cycled(pressed(3e9), scan, 2);
  EXPECT_EQ(std::memcmp(before.data, scan.heights().data, before.total() * before.elemSize()), 0);
}

TEST(ContactCycles, reportsProgressAndStopsWhenToldTo) {
  std::atomic<bool> cancel{false};
  RunControl control;
  control.cancel = &cancel;
  control.progress = [&](int done, int total) {
    EXPECT_EQ(total, 10);
    cancel = done == 3;
  };
  const ContactCyclesResult result =
      cycleContacts(pressed(3e9), rough(), 10, DeviceOptions(), {}, control);
  EXPECT_FALSE(result.is_complete);
  EXPECT_EQ(result.cycles.size(), 3u);
  EXPECT_FALSE(result.surfaces.lower.empty());
}

TEST(ContactCycles, refusesACountBelowOne) {
  EXPECT_THROW(cycled(pressed(3e9), rough(), 0), OptionsError);
}

}  // namespace
}  // namespace mems_stiction
