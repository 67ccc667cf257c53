#include "station/load_sweep.hpp"

#include <atomic>
#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/jkr.hpp"
#include "mechanics/surface_forces.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/constants.hpp"
#include "station/remaining_contact.hpp"
#include "station/sweep_table.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/paper_options.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

constexpr double kNm = 1e-9;
constexpr double kRoundOff = 1e-12;

Options insulated() {
  Options options = paperOptions();
  options.interface.insulator_thickness = 50 * kNm;
  return options;
}

HeightMap sphere() { return analytic::paraboloid(301, 301, 1 * kNm, 1 * kNm, 2e-6); }

HeightMap rough() {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 256;
  options.rms_height = 5 * kNm;
  options.correlation_length_x = options.correlation_length_y = 100 * kNm;
  return gaussianSurface(options);
}

/// A device of the scan's area whose spring gives `force`.
DeviceOptions deviceFor(const HeightMap& scan, double force) {
  DeviceOptions device;
  device.travel = 1e-6;
  device.spring_stiffness = force / device.travel;
  device.contact_area = scan.cellArea() * scan.rows() * scan.cols();
  return device;
}

TEST(RemainingContact, elasticContactFollowsJkrDown) {
  Options options = paperOptions();
  options.interface.hamaker_constant = 0.0;
  options.deformation = Deformation::kElastic;
  RemainingContact remaining(options, sphere());
  remaining.advance(0.0, 1e-5);
  const Asperity& asperity = remaining.contact().asperities[0];
  const double modulus = ContactPair(options.lower, options.upper).contact_modulus;
  for (const double load : {4e-6, 1e-7, 0.0}) {
    const RemainingState state = remaining.advance(0.0, load);
    EXPECT_FALSE(state.is_searched);
    EXPECT_EQ(state.normal_load, load);
    const double a = jkr::equilibriumContactRadius(load * std::cos(asperity.tilt), 0.05,
                                                   asperity.composite_radius, modulus);
    EXPECT_NEAR(state.contact_area_jkr, kPi * a * a, kRoundOff * kPi * a * a);
    // a search from first touch at this load finds the same contact: JKR has no hysteresis while it
    // presses
    Options at_load = options;
    at_load.load.mechanical_load = load;
    const Prediction searched = AdhesionModel(at_load).predict(sphere());
    EXPECT_NEAR(state.contact_area_jkr, searched.contact_area_jkr,
                0.05 * searched.contact_area_jkr);  // 20 pixels
  }
}

TEST(RemainingContact, flattenedContactKeepsItsArea) {
  Options options = paperOptions();
  options.lower.hardness = 0.5e9;
  options.interface.hamaker_constant = 0.0;
  RemainingContact remaining(options, sphere());
  const RemainingState largest = remaining.advance(0.0, 1e-5);
  ASSERT_EQ(remaining.contact().plastic_count, 1);
  const RemainingState back = remaining.advance(0.0, 1e-7);
  EXPECT_NEAR(back.contact_area_jkr, largest.contact_area_jkr,
              kRoundOff * largest.contact_area_jkr);
}

TEST(RemainingContact, fieldFollowsTheSquareOfTheVoltage) {
  RemainingContact remaining(insulated(), sphere());
  const RemainingState at_ten = remaining.advance(10.0, 0.0);
  const RemainingState at_four = remaining.advance(4.0, 0.0);
  EXPECT_TRUE(at_ten.is_searched);
  EXPECT_FALSE(at_four.is_searched);
  EXPECT_NEAR(at_four.electrostatic_force, 0.16 * at_ten.electrostatic_force,
              kRoundOff * at_ten.electrostatic_force);
  EXPECT_EQ(remaining.advance(0.0, 0.0).electrostatic_force, 0.0);
}

TEST(RemainingContact, contactPotentialActsAtEveryVoltage) {
  Options options = insulated();
  options.load.contact_potential = 2.0;
  RemainingContact remaining(options, sphere());
  const RemainingState at_ten = remaining.advance(10.0, 0.0);
  for (const double voltage : {4.0, 0.0}) {
    const double share = (voltage + 2.0) / 12.0;
    EXPECT_NEAR(remaining.advance(voltage, 0.0).electrostatic_force,
                share * share * at_ten.electrostatic_force, kRoundOff * at_ten.electrostatic_force);
  }
}

