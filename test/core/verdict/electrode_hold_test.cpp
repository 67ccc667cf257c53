#include "verdict/electrode_hold.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "mems_stiction/verdict/verdict.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"

namespace mems_stiction {
namespace {

constexpr double kMicron = 1e-6;

InterfaceOptions oxidised() {
  InterfaceOptions interface;
  interface.insulator_thickness = 39e-9;
  interface.insulator_relative_permittivity = 3.9;  // 10 nm of gap
  return interface;
}

/// A plate on a spring that lands on pads of their own, beside its electrode.
DeviceOptions landingOnPads() {
  DeviceOptions device;
  device.spring_stiffness = 5.0;
  device.travel = 1 * kMicron;
  device.contact_area = 4e-12;
  device.electrode_area = 1e-8;
  device.electrode_gap = 1.5 * kMicron;
  return device;
}

DeviceOptions beamAbove() {
  DeviceOptions device;
  device.beam_type = BeamType::kCantilever;
  device.beam_length = 200 * kMicron;
  device.beam_width = 20 * kMicron;
  device.beam_thickness = device.beam_gap = 2 * kMicron;
  device.beam_modulus = 160e9;
  device.electrode_start = 60 * kMicron;
  device.electrode_length = 80 * kMicron;
  device.contact_area = 4e-12;
  return device;
}

/// F_e of parallel plates, spelled out.
double plates(double area, double voltage, double electrical_gap) {
  return 0.5 * kVacuumPermittivity * area * voltage * voltage / (electrical_gap * electrical_gap);
}

TEST(ElectrodeHold, electrodesCloseBySoMuchLessVoltage) {
  for (const DeviceOptions& device : {landingOnPads(), beamAbove()}) {
    const double bare = closingVoltage(device, oxidised());
    EXPECT_EQ(closingVoltage(device, oxidised(), 0.0), bare);
    for (const double potential : {0.3, -0.3})
      EXPECT_DOUBLE_EQ(closingVoltage(device, oxidised(), potential), bare - 0.3);
    EXPECT_EQ(closingVoltage(device, oxidised(), -2.0 * bare), 0.0);
  }
  EXPECT_TRUE(std::isnan(closingVoltage(DeviceOptions(), oxidised(), 0.3)));
}

TEST(ElectrodeHold, isTheFieldOfThePlatesThatAreLeft) {
  DeviceOptions device = landingOnPads();
  const double mean_gap = 12e-9;
  EXPECT_NEAR(lastingHold(device, oxidised(), -7.0, mean_gap).force,
              plates(1e-8, 7.0, 0.5 * kMicron + mean_gap + 10e-9), 1e-15);
  EXPECT_EQ(lastingHold(device, oxidised(), 0.0, mean_gap).force, 0.0);
  device.electrode_gap = 0.0;  // it lands on the electrode, which the contact's own field covers
  EXPECT_NEAR(lastingHold(device, oxidised(), 7.0, mean_gap).force,
              plates(1e-8 - device.contact_area, 7.0, mean_gap + 10e-9), 1e-12);
  device.contact_area = 2.0 * device.electrode_area;
  EXPECT_EQ(lastingHold(device, oxidised(), 7.0, mean_gap).force, 0.0);
  device.electrode_area = 0.0;
  EXPECT_EQ(lastingHold(device, oxidised(), 7.0, mean_gap).force, 0.0);
}

TEST(ElectrodeHold, ofABeamIsThatOfAVoltage) {
  const DeviceOptions device = beamAbove();
  const FieldHold hold = lastingHold(device, oxidised(), -7.0, 12e-9);
  const FieldHold by_voltage =
      fieldHold(device.beam(), *electrodeOf(device, oxidised()), 7.0, 12e-9);
  EXPECT_EQ(hold.force, by_voltage.force);
  EXPECT_EQ(hold.work, by_voltage.work);
  EXPECT_GT(hold.force, 0.0);
}

/// A rough-free sphere, so that every figure is a closed form of the scan's.
struct HeldDevice {
  Options options;
  HeightMap surface = analytic::sphereArray(60, 60, 2e-9, 2e-9, {2e-6}, 1, 1);
  Prediction prediction;
  UncertaintyOptions uncertainty;

