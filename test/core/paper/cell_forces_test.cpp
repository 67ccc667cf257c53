#include "paper/cell_forces.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/plain_adhesion_model.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

// Promised: 1e-3. The Taylor series of a bucket an eighth of its gap wide leaves out terms of
// (1/8)^4: about 1e-4.
constexpr double kSumTolerance = 2e-4;
constexpr double kClosedForm = 1e-12;  // a few operations of round-off
constexpr double kNm = 1e-9;
constexpr double kCutoffDistance = 0.165e-9;

InterfaceOptions insulated() {
  InterfaceOptions interface;
  interface.hamaker_constant = 6.5e-20;
  interface.insulator_thickness = 100 * kNm;
  interface.insulator_relative_permittivity = 3.9;
  return interface;
}

HeightMap withPixel(const HeightMap& surface, double height) {
  cv::Mat1d heights = surface.heights().clone();
  heights(heights.rows / 3, heights.cols / 4) = height;
  return {heights, surface.pitchX(), surface.pitchY()};
}

std::vector<samples::Frame> loadedFrames() {
  std::vector<samples::Frame> frames = samples::allFrames();
  const HeightMap rough = samples::gaussian(256, 255, 10 * kNm, 10 * kNm, 3 * kNm, 60 * kNm, 1);
  const HeightMap rougher = samples::gaussian(300, 200, 10 * kNm, 10 * kNm, 60 * kNm, 60 * kNm, 2);
  frames.push_back({"large", rough, {}});
  frames.push_back({"very_rough", rougher, {}});
  frames.push_back(
      {"very_smooth", samples::gaussian(256, 256, 10 * kNm, 10 * kNm, 0.1 * kNm, 60 * kNm, 3), {}});
  frames.push_back({"tall_spike", withPixel(rough, 5e-6), {}});
  frames.push_back({"spike_above_gaps", withPixel(rough, 30 * kNm), {}});
  frames.push_back({"deep_pit", withPixel(rough, -5e-6), {}});
  frames.push_back(
      {"tilted",
       analytic::sum(rough, analytic::tiltedPlane(256, 255, 10 * kNm, 10 * kNm, 0.1, 0.2)),
       {}});
  frames.push_back({"two_by_two", samples::whiteNoise(2, 2, 10 * kNm, 10 * kNm, 3 * kNm, 4), {}});
  frames.push_back({"sphere", analytic::paraboloid(301, 300, 5 * kNm, 5 * kNm, 2e-6), {}});
  return frames;
}

class LoadedFrame : public testing::TestWithParam<samples::Frame> {
 protected:
  void SetUp() override { field_ = GetParam().gapField(); }

  void expectSumsOverCells(const CellForces& forces, double max_contact_fraction) {
    GapOrder order;
    order.build(field_, max_contact_fraction);
    GapLoads loads;
    loads.prepare(order);
    const double limit_gap = order.cells()[static_cast<std::size_t>(order.contactLimit() - 1)].gap;
    constexpr int kApproaches = 25;
    for (int k = 0; k <= kApproaches; ++k) {
      const double approach = limit_gap * k / kApproaches;
      expectSum(loads.at(approach, order.sortBelow(approach), forces, 3e-7),
                plain::sumLoads(field_, approach, plain::Touch::kBelow, forces, 3e-7), approach);
    }
    expectSum(loads.at(limit_gap, order.contactLimit(), forces, 3e-7),
              plain::sumLoads(field_, limit_gap, plain::Touch::kUpTo, forces, 3e-7), limit_gap);
  }

 private:
  static void expectSum(const NormalLoad& load, const NormalLoad& expected, double approach) {
    EXPECT_NEAR(load.van_der_waals, expected.van_der_waals, kSumTolerance * expected.van_der_waals)
        << approach;
    EXPECT_NEAR(load.electrostatic, expected.electrostatic, kSumTolerance * expected.electrostatic)
        << approach;
    EXPECT_EQ(load.mechanical, expected.mechanical);
    EXPECT_EQ(load.total(), load.van_der_waals + load.electrostatic + load.mechanical);
  }

 protected:
  GapField field_;
};