TEST(RemainingContact, goesOnAsOneSearchAtTheLargerLoad) {
  RemainingContact remaining(insulated(), rough());
  remaining.advance(5.0, 0.0);
  remaining.advance(0.0, 0.0);
  const RemainingState state = remaining.advance(20.0, 1e-6);
  Options options = insulated();
  options.load.voltage = 20.0;
  options.load.mechanical_load = 1e-6;
  const Prediction searched = AdhesionModel(options).predict(rough());
  EXPECT_TRUE(state.is_searched);
  EXPECT_EQ(remaining.contact().pull_off_force, searched.pull_off_force);
  EXPECT_EQ(state.contact_area_jkr, searched.contact_area_jkr);
}

TEST(RemainingContact, aSmallerContactDoesNotReplaceALargerOne) {
  RemainingContact remaining(insulated(), rough());
  remaining.advance(0.0, 1e-4);
  const double pull_off = remaining.contact().pull_off_force;
  const RemainingState state =
      remaining.advance(1.0, 0.0);  // a voltage not seen before, but far weaker
  EXPECT_FALSE(state.is_searched);
  EXPECT_EQ(remaining.contact().pull_off_force, pull_off);
  EXPECT_GT(state.electrostatic_force, 0.0);
}

LoadSweepRequest upTo(double voltage, int count, std::vector<double> loads = {0.0}) {
  LoadSweepRequest request;
  for (int i = 0; i < count; ++i)
    request.voltages.push_back(count > 1 ? voltage * i / (count - 1) : voltage);
  request.mechanical_loads = std::move(loads);
  return request;
}

TEST(LoadSweep, contactFractionIsThatOfThePredictionToTheBit) {
  for (const char* formulation : {"paper", "separation_curve"}) {
    Options options = insulated();
    options.formulation = formulation;
    for (const double load : {1e-6, 3e-6, 7e-6, 2e-5}) {
      const LoadSweepResult swept = sweepLoads(options, rough(), {{0.0, 3.0}, {load}}, {}, {}, {});
      for (const LoadSweepRow& row : swept.rows) {
        if (row.direction == SweepDirection::kDown) continue;
        Options one = options;
        one.load.voltage = row.voltage;
        one.load.mechanical_load = load;
        EXPECT_EQ(row.contact_fraction, AdhesionModel(one).predict(rough()).contact_fraction)
            << formulation << load;
      }
    }
  }
}

TEST(LoadSweep, findsTheDeviceUnderAllLoadsOrSomeWithTheLargest) {
  Options options = insulated();
  options.load.contact_potential = 0.3;
  const std::vector<LoadOptions> all = upTo(40.0, 3, {0.0, 1e-6}).loadsOfDevice(options);
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(all[1].voltage, 20.0);
  EXPECT_EQ(all[1].mechanical_load, 0.0);
  EXPECT_EQ(all[5].mechanical_load, 1e-6);
  EXPECT_EQ(all[5].contact_potential, 0.3);
  const std::vector<LoadOptions> some = upTo(40.0, 1001, {0.0, 1e-6}).loadsOfDevice(options);
  EXPECT_LE(some.size(), 16u);
  EXPECT_EQ(some.front().voltage, 0.0);
  EXPECT_EQ(some.back().voltage, 40.0);
  EXPECT_TRUE(upTo(40.0, 3, {}).loadsOfDevice(options).empty()) << "a request that is refused";
}

TEST(LoadSweep, aRowHasTheDeviceOfTheLeastLoadThatIsNoLess) {
  const HeightMap scan = rough();
  const DeviceOptions device = deviceFor(scan, 1e-5);
  std::vector<LoadedScale> scales;
  for (const double voltage : {0.0, 10.0, 20.0}) {
    LoadedScale beside;
    beside.voltage = voltage;
    beside.scale.device.pull_off_force = 1e-6 * (1.0 + voltage);
    beside.scale.device.force_factors = {0.7, 1.0, 1.5};
    Options options = insulated();
    options.load.voltage = voltage;
    beside.scale.frame_pull_off_force = AdhesionModel(options).predict(scan).pull_off_force;
    scales.push_back(beside);
  }
  const LoadSweepResult swept =
      sweepLoads(insulated(), scan, upTo(20.0, 3), device, {}, {}, scales);
  ASSERT_EQ(swept.rows.size(), 5u);
  EXPECT_NEAR(swept.rows[0].margin / swept.rows[1].margin, 11.0, 1e-6);
  EXPECT_NEAR(swept.rows[0].margin / swept.rows[2].margin, 21.0, 1e-6);
}

