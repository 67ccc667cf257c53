/// The contacts that hold at the pull-off: no load that made the contact, voltage or weight, moves
/// what a verdict rests on.

#include <cmath>

#include <gtest/gtest.h>

#include "mems_stiction/verdict/verdict.hpp"
#include "separation/separation_curve.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/separation_cases.hpp"
#include "surface/gaussian_surface.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

using separation_cases::elastic;

constexpr double kPitch = 5e-9;
constexpr double kStiff = 90e9;

HeightMap gaussian(double rms_height, double correlation_length, int seed = 1) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 256;
  options.pitch_x = options.pitch_y = kPitch;
  options.rms_height = rms_height;
  options.correlation_length_x = options.correlation_length_y = correlation_length;
  options.seed = seed;
  return gaussianSurface(options);
}

Options under(double voltage, double load) {
  Options options = elastic(kStiff, load);
  options.load.voltage = voltage;
  options.interface.insulator_thickness = 20e-9;
  return options;
}

TEST(PullOffContacts, noLoadMovesAVerdictThatHasThePullOffForceOfNone) {
  for (const double rms_height : {1e-9, 3e-9, 6e-9}) {
    const HeightMap scan = gaussian(rms_height, 60e-9);
    const double cell_area = kPitch * kPitch;
    const Options unloaded = under(0.0, 0.0);
    const Prediction plain = AdhesionModel(unloaded).predict(scan);
    DeviceOptions device;
    device.travel = 1e-6;
    device.contact_area = plain.nominal_area;
    device.spring_stiffness = 20.0 * plain.pull_off_force / device.travel;
    const Verdict alone = verdictOf(plain, device, {}, unloaded, cell_area);
    for (const auto& [voltage, load] :
         {std::pair(20.0, 0.0), {60.0, 0.0}, {0.0, 3e-5}, {20.0, 1e-5}}) {
      SCOPED_TRACE(testing::Message() << rms_height << " m, " << voltage << " V, " << load << " N");
      const Options options = under(voltage, load);
      const Prediction pressed = AdhesionModel(options).predict(scan);
      ASSERT_EQ(pressed.pull_off_force, plain.pull_off_force);
      EXPECT_GT(pressed.asperity_count, plain.asperity_count);
      EXPECT_EQ(pressed.pull_off_contact_count, plain.pull_off_contact_count);
      const Verdict verdict = verdictOf(pressed, device, {}, options, cell_area);
      EXPECT_EQ(verdict.sticks, alone.sticks) << verdict.reason << " for " << alone.reason;
      EXPECT_EQ(regimeFlagNames(verdict.regime_flags), regimeFlagNames(alone.regime_flags));
      // the powers of the constants are sums over cells that a load brings into another order:
      // round-off
      EXPECT_NEAR(verdict.margin_lower / alone.margin_lower, 1.0, 1e-6);
      EXPECT_NEAR(verdict.margin_upper / alone.margin_upper, 1.0, 1e-6);
      EXPECT_EQ(verdict.place_deviation, alone.place_deviation);
    }
  }
}

TEST(PullOffContacts, areTheSummitsInReachOfTheAttraction) {
  // 20 equal spheres: all of them hold, each on the cells within z0 of the plane
  const double radius = 300e-9;
  const HeightMap spheres = analytic::sphereArray(4 * 60, 5 * 60, 2e-9, 2e-9, {radius}, 5, 4);
  const Prediction prediction = AdhesionModel(under(0.0, 1e-5)).predict(spheres);
  ASSERT_EQ(prediction.pull_off_contact_count, 20);
  for (const Asperity& contact : prediction.holdingContacts()) {
    EXPECT_NEAR(contact.composite_radius / radius, 1.0, 0.05);
    EXPECT_GT(contact.area, 2.0 * 3.14 * radius * 1.5e-10);
    EXPECT_FALSE(contact.is_at_border);
    EXPECT_EQ(contact.regime, Regime::kElastic);
  }
}

TEST(PullOffContacts, thatHaveFlowedUnderTheLoadAreKnownByIt) {
  const HeightMap spheres = analytic::sphereArray(4 * 60, 5 * 60, 2e-9, 2e-9, {300e-9}, 5, 4);
  Options options = under(0.0, 2e-5);
  options.deformation = Deformation::kThreeRegimes;
  options.lower.hardness = options.upper.hardness = 1e9;
  const Prediction prediction = AdhesionModel(options).predict(spheres);
  ASSERT_EQ(prediction.pull_off_contact_count, 20);
  for (const Asperity& contact : prediction.holdingContacts())
    EXPECT_NE(contact.regime, Regime::kElastic);
  EXPECT_TRUE(regimeFlags(prediction, 4e-18) & kPlasticityFlag);
}

TEST(PullOffContacts, atTheFramesBorderAreMarked) {
  const HeightMap slope = analytic::paraboloid(65, 65, 1e-9, 1e-9, 1e-6);
  cv::Mat half =
      slope.heights()(cv::Rect(32, 0, 33, 65)).clone();  // its summit lies on the first column
  const Prediction prediction = AdhesionModel(under(0.0, 0.0)).predict(HeightMap(half, 1e-9, 1e-9));
  ASSERT_EQ(prediction.pull_off_contact_count, 1);
  EXPECT_TRUE(prediction.holdingContacts().front().is_at_border);
}

TEST(PullOffContacts, areThoseAtRestWithoutAdhesion) {
  Options options = under(0.0, 1e-5);
  options.interface.work_of_adhesion = 0.0;
  const Prediction prediction = AdhesionModel(options).predict(gaussian(3e-9, 60e-9));
  EXPECT_EQ(prediction.pull_off_force, 0.0);
  EXPECT_EQ(prediction.pull_off_contact_count, prediction.asperity_count);
}

}  // namespace
}  // namespace mems_stiction