INSTANTIATE_TEST_SUITE_P(Frames, LoadedFrame, testing::ValuesIn(loadedFrames()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(LoadedFrame, hasTheSumOverItsCellsAtEveryApproach) {
  for (const double fraction : {0.02, 0.5, 1.0}) {
    expectSumsOverCells(CellForces(insulated(), kCutoffDistance, 40.0, field_.cellArea()),
                        fraction);
  }
}

TEST_P(LoadedFrame, hasTheSumOverItsCellsWhateverTheCutOff) {
  InterfaceOptions interface = insulated();
  for (const double cutoff : {1e-12, 1e-10, 2e-9, 5e-8, 1e-5}) {
    expectSumsOverCells(CellForces(interface, cutoff, 0.0, field_.cellArea()), 0.5);
  }
}

TEST_P(LoadedFrame, hasTheFieldOfAThinInsulatorToo) {
  InterfaceOptions interface = insulated();
  for (const double thickness : {1e-10, 2e-9}) {
    interface.insulator_thickness = thickness;
    expectSumsOverCells(CellForces(interface, kCutoffDistance, -5.0, field_.cellArea()), 0.5);
  }
}

TEST(CellForces, ofSeveralCellsAtOnceAreThoseOfOneAfterTheOther) {
  // factors of one, so that it does not matter to the bit whether they are multiplied before or
  // after the sum
  InterfaceOptions interface = insulated();
  interface.hamaker_constant = 6.0 * kPi;
  const CellForces van_der_waals(interface, 0.3, 0.0, 1.0);
  const CellForces electrostatic(interface, 0.3, 1.0, 2.0 / kVacuumPermittivity);
  ASSERT_EQ(van_der_waals.vanDerWaals(1.0), 1.0);
  constexpr double kApproach = 0.7;
  std::vector<OrderedCell> cells;
  NormalLoad expected;
  for (int count = 0; count < 8; ++count) {  // of more the sums run in another order
    NormalLoad load;
    van_der_waals.addCells(cells.data(), cells.size(), kApproach, load);
    EXPECT_EQ(load.van_der_waals, expected.van_der_waals) << count << " cells";
    EXPECT_EQ(load.electrostatic, 0.0);
    NormalLoad field_load;
    electrostatic.addCells(cells.data(), cells.size(), kApproach, field_load);
    EXPECT_DOUBLE_EQ(field_load.electrostatic, expected.electrostatic) << count << " cells";
    const double gap = kApproach + 0.11 * (count + 1);  // two of them below the cut-off
    cells.push_back({gap, count, {}});
    expected.van_der_waals += van_der_waals.vanDerWaals(gap - kApproach);
    expected.electrostatic += electrostatic.electrostatic(gap - kApproach);
  }
}

TEST(CellForces, stayFiniteBelowTheCutOff) {
  const CellForces forces(insulated(), kCutoffDistance, 0.0, 1e-16);
  EXPECT_EQ(forces.vanDerWaals(0.0), forces.vanDerWaals(forces.cutoff()));
  EXPECT_EQ(forces.vanDerWaals(0.5 * forces.cutoff()), forces.vanDerWaals(forces.cutoff()));
  EXPECT_LT(forces.vanDerWaals(1.1 * forces.cutoff()), forces.vanDerWaals(forces.cutoff()));
}

TEST(CellForces, takeTheInsulatorToTheLetterWithPermittivityOne) {
  InterfaceOptions interface = insulated();
  interface.insulator_relative_permittivity = 1.0;
  const double distance = 110 * kNm;  // d + t of (3)
  const double expected = kVacuumPermittivity * 1e-16 * 100.0 / (2 * distance * distance);
  EXPECT_NEAR(CellForces(interface, kCutoffDistance, 10.0, 1e-16).electrostatic(10 * kNm), expected,
              kClosedForm * expected);
}

TEST(FlatWithBump, isHeldApartByItAndPulledByTheRest) {
  const double pitch = 10 * kNm;
  const double height = 2 * kNm;
  const HeightMap surface = analytic::flatWithBump(61, 61, pitch, pitch, height);
  GapField field;
  field.compute(surface);
  GapOrder order;
  order.build(field, 0.5);
  GapLoads loads;
  loads.prepare(order);
  const CellForces forces(insulated(), kCutoffDistance, 3.0, field.cellArea());
  const double area = (61 * 61 - 1) * pitch * pitch;
  const double bump_area = pitch * pitch;
  const double insulator = 100e-9 / 3.9;
  for (const double approach : {0.0, 0.1 * height}) {
    const NormalLoad load = loads.at(approach, 1, forces, 0.0);
    const double gap = height - approach;
    const double van_der_waals = 6.5e-20 * area / (6 * kPi * gap * gap * gap);
    const double field_force = 0.5 * kVacuumPermittivity * 9.0;
    const double electrostatic = field_force * area / ((gap + insulator) * (gap + insulator)) +
                                 field_force * bump_area / (insulator * insulator);
    EXPECT_NEAR(load.van_der_waals, van_der_waals, 1e-9 * van_der_waals);
    EXPECT_NEAR(load.electrostatic, electrostatic, 1e-9 * electrostatic);
  }
}

}  // namespace
}  // namespace mems_stiction