TEST(LoadSweep, showsHysteresisOnARoughSurface) {
  const LoadSweepResult result =
      sweepLoads(insulated(), rough(), upTo(40.0, 5, {0.0, 1e-6}), DeviceOptions(), {}, {});
  ASSERT_TRUE(result.is_complete);
  ASSERT_EQ(result.rows.size(), 18u);
  ASSERT_EQ(result.summaries.size(), 2u);
  for (const std::size_t begin : {0u, 9u}) {
    for (std::size_t i = 0; i < 4; ++i) {
      const LoadSweepRow& up = result.rows[begin + i];
      const LoadSweepRow& down = result.rows[begin + 8 - i];
      EXPECT_EQ(up.voltage, down.voltage);
      EXPECT_EQ(up.direction, SweepDirection::kUp);
      EXPECT_EQ(down.direction, SweepDirection::kDown);
      EXPECT_LT(up.approach, result.rows[begin + i + 1].approach);
      EXPECT_LT(up.contact_area, result.rows[begin + i + 1].contact_area);
      EXPECT_GT(down.pull_off_force, up.pull_off_force);
      EXPECT_GT(down.contact_area_jkr, up.contact_area_jkr);
      EXPECT_EQ(down.pull_off_force, result.rows[begin + 4].pull_off_force);
      EXPECT_LT(down.contact_area_jkr,
                result.rows[begin + 9 - 1 - i - 1].contact_area_jkr);  // the row before it
    }
  }
  EXPECT_TRUE(std::isnan(result.rows[0].margin));  // no device
  EXPECT_TRUE(std::isnan(result.summaries[0].highest_releasing_voltage));
  EXPECT_EQ(result.rows[0].sticks, Sticks::kUnknown);
}

TEST(LoadSweep, findsTheHighestVoltageThatReleases) {
  const HeightMap scan = rough();
  const LoadSweepResult plain =
      sweepLoads(insulated(), scan, upTo(40.0, 5), DeviceOptions(), {}, {});
  const double between = 0.5 * (plain.rows[2].pull_off_force + plain.rows[3].pull_off_force);
  DeviceOptions device = deviceFor(scan, between);
  device.electrode_area = 1e-8;
  const LoadSweepResult result = sweepLoads(insulated(), scan, upTo(40.0, 5), device, {}, {});
  EXPECT_EQ(result.summaries[0].highest_releasing_voltage, 20.0);
  EXPECT_EQ(result.summaries[0].lowest_sticking_voltage, 30.0);
  EXPECT_FALSE(result.summaries[0].highest_safe_voltage >
               20.0);  // NaN or lower: the interval is wider
  EXPECT_NEAR(result.rows[2].margin, between / plain.rows[2].pull_off_force, 1e-9);
  EXPECT_EQ(result.pull_in_voltage, closingVoltage(device, insulated().interface));
}

TEST(LoadSweep, theSummaryFollowsFromTheVerdictsOfItsRows) {
  const double nan = Verdict::kNotStated;
  struct Case {
    std::vector<Sticks> verdicts;  // at 0, 10, 20 V
    double highest_safe;
    double lowest_safe;
  };
  const Sticks no = Sticks::kNo, marginal = Sticks::kMarginal, unknown = Sticks::kUnknown,
               yes = Sticks::kYes;
  for (const Case& one : {Case{{no, no, no}, 20.0, 0.0},
                          {{no, no, unknown}, 10.0, 0.0},
                          {{no, unknown, no}, 0.0, 0.0},
                          {{unknown, unknown, no}, nan, 20.0},
                          {{marginal, no, no}, nan, 10.0},
                          {{marginal, yes, unknown}, nan, nan}}) {
    std::vector<LoadSweepRow> rows;
    for (const Sticks sticks : one.verdicts) {
      LoadSweepRow row;
      row.voltage = 10.0 * static_cast<double>(rows.size());
      row.status = Status::kEquilibrium;
      row.margin = sticks == yes ? 0.5 : 3.0;
      row.sticks = sticks;
      rows.push_back(row);
    }
    rows.back().direction = SweepDirection::kUp;
    LoadSweepRow open;
    open.direction = SweepDirection::kDown;
    open.sticks = no;
    rows.push_back(open);
    const LoadSweepSummary summary = summaryOf(0.0, rows);
    const auto is = [](double value, double expected) {
      return std::isnan(expected) ? std::isnan(value) : value == expected;
    };
    EXPECT_TRUE(is(summary.highest_safe_voltage, one.highest_safe)) << summary.highest_safe_voltage;
    EXPECT_TRUE(is(summary.lowest_safe_voltage, one.lowest_safe)) << summary.lowest_safe_voltage;
    EXPECT_TRUE(is(summary.lowest_sticking_voltage, one.verdicts[1] == yes ? 10.0 : nan));
  }
}