  explicit HeldDevice(double contact_potential) {
    options.interface = oxidised();
    options.load.contact_potential = contact_potential;
    prediction = AdhesionModel(options).predict(surface);
  }
  Verdict of(DeviceOptions device) const {
    device.contact_area = prediction.nominal_area;
    return verdictOf(prediction, device, uncertainty, options, surface.cellArea());
  }
};

TEST(ElectrodeHold, countsInTheMarginAndItsInterval) {
  const HeldDevice held(20.0);
  DeviceOptions without = landingOnPads();
  without.electrode_area = 0.0;
  const Verdict bare = held.of(without);
  const Verdict verdict = held.of(landingOnPads());
  const double of_electrodes = plates(1e-8, 20.0, 0.5 * kMicron + held.prediction.mean_gap + 10e-9);
  EXPECT_NEAR(verdict.device_pull_off_force, bare.device_pull_off_force + of_electrodes,
              1e-9 * of_electrodes);
  EXPECT_NEAR(verdict.margin * (bare.device_pull_off_force + of_electrodes),
              verdict.restoring_force, 1e-9 * verdict.restoring_force);
  const double spread =
      std::exp(2.0 * 1.959964 * std::sqrt(std::log1p(0.09)));  // of V_c^2, at the 97.5 % quantile
  ASSERT_EQ(held.uncertainty.contact_potential, 0.3);
  EXPECT_NEAR(verdict.device_pull_off_force_upper,
              bare.device_pull_off_force_upper + spread * of_electrodes,
              1e-6 * verdict.device_pull_off_force_upper);
  EXPECT_NEAR(verdict.device_pull_off_force_lower,
              bare.device_pull_off_force_lower + of_electrodes / spread,
              1e-6 * verdict.device_pull_off_force_lower);
  EXPECT_NEAR(verdict.margin_lower * verdict.device_pull_off_force_upper, verdict.restoring_force,
              1e-9 * verdict.restoring_force);
  EXPECT_NE(verdict.reason.find(" of what holds are of the contact potential between the "
                                "electrodes"),
            std::string::npos)
      << verdict.reason;
  EXPECT_EQ(bare.reason.find("electrodes"), std::string::npos);
}

TEST(ElectrodeHold, countsInPeelNumberAndForceOfABeam) {
  const HeldDevice held(20.0);
  DeviceOptions without = beamAbove();
  without.electrode_length = 0.0;
  const Verdict bare = held.of(without);
  const Verdict verdict = held.of(beamAbove());
  const FieldHold hold =
      fieldHold(beamAbove().beam(), *electrodeOf(beamAbove(), held.options.interface), 20.0,
                held.prediction.mean_gap);
  ASSERT_TRUE(std::isfinite(hold.force) && hold.force > 0.0);
  EXPECT_NEAR(verdict.device_pull_off_force, bare.device_pull_off_force + hold.force,
              1e-9 * verdict.device_pull_off_force);
  EXPECT_NEAR(verdict.peel_number * (bare.device_apparent_work_of_adhesion + hold.work),
              bare.peel_number * bare.device_apparent_work_of_adhesion, 1e-9);
  EXPECT_LT(verdict.peel_number_lower, verdict.peel_number);
  EXPECT_GT(verdict.peel_number_upper, verdict.peel_number);
  EXPECT_EQ(verdict.device_apparent_work_of_adhesion, bare.device_apparent_work_of_adhesion);
}

/// The longest beam that comes off is the one whose peel number is 1, with the field of an
/// electrode of the same proportions.
TEST(ElectrodeHold, lengthsAreThoseOfAdhesionAndFieldTogether) {
  for (const BeamType type : {BeamType::kCantilever, BeamType::kDoublyClamped}) {
    for (const double potential : {0.0, 2.0, -8.0}) {
      const HeldDevice held(potential);
      DeviceOptions device = beamAbove();
      device.beam_type = type;
      for (const double peel_number : {0.3, 0.9, 1.1, 5.0}) {
        device.apparent_work_of_adhesion = peelNumber(device.beam(), 1.0) / peel_number;
        const Verdict verdict = held.of(device);
        EXPECT_EQ(verdict.peel_number > 1.0, verdict.detachment_length > device.beam_length);
        DeviceOptions longest = device;
        longest.beam_length = verdict.detachment_length;
        const double scale = longest.beam_length / device.beam_length;
        longest.electrode_start *= scale;
        longest.electrode_length *= scale;
        EXPECT_NEAR(held.of(longest).peel_number, 1.0, 1e-9)
            << static_cast<int>(type) << ", " << potential << " V, " << peel_number;
        const FieldHold field =
            stuckFieldHold(device.beam(), *electrodeOf(device, held.options.interface), potential,
                           held.prediction.mean_gap, verdict.unstuck_length);
        EXPECT_NEAR((device.apparent_work_of_adhesion + field.work) /
                        sShapeWork(device.beam(), verdict.unstuck_length),
                    1.0, 1e-9);
        EXPECT_LE(verdict.unstuck_length,
                  unstuckLength(device.beam(), device.apparent_work_of_adhesion));
      }
    }
  }
}

TEST(ElectrodeHold, aBeamThatItsFieldHoldsAloneSticks) {
  const HeldDevice held(50.0);
  DeviceOptions soft = beamAbove();
  soft.beam_modulus = 1e9;
  soft.electrode_length = soft.beam_length - soft.electrode_start;
  ASSERT_TRUE(std::isinf(lastingHold(soft, held.options.interface, 50.0, 0.0).force));
  const Verdict verdict = held.of(soft);
  EXPECT_EQ(verdict.sticks, Sticks::kYes) << verdict.reason;
  EXPECT_EQ(verdict.margin, 0.0);
  EXPECT_EQ(verdict.pull_in_voltage, 0.0);
}

}  // namespace
}  // namespace mems_stiction
