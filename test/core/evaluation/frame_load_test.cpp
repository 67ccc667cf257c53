/// Loads that are stated per area or for the device: every frame carries its share.

#include "evaluation/frame_load.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

HeightMap roughSurface(int side) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = side;
  options.pitch_x = options.pitch_y = 10e-9;
  options.correlation_length_x = options.correlation_length_y = 80e-9;
  options.rms_height = 5e-9;
  return gaussianSurface(options);
}

TEST(FrameLoad, APressureIsScaledToTheValidCells) {
  Options options;
  options.load.pressure = 2e5;
  HeightMap surface = roughSurface(64);
  const double whole = onFrame(options, {}, {surface, HeightMap()}).load.mechanical_load;
  // Sums of 4096 equal products: round-off of a few units of the last place.
  EXPECT_NEAR(whole, 2e5 * 64 * 64 * 1e-16, 1e-12 * whole);
  cv::Mat heights = surface.heights().clone();
  heights.rowRange(0, 32).setTo(std::numeric_limits<double>::quiet_NaN());
  const HeightMap half(heights, 10e-9, 10e-9);
  EXPECT_NEAR(onFrame(options, {}, {half, HeightMap()}).load.mechanical_load, 0.5 * whole,
              1e-12 * whole);
}

TEST(FrameLoad, AForceOnTheDeviceIsThePressureOnItsContactArea) {
  Configuration by_force;
  by_force.model.load.device_force = 1e-3;
  by_force.device.contact_area = 5e-9;
  Configuration by_pressure;
  by_pressure.model.load.pressure = 2e5;
  const HeightMap surface = roughSurface(64);
  const Prediction one = ScanPredictor(by_force).predict(surface);
  const Prediction other = ScanPredictor(by_pressure).predict(surface);
  EXPECT_DOUBLE_EQ(one.mechanical_load, other.mechanical_load);
  EXPECT_GT(one.mechanical_load, 0.0);
  EXPECT_GT(one.normal_load, ScanPredictor(Configuration()).predict(surface).normal_load);
}

TEST(FrameLoad, FramesOfEverySizeArePressedAlike) {
  Configuration configuration;
  configuration.model.load.pressure = 2e5;
  ScanPredictor predictor(configuration);
  for (const int side : {64, 128}) {
    const Prediction prediction = predictor.predict(roughSurface(side));
    EXPECT_NEAR(prediction.mechanical_load / prediction.nominal_area, 2e5, 1e-6);
  }
}

TEST(FrameLoad, OneOfThreeMayBeStated) {
  Configuration configuration;
  configuration.model.load.mechanical_load = 1e-6;
  configuration.model.load.pressure = 1.0;
  EXPECT_THROW(configuration.check(), OptionsError);
  configuration = Configuration();
  configuration.model.load.device_force = 1e-6;
  EXPECT_THROW(configuration.check(), OptionsError);  // without device/contact_area
  configuration.device.contact_area = 1e-10;
  EXPECT_NO_THROW(configuration.check());
}

TEST(FrameLoad, MoreThanTheLimitIsRefused) {
  Options options;
  options.load.pressure = 1e6;
  options.load.max_mechanical_load = 1e-9;
  EXPECT_THROW(onFrame(options, {}, {roughSurface(64), HeightMap()}), SurfaceError);
}

TEST(FrameLoad, AModelByItselfTakesNone) {
  Options options;
  options.load.pressure = 1.0;
  EXPECT_THROW(AdhesionModel model(options), OptionsError);
}

}  // namespace
}  // namespace mems_stiction
