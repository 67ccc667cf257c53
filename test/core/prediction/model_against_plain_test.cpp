/// The fast path against the plain one: relabelled frames, loads summed cell by cell.

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/plain_adhesion_model.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

constexpr double kSame = 1e-9;       // relative: sums in another order
constexpr double kSameLoads = 1e-3;  // relative: histogram against cells
constexpr double kNm = 1e-9;

struct Setting {
  Connectivity connectivity = Connectivity::kFour;
  std::string formulation = "paper";
  Deformation deformation = Deformation::kThreeRegimes;
  double hardness = 12e9;
  double load = 1e-6;
};

Options optionsOf(const Setting& setting) {
  Options options;
  options.approach.connectivity = setting.connectivity;
  options.formulation = setting.formulation;
  options.deformation = setting.deformation;
  options.lower.hardness = setting.hardness;
  options.load.mechanical_load = setting.load;
  options.interface.insulator_thickness = 50 * kNm;
  return options;
}

std::vector<Setting> settings() {
  std::vector<Setting> all;
  for (const Connectivity connectivity : {Connectivity::kFour, Connectivity::kEight}) {
    for (const char* formulation : {"paper", "printed"}) {
      for (const Deformation deformation : {Deformation::kThreeRegimes, Deformation::kElastic}) {
        for (const double hardness : {12e9, 4e9, 0.5e9}) {
          all.push_back(
              {connectivity, formulation, deformation, hardness, hardness > 1e9 ? 1e-6 : 0.0});
        }
      }
    }
  }
  return all;
}

/// Patches in the order of their place, since both paths number them their own way.
std::vector<Asperity> ordered(std::vector<Asperity> asperities) {
  std::sort(asperities.begin(), asperities.end(), [](const Asperity& a, const Asperity& b) {
    if (a.y != b.y) return a.y < b.y;
    return a.x != b.x ? a.x < b.x : a.area < b.area;
  });
  return asperities;
}

/// @param load_tolerance of everything that the loads enter: exact without van der Waals and
/// voltage.
void expectSame(const Prediction& fast, const Prediction& plain, double load_tolerance) {
  const auto same = [](double value, double expected, double tolerance, const char* name) {
    if (std::isnan(expected) || std::isinf(expected)) {
      EXPECT_EQ(std::isnan(value), std::isnan(expected)) << name;
      return;
    }
    EXPECT_NEAR(value, expected, tolerance * std::abs(expected) + 1e-30) << name;
  };
  EXPECT_EQ(fast.status, plain.status);
  EXPECT_EQ(fast.steps, plain.steps);
  ASSERT_EQ(fast.asperity_count, plain.asperity_count);
  EXPECT_EQ(fast.elastic_count, plain.elastic_count);
  EXPECT_EQ(fast.elasto_plastic_count, plain.elasto_plastic_count);
  EXPECT_EQ(fast.plastic_count, plain.plastic_count);
  same(fast.approach, plain.approach, kSame, "approach");
  same(fast.contact_area, plain.contact_area, kSame, "contact_area");
  same(fast.contact_fraction, plain.contact_fraction, kSame, "contact_fraction");
  same(fast.nominal_area, plain.nominal_area, kSame, "nominal_area");
  same(fast.mean_gap, plain.mean_gap, 1e-7, "mean_gap");  // the small rest of two sums
  same(fast.invalid_fraction, plain.invalid_fraction, kSame, "invalid_fraction");
  same(fast.composite_rms_height, plain.composite_rms_height, kSame, "composite_rms_height");
  same(fast.pull_off_force_jkr, plain.pull_off_force_jkr, kSame, "pull_off_force_jkr");
  same(fast.pull_off_force_transition, plain.pull_off_force_transition, kSame,
       "pull_off_force_transition");
  same(fast.adhesion_parameter, plain.adhesion_parameter, kSame, "adhesion_parameter");
  same(fast.surface_energy, plain.surface_energy, kSame, "surface_energy");
  same(fast.plastic_work, plain.plastic_work, kSame, "plastic_work");
  EXPECT_NEAR(fast.max_tilt, plain.max_tilt,
              1e-9);  // rad; level patches have the tilt of round-off
  same(fast.van_der_waals_force, plain.van_der_waals_force, kSameLoads, "van_der_waals_force");
  same(fast.electrostatic_force, plain.electrostatic_force, kSameLoads, "electrostatic_force");
  same(fast.normal_load, plain.normal_load, load_tolerance, "normal_load");
  same(fast.pull_off_force, plain.pull_off_force, load_tolerance, "pull_off_force");
  same(fast.contact_area_jkr, plain.contact_area_jkr, load_tolerance, "contact_area_jkr");
  // energies go with the square of the load
  same(fast.mechanical_energy, plain.mechanical_energy, 2 * load_tolerance, "mechanical_energy");
  same(fast.elastic_energy, plain.elastic_energy, 2 * load_tolerance, "elastic_energy");

  const std::vector<Asperity> found = ordered(fast.asperities);
  const std::vector<Asperity> expected = ordered(plain.asperities);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    same(found[i].x, expected[i].x, kSame, "x");
    same(found[i].y, expected[i].y, kSame, "y");
    same(found[i].area, expected[i].area, kSame, "area");
    same(found[i].cap_radius, expected[i].cap_radius, kSame, "cap_radius");
    same(found[i].composite_radius, expected[i].composite_radius, kSame, "composite_radius");
    same(found[i].plasticity_index, expected[i].plasticity_index, kSame, "plasticity_index");
    same(found[i].tabor_parameter, expected[i].tabor_parameter, kSame, "tabor_parameter");
    same(found[i].load, expected[i].load, load_tolerance, "load");
    EXPECT_EQ(found[i].regime, expected[i].regime);
  }
}