TEST(LoadSweep, theForceHasItsIntervalWithADeviceAndWithout) {
  const HeightMap scan = rough();
  const LoadSweepResult plain =
      sweepLoads(insulated(), scan, upTo(20.0, 2), DeviceOptions(), {}, {});
  const LoadSweepResult judged =
      sweepLoads(insulated(), scan, upTo(20.0, 2), deviceFor(scan, 1e-5), {}, {});
  for (std::size_t i = 0; i < plain.rows.size(); ++i) {
    const LoadSweepRow& row = judged.rows[i];
    if (row.is_open) continue;
    EXPECT_LT(row.pull_off_interval.lower, row.pull_off_force);
    EXPECT_GT(row.pull_off_interval.upper, row.pull_off_force);
    EXPECT_EQ(row.pull_off_interval.upper, plain.rows[i].pull_off_interval.upper);
    // the margin is the restoring force over the pull-off force: their intervals are each other's
    // inverse
    EXPECT_NEAR(row.margin_upper / row.margin, row.pull_off_force / row.pull_off_interval.lower,
                kRoundOff * row.margin_upper);
    EXPECT_NEAR(row.margin_lower / row.margin, row.pull_off_force / row.pull_off_interval.upper,
                kRoundOff);
  }
}

TEST(LoadSweep, opensOnTheWayDownWhereTheSpringOvercomesAdhesionAndField) {
  const HeightMap scan = sphere();
  const LoadSweepResult plain =
      sweepLoads(insulated(), scan, upTo(20.0, 11), DeviceOptions(), {}, {});
  const LoadSweepRow& top = plain.rows[10];
  // pull-off and the field of 9 V: opens at the next lower voltage of the grid, 8 V
  const double force = top.pull_off_force + top.electrostatic_force * 81.0 / 400.0;
  const LoadSweepResult result =
      sweepLoads(insulated(), scan, upTo(20.0, 11), deviceFor(scan, force), {}, {});
  EXPECT_EQ(result.summaries[0].opening_voltage, 8.0);
  for (const LoadSweepRow& row : result.rows) {
    const bool opens = row.direction == SweepDirection::kDown && row.voltage <= 8.0;
    EXPECT_EQ(row.is_open, opens) << row.voltage;
    EXPECT_EQ(row.pull_off_force == 0.0, opens) << row.voltage;
  }
}

TEST(LoadSweep, anOpenRowHasTheWordOfTheContactThatOpens) {
  const HeightMap scan = rough();
  const auto sweep = [&](double force) {
    return sweepLoads(insulated(), scan, upTo(20.0, 3), deviceFor(scan, force), {}, {});
  };
  const double force = sweep(1e-12).rows.back().pull_off_force;
  for (const double margin : {1.01, 1e3}) {
    const LoadSweepResult result = sweep(margin * force);
    const Sticks word = result.rows[2].sticks;  // of the contact at the highest voltage
    EXPECT_EQ(word, margin < 2.0 ? Sticks::kMarginal : Sticks::kNo);
    ASSERT_TRUE(result.rows.back().is_open);
    EXPECT_EQ(result.rows.back().sticks, word);
  }
}

TEST(LoadSweep, whatAContactPotentialHoldsIsCountedOnce) {
  const HeightMap scan = sphere();
  Options options = insulated();
  options.load.contact_potential = 2.0;
  const LoadSweepResult result =
      sweepLoads(options, scan, upTo(10.0, 2), deviceFor(scan, 1e-6), {}, {});
  const LoadSweepRow& off = result.rows[0];
  EXPECT_GT(off.electrostatic_force, 0.0);
  EXPECT_EQ(off.holding_margin, off.margin);
  const LoadSweepRow& on = result.rows[1];
  const double field = on.electrostatic_force * (1.0 - 4.0 / 144.0);
  EXPECT_NEAR(on.holding_margin, 1e-6 / (on.pull_off_force + field), 1e-9 * on.holding_margin);
}

