/// Sweeps of beams: where they land, what holds them, where they open again.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "station/load_sweep.hpp"
#include "surface/gaussian_surface.hpp"
#include "verdict/beam_field.hpp"

namespace mems_stiction {
namespace {

constexpr double kNm = 1e-9;
constexpr double kRoundOff = 1e-12;

Options insulated() {
  Options options;
  options.interface.insulator_thickness = 50 * kNm;
  return options;
}

HeightMap rough() {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 256;
  options.rms_height = 5 * kNm;
  options.correlation_length_x = options.correlation_length_y = 100 * kNm;
  return gaussianSurface(options);
}

LoadSweepRequest upTo(double voltage, int count, double load = 0.0) {
  LoadSweepRequest request;
  for (int i = 0; i < count; ++i)
    request.voltages.push_back(count > 1 ? voltage * i / (count - 1) : voltage);
  request.mechanical_loads = {load};
  return request;
}

/// A beam with a pad of the scan's area that pulls with `force`, above an electrode along half of
/// it.
DeviceOptions beamFor(const HeightMap& scan, BeamType type, double force) {
  DeviceOptions device;
  device.beam_type = type;
  device.beam_length = 500e-6;
  device.beam_width = 5e-6;
  device.beam_thickness = 2e-6;
  device.beam_gap = 1e-6;
  device.beam_modulus = 160e9;
  device.contact_area = scan.cellArea() * scan.rows() * scan.cols();
  device.electrode_start = 100e-6;
  device.electrode_length = 200e-6;
  device.beam_modulus *= force / device.restoringForce();
  return device;
}

TEST(BeamSweep, landsAtItsPullInAndIsHeldByAdhesionAndField) {
  const HeightMap scan = rough();
  const Options options = insulated();
  const double adhesion =
      sweepLoads(options, scan, upTo(0.0, 1), DeviceOptions(), {}, {}).rows[0].pull_off_force;
  for (const BeamType type : {BeamType::kCantilever, BeamType::kDoublyClamped}) {
    const DeviceOptions device = beamFor(scan, type, 4.0 * adhesion);
    const double pull_in = closingVoltage(device, options.interface);
    const LoadSweepResult result =
        sweepLoads(options, scan, upTo(1.2 * pull_in, 25), device, {}, {});
    EXPECT_EQ(result.pull_in_voltage, pull_in);
    EXPECT_EQ(result.pull_in_reason, "");
    const double opening = result.summaries[0].opening_voltage;
    EXPECT_GT(opening, 0.0);
    EXPECT_LT(opening, pull_in);
    double before = 0.0;  // holding margin of the row before, on the way down
    for (const LoadSweepRow& row : result.rows) {
      const bool is_up = row.direction == SweepDirection::kUp;
      EXPECT_EQ(row.is_open, !is_up && row.voltage <= opening) << row.voltage;
      EXPECT_EQ(row.lands == Lands::kYes, is_up ? row.voltage >= pull_in : row.voltage > opening)
          << row.voltage;
      EXPECT_NE(row.lands, Lands::kUnknown);
      if (row.is_open) continue;
      EXPECT_FALSE(row.is_peeled);
      EXPECT_GT(row.peel_number, row.margin) << "a short pad";
      Options at_voltage = options;
      at_voltage.load.voltage = is_up ? row.voltage : 1.2 * pull_in;
      const double mean_gap = AdhesionModel(at_voltage).predict(scan).mean_gap;
      const double field =
          fieldHold(device.beam(), *electrodeOf(device, options.interface), row.voltage, mean_gap)
              .force;
      EXPECT_NEAR(row.holding_margin, device.restoringForce() / (row.pull_off_force + field), 1e-9)
          << row.voltage;
      if (is_up) continue;
      EXPECT_GE(row.holding_margin, before);
      before = row.holding_margin;
    }
  }
}

TEST(BeamSweep, withoutAPadIsJudgedAndHeldByPeeling) {
  const HeightMap scan = rough();
  const Options options = insulated();
  for (const BeamType type : {BeamType::kCantilever, BeamType::kDoublyClamped}) {
    DeviceOptions device = beamFor(scan, type, 1e-6);
    device.contact_area = 0.0;
    const double own_work = peelNumber(device.beam(), 1.0);
    for (const double peel_number : {2.0, 0.5}) {
      device.apparent_work_of_adhesion = own_work / peel_number;
      const double pull_in = closingVoltage(device, options.interface);
      const LoadSweepResult result =
          sweepLoads(options, scan, upTo(1.2 * pull_in, 13), device, {}, {});
      const LoadSweepSummary& summary = result.summaries[0];
      EXPECT_EQ(std::isnan(summary.highest_releasing_voltage), peel_number < 1.0);
      EXPECT_EQ(std::isnan(summary.lowest_sticking_voltage), peel_number > 1.0);
      EXPECT_EQ(std::isnan(summary.opening_voltage), peel_number < 1.0);
      for (const LoadSweepRow& row : result.rows) {
        if (row.is_open) continue;
        EXPECT_TRUE(row.is_peeled);
        EXPECT_NEAR(row.ratio(), peel_number, 1e-9);
        EXPECT_EQ(row.sticks, peel_number > 1.0 ? Sticks::kNo : Sticks::kYes);
        EXPECT_TRUE(std::isnan(row.margin));
        EXPECT_GE(row.holding_margin, 0.0);
        EXPECT_LE(row.holding_margin, (1.0 + kRoundOff) * peel_number);
        EXPECT_EQ(row.holding_margin<(1.0 - kRoundOff) * peel_number, row.voltage> 0.0);
      }
      EXPECT_GT(result.rows[1].holding_margin, 0.0);
      const LoadSweepRow& last = result.rows.back();
      EXPECT_EQ(last.lands, peel_number > 1.0 ? Lands::kNo : Lands::kYes) << "down to 0 V";
    }
  }
}

TEST(BeamSweep, aStiffSpringBesideABeamHoldsItNoLonger) {
  const HeightMap scan = rough();
  DeviceOptions beam = beamFor(scan, BeamType::kCantilever, 1e-5);
  beam.electrode_length = 0.0;
  DeviceOptions both = beam;
  both.travel = 1e-6;
  for (const double stiffness : {1.0, 1e4}) {  // the spring is the worse, then the beam
    both.spring_stiffness = stiffness;
    const auto holdingOf = [&](const DeviceOptions& device) {
      return sweepLoads(insulated(), scan, upTo(0.0, 1, 0.0), device, {}, {})
          .rows.back()
          .holding_margin;
    };
    DeviceOptions spring = both;
    spring.beam_type = BeamType::kNone;
    EXPECT_NEAR(holdingOf(both) / std::min(holdingOf(beam), holdingOf(spring)), 1.0, 1e-9)
        << stiffness;
  }
}

TEST(BeamSweep, saysWhatItsLandingLacks) {
  const HeightMap scan = rough();
  DeviceOptions device = beamFor(scan, BeamType::kCantilever, 1e-6);
  device.electrode_length = 0.0;
  const LoadSweepResult result = sweepLoads(insulated(), scan, upTo(20.0, 3, 1e-7), device, {}, {});
  EXPECT_EQ(result.pull_in_reason, "device/electrode_length");
  EXPECT_TRUE(std::isnan(result.pull_in_voltage));
  const LoadSweepRow& row = result.rows[1];
  EXPECT_EQ(row.lands, Lands::kUnknown);
  // as of a spring without an electrode: the scan's field and load, which have the size of the pad
  EXPECT_NEAR(row.holding_margin * (row.pull_off_force + row.electrostatic_force + 1e-7) /
                  device.restoringForce(),
              1.0, 1e-9);
  device.contact_area = 0.0;
  const LoadSweepResult by_work =
      sweepLoads(insulated(), scan, upTo(20.0, 3, 1e-7), device, {}, {});
  EXPECT_TRUE(std::isnan(by_work.rows[1].holding_margin))
      << "a load in newtons on a beam whose contact has no area";
  EXPECT_FALSE(std::isnan(by_work.rows[1].peel_number));
}

}  // namespace
}  // namespace mems_stiction