class ModelAgainstPlain : public testing::TestWithParam<samples::Frame> {
 protected:
  static Prediction predictFast(const Options& options) {
    return AdhesionModel(options).predict(GetParam());
  }
  static Prediction predictPlain(const Options& options) {
    return plain::predict(options, GetParam());
  }
};

INSTANTIATE_TEST_SUITE_P(Frames, ModelAgainstPlain, testing::ValuesIn(samples::allFrames()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(ModelAgainstPlain, isTheSameInEverySetting) {
  for (const Setting& setting : settings()) {
    Options options = optionsOf(setting);
    options.interface.hamaker_constant = 0.0;  // the load is then the same to the last digits
    expectSame(predictFast(options), predictPlain(options), kSame);
    if (HasFailure()) FAIL() << "hardness " << setting.hardness;
  }
}

TEST_P(ModelAgainstPlain, isTheSameUnderAttraction) {
  for (const double voltage : {0.0, 8.0}) {
    Setting setting;
    Options options = optionsOf(setting);
    options.load.voltage = voltage;
    options.load.contact_potential = 0.25 * voltage;
    expectSame(predictFast(options), predictPlain(options), kSameLoads);
  }
}

TEST_P(ModelAgainstPlain, isTheSameWhereTheSearchEndsEarly) {
  Options options = optionsOf(Setting());
  options.interface.hamaker_constant = 0.0;
  options.load.mechanical_load = 1e-3;
  options.approach.max_contact_fraction = 0.2;
  expectSame(predictFast(options), predictPlain(options), kSame);
  options.approach.max_steps = 7;
  expectSame(predictFast(options), predictPlain(options), kSame);
}

/// A ring whose inside comes into contact after it, all in one step. The search tries the step's
/// end first, where the middle is part of the patch, and goes back to levels where the same box has
/// another centre.
TEST(RingAgainstPlain, isTheSameWhereTheSearchGoesBack) {
  constexpr int kSize = 7;
  cv::Mat1d heights(15, 15, 0.0);
  for (int row = 0; row < kSize; ++row) {
    for (int col = 0; col < kSize; ++col) {
      const int to_edge = std::min(std::min(row, kSize - 1 - row), std::min(col, kSize - 1 - col));
      heights(row + 3, col + 5) = (20.0 - 0.02 * to_edge) * kNm;
    }
  }
  const HeightMap surface(heights, 10 * kNm, 10 * kNm);
  bool has_ended_in_a_ring = false;
  for (double load = 1e-9; load < 1e-4; load *= 2.0) {
    Setting setting;
    setting.load = load;
    Options options = optionsOf(setting);
    options.interface.hamaker_constant = 0.0;
    options.interface.work_of_adhesion = 1e-4;
    options.deformation = Deformation::kElastic;  // so steep a ring would flow, and nothing stop
                                                  // the search within a step
    const Prediction fast = AdhesionModel(options).predict(surface);
    expectSame(fast, plain::predict(options, surface), kSame);
    if (HasFailure()) FAIL() << "load " << load;
    const double cells = fast.contact_area / surface.pitchX() / surface.pitchY();
    has_ended_in_a_ring |= fast.steps == 1 && std::abs(cells - 4.0 * (kSize - 1)) < 0.5;
  }
  EXPECT_TRUE(has_ended_in_a_ring);
}

}  // namespace
}  // namespace mems_stiction