TEST(LoadSweep, mechanicalLoadHoldsTheDeviceToo) {
  const HeightMap scan = sphere();
  const LoadSweepResult plain =
      sweepLoads(paperOptions(), scan, upTo(0.0, 1, {1e-6}), DeviceOptions(), {}, {});
  const double pull_off = plain.rows[0].pull_off_force;
  const LoadSweepResult result = sweepLoads(paperOptions(), scan, upTo(0.0, 1, {1e-6}),
                                            deviceFor(scan, pull_off + 1e-6), {}, {});
  EXPECT_NEAR(result.rows[0].holding_margin, 1.0, kRoundOff);
  EXPECT_NEAR(result.rows[0].margin, (pull_off + 1e-6) / pull_off, 1e-9);
}

TEST(LoadSweep, aLargerDeviceFollowsItsFrame) {
  const HeightMap scan = rough();
  const LoadSweepRequest request = upTo(0.0, 1, {0.0, 1e-6, 1e-5});
  DeviceOptions device = deviceFor(scan, 1e-5);
  device.contact_area *= 100.0;
  const LoadSweepResult unknown = sweepLoads(paperOptions(), scan, request, device, {}, {});
  DeviceScale scale;
  scale.frame_pull_off_force = unknown.rows[0].pull_off_force;
  scale.device.pull_off_force = 5.0 * scale.frame_pull_off_force;
  scale.device.force_factors = {0.7, 1.0, 1.5};
  const LoadSweepResult result =
      sweepLoads(paperOptions(), scan, request, device, {}, {}, {{0.0, 0.0, scale}});
  ASSERT_GT(result.rows.back().pull_off_force, 1.5 * result.rows[0].pull_off_force);
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const LoadSweepRow& row = result.rows[i];
    EXPECT_EQ(unknown.rows[i].sticks, Sticks::kUnknown);
    EXPECT_TRUE(std::isnan(unknown.rows[i].margin) && std::isnan(unknown.rows[i].holding_margin));
    EXPECT_NEAR(row.margin * 5.0 * row.pull_off_force / 1e-5, 1.0, kRoundOff);
    const double pressing = 100.0 * row.mechanical_load;  // its pressure on the whole device
    EXPECT_NEAR(row.holding_margin * (5.0 * row.pull_off_force + pressing) / 1e-5, 1.0, kRoundOff);
  }
}

TEST(LoadSweep, fieldOfAStatedElectrodeHoldsTheDevice) {
  const HeightMap scan = sphere();
  DeviceOptions device = deviceFor(scan, 1e-6);
  device.electrode_area = 1e-9;
  device.electrode_gap = 1.5e-6;  // 0.5 um is left when closed
  const LoadSweepResult result = sweepLoads(insulated(), scan, upTo(10.0, 2), device, {}, {});
  const LoadSweepRow& row = result.rows[1];
  Options at_ten = insulated();
  at_ten.load.voltage = 10.0;
  const double mean_gap = AdhesionModel(at_ten).predict(scan).mean_gap;
  const double field =
      1e-9 * surface_forces::electrostaticPressure(0.5e-6 + mean_gap, 10.0, 50 * kNm, 3.9);
  EXPECT_NEAR(row.holding_margin, 1e-6 / (row.pull_off_force + field), 1e-9 * row.holding_margin);
}

TEST(LoadSweep, aStatedElectrodeHasBothPotentials) {
  const HeightMap scan = sphere();
  DeviceOptions device = deviceFor(scan, 1e-6);
  device.electrode_area = 1e-9;
  device.electrode_gap = 1.5e-6;  // 0.5 um is left when closed
  Options options = insulated();
  const double bare = sweepLoads(options, scan, upTo(0.0, 1), device, {}, {}).pull_in_voltage;
  options.load.contact_potential = -2.0;
  const LoadSweepResult result = sweepLoads(options, scan, upTo(10.0, 2), device, {}, {});
  EXPECT_DOUBLE_EQ(result.pull_in_voltage, bare - 2.0);
  for (const double voltage : {0.0, 10.0}) {
    const LoadSweepRow& row = result.rows[voltage > 0.0 ? 1 : 0];
    options.load.voltage = voltage;
    const double mean_gap = AdhesionModel(options).predict(scan).mean_gap;
    const double field = 1e-9 * surface_forces::electrostaticPressure(0.5e-6 + mean_gap,
                                                                      voltage + 2.0, 50 * kNm, 3.9);
    EXPECT_NEAR(row.holding_margin, 1e-6 / (row.pull_off_force + field), 1e-9 * row.holding_margin);
  }
}

TEST(LoadSweep, takesACounterSurface) {
  const HeightMap scan = rough();
  const HeightMap plane = analytic::flat(256, 256, scan.pitchX(), scan.pitchY(), 1e-6);
  const LoadSweepResult flat =
      sweepLoads(insulated(), scan, upTo(20.0, 2), DeviceOptions(), {}, {});
  const LoadSweepResult measured =
      sweepLoads(insulated(), {scan, plane}, upTo(20.0, 2), DeviceOptions(), {}, {});
  // the same surfaces on another level: gaps differ by the round-off of heights of 1 um
  EXPECT_NEAR(measured.rows[1].pull_off_force, flat.rows[1].pull_off_force,
              1e-3 * flat.rows[1].pull_off_force);
}

TEST(LoadSweep, reportsProgressAndStopsWhenToldTo) {
  std::atomic<bool> cancel{false};
  std::vector<int> done;
  RunControl control;
  control.cancel = &cancel;
  control.progress = [&](int now, int total) {
    EXPECT_EQ(total, 9);
    done.push_back(now);
    if (now == 4) cancel = true;
  };
  const LoadSweepResult result =
      sweepLoads(insulated(), sphere(), upTo(20.0, 5), DeviceOptions(), {}, control);
  EXPECT_FALSE(result.is_complete);
  EXPECT_EQ(result.rows.size(), 4u);
  EXPECT_TRUE(result.summaries.empty());
  EXPECT_EQ(done, (std::vector<int>{1, 2, 3, 4}));
}

TEST(LoadSweep, refusesARequestOutOfRangeBeforeAnyWork) {
  const auto violations = [](std::vector<double> voltages, std::vector<double> loads,
                             const Options& options) {
    LoadSweepRequest request;
    request.voltages = std::move(voltages);
    request.mechanical_loads = std::move(loads);
    try {
      sweepLoads(options, sphere(), request, DeviceOptions(), {}, {});
    } catch (const OptionsError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(violations({}, {0.0}, insulated()).find("voltages: an empty list"), std::string::npos);
  EXPECT_NE(violations({0.0, 5.0, 5.0}, {0.0}, insulated()).find("must ascend"), std::string::npos);
  EXPECT_NE(violations({-1.0}, {0.0}, insulated()).find("voltages: -1 V"), std::string::npos);
  const std::string of_many = violations(std::vector<double>(1000000, 5.0), {0.0}, insulated());
  EXPECT_EQ(of_many,
            "voltages: 5 V after 5 V is not allowed, must ascend (and 999998 more such values)");
  EXPECT_LT(violations(std::vector<double>(1000000, -5.0), {0.0}, insulated()).size(), 200U);
  EXPECT_NE(violations({0.0}, {std::nan("")}, insulated()).find("mechanical_loads: nan"),
            std::string::npos);
  EXPECT_NE(violations({2000.0}, {0.0}, insulated()).find("load/voltage: 2000"), std::string::npos);
  EXPECT_NE(violations({5.0}, {0.0}, paperOptions()).find("interface/insulator_thickness"),
            std::string::npos);
}

TEST(LoadSweep, RefusesGridsWhoseRowsNoIntegerCounts) {
  LoadSweepRequest request;
  for (int i = 0; i < 100000; ++i) {
    request.voltages.push_back(1e-6 * i);
    request.mechanical_loads.push_back(1e-12 * i);
  }
  const std::vector<std::string> violations = request.validate(Options());
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_NE(violations[0].find("1e+10 pairs are not allowed"), std::string::npos) << violations[0];
}

TEST(SweepTable, tellsVoltagesThatReleaseFromThoseThatSurelyDo) {
  LoadSweepResult sweep;
  LoadSweepRow row;
  row.margin = 2.0;
  row.direction = SweepDirection::kDown;
  sweep.rows = {row};
  LoadSweepSummary summary;
  summary.highest_releasing_voltage = 20.0;
  summary.highest_safe_voltage = 10.0;
  summary.opening_voltage = 5.0;
  sweep.summaries = {summary};
  const std::string text = sweepTable(sweep, "");
  EXPECT_NE(
      text.find("releases after voltages up to 20 V, surely (95 %) after voltages up to 10 V; "
                "opens on the way down at 5 V."),
      std::string::npos)
      << text;
}

}  // namespace
}  // namespace mems_stiction
