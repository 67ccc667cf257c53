/// The half-space against closed forms of whole surfaces, in SI, and what it says when there is no
/// solution.

#include <atomic>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "errors/short_number.hpp"
#include "mechanics/wave_stiffness.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/half_space/half_space_solver.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/half_space_cases.hpp"

namespace mems_stiction {
namespace {

constexpr double kModulus = 88.8e9;
constexpr double kRange = 1.608e-10;

HalfSpaceProblem problemOf(const HeightMap& lower, double contact_modulus = kModulus) {
  return half_space_cases::onRigidPlane(lower, contact_modulus);
}

HalfSpaceOptions elastic() { return half_space_cases::elastic(kRange); }

SolvedHalfSpace solve(const HalfSpaceProblem& problem,
                      const HalfSpaceOptions& options = elastic()) {
  return HalfSpaceSolver(options).solve(problem);
}

/// Cosines of a few waves: a rough surface that is a formula.
HeightMap waves(int rows, int cols, double pitch_x, double pitch_y, double amplitude) {
  cv::Mat heights(rows, cols, CV_64FC1);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const double x = 2.0 * kPi * col / cols;
      const double y = 2.0 * kPi * row / rows;
      heights.at<double>(row, col) =
          amplitude * (std::cos(x + 0.3) + std::cos(y) + 0.5 * std::cos(2.0 * x - y) +
                       0.4 * std::cos(3.0 * y + 2.0 * x));
    }
  }
  return HeightMap(heights, pitch_x, pitch_y);
}

TEST(HalfSpaceSolver, FlatOnFlatIsTheLawItself) {
  const HeightMap flat = analytic::flat(12, 15, 2e-9, 3e-9);
  const SolvedHalfSpace solution = solve(problemOf(flat));
  ASSERT_EQ(solution.status, HalfSpaceStatus::kSolved) << solution.message;
  const double area = 12 * 15 * 6e-18;
  // the parabola between steps of 0.2 z0
  EXPECT_NEAR(solution.pull_off_force / (16.0 * 0.05 / (9.0 * std::sqrt(3.0) * kRange) * area), 1.0,
              5e-3);
  // rest lies within a thousandth of the largest force of z0, the work is quadratic there
  EXPECT_NEAR(solution.work_of_adhesion / 0.05, 1.0, 1e-4);
  EXPECT_NEAR(solution.rest_height / kRange, 1.0, 1e-3);
  EXPECT_NEAR(solution.hysteresis, 0.0, 1e-10);
  EXPECT_EQ(solution.jumps, 0);
}

/// Amplitude of one wave along x in the second row of a map.
double waveAmplitude(const cv::Mat& map) {
  double sum = 0.0;
  for (int col = 0; col < map.cols; ++col) {
    sum += 2.0 / map.cols * static_cast<double>(map.at<float>(1, col)) *
           std::sin(2.0 * kPi * col / map.cols);
  }
  return std::abs(sum);
}

TEST(HalfSpaceSolver, AWaveInFullContactNeedsItsStiffnessTimesItsAmplitude) {
  const int cols = 32;
  const double pitch = 8e-9;
  const double amplitude = 0.5 * kRange;
  const double q = 2.0 * kPi / (cols * pitch);
  HalfSpaceOptions options = elastic();
  options.tolerance = 1e-6;
  HalfSpaceProblem problem = problemOf(analytic::sine(2, cols, pitch, pitch, amplitude, 1));
  problem.lower_material.poisson_ratio = 0.3;
  for (const auto& [backing, substrate] :
       {std::pair(Backing::kFree, 0.0), std::pair(Backing::kBonded, 0.0),
        std::pair(Backing::kBonded, 10e9)}) {
    for (const double s : {0.05, 0.4, 1.5, 6.0, 100.0}) {
      problem.lower_material.thickness = s / q;
      problem.lower_material.backing = backing;
      problem.lower_material.substrate.youngs_modulus = substrate;
      const double stiffness = WaveStiffness(problem.lower_material, problem.upper_material).at(q);
      problem.interface.work_of_adhesion =
          12.5 * stiffness * kRange * kRange;  // contacts 200 times as stiff as the wave
      const SolvedHalfSpace solution = solve(problem, options);
      ASSERT_EQ(solution.status, HalfSpaceStatus::kSolved) << solution.message;
      const double of_gap = waveAmplitude(solution.gap);
      EXPECT_LT(of_gap, 0.01 * amplitude) << s;
      EXPECT_NEAR(waveAmplitude(solution.pressure) / (stiffness * (amplitude - of_gap)), 1.0, 1e-3)
          << s;
    }
  }
}

TEST(HalfSpaceSolver, ThickBodiesAreHalfSpacesToTheBit) {
  const HalfSpaceProblem half_space = problemOf(waves(24, 30, 5e-9, 5e-9, 0.4e-9));
  const SolvedHalfSpace before = solve(half_space);
  for (const Backing backing : {Backing::kFree, Backing::kBonded}) {
    HalfSpaceProblem problem = half_space;
    problem.lower_material.thickness = problem.upper_material.thickness = 1e-3;
    problem.lower_material.backing = problem.upper_material.backing = backing;
    const SolvedHalfSpace thick = solve(problem);
    EXPECT_EQ(thick.pull_off_force, before.pull_off_force);
    EXPECT_EQ(thick.work_of_adhesion, before.work_of_adhesion);
    EXPECT_EQ(thick.newton_steps, before.newton_steps);
  }
}

TEST(HalfSpaceSolver, ThinPlatesConformMoreAndFilmsOnSomethingStiffLess) {
  HalfSpaceProblem problem = problemOf(waves(48, 60, 5e-9, 5e-9, 0.4e-9));
  problem.load.mechanical_load = 5e-7;
  const SolvedHalfSpace half_space = solve(problem);
  problem.lower_material.thickness = 40e-9;
  const SolvedHalfSpace plate = solve(problem);
  EXPECT_GT(plate.pull_off_force, 1.05 * half_space.pull_off_force);
  EXPECT_GT(plate.contact_area, 1.1 * half_space.contact_area);
  problem.lower_material.backing = Backing::kBonded;
  problem.lower_material.thickness = 5e-9;
  const SolvedHalfSpace film = solve(problem);
  EXPECT_LT(film.contact_area, 0.9 * half_space.contact_area);
  problem.lower_material.substrate.youngs_modulus = 0.1 * kModulus;
  EXPECT_GT(solve(problem).contact_area, 1.1 * half_space.contact_area);
}

TEST(HalfSpaceSolver, AFilmWithFreeEdgesIsSofterThanItsSubstrateAlone) {
  HalfSpaceOptions options = elastic();
  options.boundary = HalfSpaceBoundary::kFree;
  const HeightMap sphere = analytic::paraboloid(41, 41, 2e-9, 2e-9, 300e-9);
  HalfSpaceProblem problem = problemOf(sphere);
  problem.load.mechanical_load = 2e-7;
  const double stiff = solve(problem, options).contact_area;
  problem.lower_material.youngs_modulus = 20e9;
  const double soft = solve(problem, options).contact_area;
  problem.lower_material.backing = Backing::kBonded;
  problem.lower_material.thickness = 10e-9;
  problem.lower_material.substrate = {kModulus, 0.0};
  const double coated = solve(problem, options).contact_area;
  EXPECT_GT(coated, 1.1 * stiff);
  EXPECT_LT(coated, soft / 1.1);
}

TEST(HalfSpaceSolver, RefusesWhatFreeEdgesCannotHaveBehindThem) {
  HalfSpaceOptions options = elastic();
  options.boundary = HalfSpaceBoundary::kFree;
  HalfSpaceProblem problem = problemOf(analytic::flat(12, 15, 2e-9, 3e-9));
  const auto refusal = [&]() -> std::string {
    try {
      solve(problem, options);
    } catch (const OptionsError& error) {
      return error.what();
    }
    return "";
  };
  problem.upper_material.thickness = 2e-6;
  EXPECT_EQ(
      refusal(),
      "upper/thickness: 2e-06 m with half_space/boundary free and upper/backing free is not "
      "allowed: how far a plate "
      "bends under a contact depends on where it is held; must be 0 m, or the boundary periodic");
  problem.upper_material.backing = Backing::kBonded;
  EXPECT_EQ(refusal(), "");
  problem.upper_material.thickness = 0.2e-9;
  EXPECT_NE(refusal().find(
                "upper/thickness: 2e-10 m with half_space/boundary free is not allowed: too thin"),
            std::string::npos)
      << refusal();
  options.boundary = HalfSpaceBoundary::kPeriodic;
  EXPECT_EQ(refusal(), "");
  problem.lower_material.substrate.youngs_modulus = 1e9;
  EXPECT_NE(refusal().find("lower/substrate/youngs_modulus: 1e+09 Pa with lower/backing free"),
            std::string::npos);
}

TEST(HalfSpaceSolver, ForcesScaleWithModulusAndAdhesionTogether) {
  const HeightMap lower = waves(24, 30, 5e-9, 5e-9, 0.4e-9);
  const SolvedHalfSpace one = solve(problemOf(lower));
  HalfSpaceProblem problem = problemOf(lower, 1e-3 * kModulus);
  problem.interface.work_of_adhesion *= 1e-3;
  const SolvedHalfSpace thousandth = solve(problem);
  ASSERT_EQ(one.status, HalfSpaceStatus::kSolved);
  EXPECT_NEAR(thousandth.pull_off_force / (1e-3 * one.pull_off_force), 1.0, 1e-3);
  EXPECT_NEAR(thousandth.work_of_adhesion / (1e-3 * one.work_of_adhesion), 1.0, 1e-3);
  EXPECT_EQ(thousandth.contact_area, one.contact_area);
}

TEST(HalfSpaceSolver, ForcesScaleWithTheSizeOfEverything) {
  const SolvedHalfSpace one = solve(problemOf(waves(24, 30, 5e-9, 5e-9, 0.4e-9)));
  const double scale = 1e4;
  HalfSpaceProblem problem = problemOf(waves(24, 30, 5e-9 * scale, 5e-9 * scale, 0.4e-9 * scale));
  problem.interface.work_of_adhesion *= scale;
  HalfSpaceOptions options = elastic();
  options.range *= scale;
  const SolvedHalfSpace large = solve(problem, options);
  EXPECT_NEAR(large.pull_off_force / (scale * scale * one.pull_off_force), 1.0, 1e-3);
  EXPECT_NEAR(large.work_of_adhesion / (scale * one.work_of_adhesion), 1.0, 1e-3);
  EXPECT_NEAR(large.mean_gap / (scale * one.mean_gap), 1.0, 1e-3);
}

TEST(HalfSpaceSolver, PitchAndSizeDescribeTheSameSurface) {
  // one surface on 60 x 45 pixels and on 40 x 90
  const SolvedHalfSpace one = solve(problemOf(waves(60, 45, 4e-9, 3e-9, 0.4e-9)));
  const SolvedHalfSpace other = solve(problemOf(waves(40, 90, 2e-9, 4.5e-9, 0.4e-9)));
  ASSERT_EQ(one.status, HalfSpaceStatus::kSolved);
  // summits fall on other places of the grid, by up to 2 % of z0
  EXPECT_NEAR(one.pull_off_force / other.pull_off_force, 1.0, 0.02);
  EXPECT_NEAR(one.work_of_adhesion / other.work_of_adhesion, 1.0, 0.02);
}

TEST(HalfSpaceSolver, PrimeSizesAreSolvedToo) {
  const SolvedHalfSpace prime = solve(problemOf(waves(31, 37, 4e-9, 4e-9, 0.4e-9)));
  const SolvedHalfSpace even = solve(problemOf(waves(62, 74, 2e-9, 2e-9, 0.4e-9)));
  ASSERT_EQ(prime.status, HalfSpaceStatus::kSolved);
  EXPECT_NEAR(prime.pull_off_force / even.pull_off_force, 1.0, 0.02);  // as above
}

TEST(HalfSpaceSolver, AnyNumberOfColumnsTakesAsFewProducts) {
  // a soft sphere that jumps; rows of 68 pixels end within a vector of eight, rows of 72 do not
  const SolvedHalfSpace one =
      solve(problemOf(analytic::paraboloid(68, 68, 5e-10, 5e-10, 50e-9, 15e-11, 1e-10), 2e9));
  const SolvedHalfSpace other =
      solve(problemOf(analytic::paraboloid(72, 72, 5e-10, 5e-10, 50e-9, 15e-11, 1e-10), 2e9));
  ASSERT_EQ(one.status, HalfSpaceStatus::kSolved) << one.message;
  ASSERT_EQ(other.status, HalfSpaceStatus::kSolved) << other.message;
  EXPECT_NEAR(one.pull_off_force / other.pull_off_force, 1.0,
              0.02);                              // the frame's edges lie elsewhere
  EXPECT_LT(one.products, 2.0 * other.products);  // as above
}

TEST(HalfSpaceSolver, TwoSurfacesAreTheirComposite) {
  const HeightMap lower = waves(24, 30, 5e-9, 5e-9, 0.4e-9);
  const HeightMap bump = analytic::flatWithBump(24, 30, 5e-9, 5e-9, 0.5e-9, 6);
  cv::Mat turned = -bump.heights();
  HalfSpaceProblem pair = problemOf(lower);
  pair.surfaces.upper = HeightMap(turned, 5e-9, 5e-9);
  const SolvedHalfSpace two = solve(pair);
  const SolvedHalfSpace one = solve(problemOf(analytic::sum(lower, bump)));
  ASSERT_EQ(two.status, HalfSpaceStatus::kSolved);
  EXPECT_NEAR(two.pull_off_force / one.pull_off_force, 1.0, 1e-9);  // heights differ by round-off
}

TEST(HalfSpaceSolver, FarEdgesDoNotMatterToASinglePeak) {
  const HeightMap sphere = analytic::paraboloid(64, 64, 1e-9, 1e-9, 30e-9);
  HalfSpaceOptions options = elastic();
  const SolvedHalfSpace periodic = solve(problemOf(sphere), options);
  options.boundary = HalfSpaceBoundary::kFree;
  const SolvedHalfSpace free = solve(problemOf(sphere), options);
  ASSERT_EQ(free.status, HalfSpaceStatus::kSolved) << free.message;
  EXPECT_NEAR(free.pull_off_force / periodic.pull_off_force, 1.0, 5e-3);
  EXPECT_EQ(free.contact_count, 1);
}

TEST(HalfSpaceSolver, InvalidPixelsNeverTouch) {
  const HeightMap flat = analytic::flat(6, 5, 1e-9, 1e-9);
  const SolvedHalfSpace whole = solve(problemOf(flat));
  const SolvedHalfSpace solution = solve(problemOf(analytic::withInvalidPixel(flat, 3, 2)));
  ASSERT_EQ(solution.status, HalfSpaceStatus::kSolved);
  EXPECT_TRUE(std::isnan(solution.gap.at<float>(3, 2)));
  EXPECT_TRUE(std::isnan(solution.pressure.at<float>(3, 2)));
  EXPECT_TRUE(std::isnan(solution.deformed_lower.height(3, 2)));
  // the others pull as before but for the few picometres by which the surface gives way around the
  // hole
  EXPECT_NEAR(solution.pull_off_force / whole.pull_off_force, 29.0 / 30.0, 0.01);
  // per area of what was measured
  EXPECT_NEAR(solution.work_of_adhesion / whole.work_of_adhesion, 1.0, 0.01);
}

TEST(HalfSpaceSolver, MechanicalLoadIsReachedAndLeavesElasticSurfacesAsTheyWere) {
  HalfSpaceProblem problem = problemOf(waves(32, 32, 5e-9, 5e-9, 1e-9));
  const SolvedHalfSpace unloaded = solve(problem);
  problem.load.mechanical_load = 2e-6;
  const SolvedHalfSpace loaded = solve(problem);
  ASSERT_EQ(loaded.status, HalfSpaceStatus::kSolved) << loaded.message;
  EXPECT_NEAR(loaded.rest_force / -2e-6, 1.0, 2e-3);
  EXPECT_GT(loaded.contact_area, unloaded.contact_area);
  EXPECT_NEAR(loaded.pull_off_force / unloaded.pull_off_force, 1.0,
              5e-3);  // other heights on the same curve
  EXPECT_NEAR(loaded.work_of_adhesion / unloaded.work_of_adhesion, 1.0, 5e-3);
  EXPECT_EQ(loaded.flowed_volume, 0.0);
}

TEST(HalfSpaceSolver, PressureBeyondTheHardnessChangesTheSurface) {
  HalfSpaceProblem problem = problemOf(analytic::paraboloid(48, 48, 1e-9, 1e-9, 60e-9));
  problem.lower_material.hardness = problem.upper_material.hardness = 2e9;
  problem.load.mechanical_load = 2e-7;
  HalfSpaceOptions options = elastic();
  const SolvedHalfSpace unharmed = solve(problem, options);
  options.flow = true;
  const SolvedHalfSpace flowed = solve(problem, options);
  ASSERT_EQ(flowed.status, HalfSpaceStatus::kSolved) << flowed.message;
  double highest = 0.0, lost = 0.0;
  for (int row = 0; row < 48; ++row) {
    for (int col = 0; col < 48; ++col) {
      highest = std::max(highest, static_cast<double>(flowed.pressure.at<float>(row, col)));
      lost += problem.surfaces.lower.height(row, col) - flowed.deformed_lower.height(row, col);
      lost += flowed.deformed_upper.height(row, col);
    }
  }
  EXPECT_NEAR(highest / 2e9, 1.0, 1e-6);  // a float
  EXPECT_NEAR(lost * 1e-18 / flowed.flowed_volume, 1.0, 1e-6);
  EXPECT_GT(flowed.flowed_volume, 0.0);
  EXPECT_GT(flowed.contact_area, unharmed.contact_area);
  // the flattened peak meets the upper surface with more of its area
  EXPECT_GT(flowed.pull_off_force, 1.1 * unharmed.pull_off_force);
  EXPECT_GT(flowed.hysteresis, 0.0);
}

TEST(HalfSpaceSolver, ASphereInFlowBesideFiniteElements) {
  // fits of Jackson and Green, Tribol. Int. 38 (2005) 906, to finite elements (recalled), for E/Sy
  // = 80 and 10 times the depth of first yield; the cap stands at the hardness 2.84 Sy of a shallow
  // dent
  const double radius = 200e-9;
  const double yield = kModulus / 80.0;
  const double c = 1.295 * std::exp(0.736 * 0.3);
  const double depth_of_yield = std::pow(kPi * c * yield / (2.0 * kModulus), 2.0) * radius;
  const double load_of_yield =
      4.0 / 3.0 * std::pow(radius / kModulus, 2.0) * std::pow(c * kPi * yield / 2.0, 3.0);
  const double area_of_yield =
      std::pow(kPi, 3.0) * std::pow(c * yield * radius / (2.0 * kModulus), 2.0);
  const double depth = 10.0;
  const double power = 0.14 * std::exp(23.0 / 80.0);
  const double area = area_of_yield * depth * std::pow(depth / 1.9, power);
  const double a_over_r = kPi * c / 160.0 * std::sqrt(depth) * std::pow(depth / 1.9, power / 2.0);
  const double hardness = 2.84 * (1.0 - std::exp(-0.82 * std::pow(a_over_r, -0.7)));
  const double load =
      load_of_yield *
      (std::exp(-0.25 * std::pow(depth, 5.0 / 12.0)) * std::pow(depth, 1.5) +
       4.0 * hardness / c * (1.0 - std::exp(-std::pow(depth, 5.0 / 9.0) / 25.0)) * depth);
  HalfSpaceProblem problem = problemOf(analytic::paraboloid(63, 63, 1e-9, 1e-9, radius));
  problem.lower_material.hardness = problem.upper_material.hardness = 2.84 * yield;
  problem.load.mechanical_load = load;
  HalfSpaceOptions options = elastic();
  options.attraction = false;
  options.range = 1e-11;  // a wall
  options.boundary = HalfSpaceBoundary::kFree;
  options.flow = true;
  options.step = 2.0;
  options.path = HalfSpacePath::kRest;
  const SolvedHalfSpace solved = solve(problem, options);
  ASSERT_EQ(solved.status, HalfSpaceStatus::kSolved) << solved.message;
  EXPECT_NEAR(-solved.rest_height / (depth * depth_of_yield), 1.0, 0.1);
  // their sphere bears less than 2.84 Sy as the contact grows against it, and spreads the further:
  // a cap knows neither
  EXPECT_NEAR(solved.contact_area / area, 0.76, 0.05);
  EXPECT_NEAR(load / solved.contact_area / (2.84 * yield), 0.94, 0.04);
}

TEST(HalfSpaceSolver, TheVoltageHasGoneBeforeTheBodiesAreDrawnApart) {
  HalfSpaceProblem problem = problemOf(waves(24, 24, 5e-9, 5e-9, 1e-9));
  problem.interface.insulator_thickness = 20e-9;
  const SolvedHalfSpace plain = solve(problem);
  EXPECT_EQ(plain.pull_off_force_under_voltage, plain.pull_off_force);
  for (const double load : {0.0, 1e-7}) {
    for (const double voltage : {20.0, 60.0}) {
      problem.load.mechanical_load = load;
      problem.load.voltage = voltage;
      const SolvedHalfSpace charged = solve(problem);
      ASSERT_EQ(charged.status, HalfSpaceStatus::kSolved) << charged.message;
      // elastic bodies forget what pressed them, but for the points of the path, which lie at other
      // heights
      EXPECT_NEAR(charged.pull_off_force / plain.pull_off_force, 1.0, 0.005) << voltage;
      EXPECT_NEAR(charged.work_of_adhesion / plain.work_of_adhesion, 1.0, 0.005) << voltage;
      EXPECT_NEAR(charged.hysteresis / plain.work_of_adhesion,
                  plain.hysteresis / plain.work_of_adhesion, 0.01);
      EXPECT_GT(charged.contact_area, plain.contact_area);
      EXPECT_NEAR(charged.retraction.front().height, charged.rest_height, 1e-15);
      EXPECT_LT(charged.retraction.front().force, -load);  // which now carries what the voltage was
      EXPECT_NEAR(charged.retraction.back().energy / charged.work_of_adhesion, 0.0, 1e-9);
    }
  }
}

TEST(HalfSpaceSolver, AContactPotentialStaysWhenTheVoltageHasGone) {
  HalfSpaceProblem problem = problemOf(waves(24, 24, 5e-9, 5e-9, 1e-9));
  problem.interface.insulator_thickness = 20e-9;
  problem.load.voltage = 20.0;
  const SolvedHalfSpace voltage = solve(problem);
  problem.load = {};
  problem.load.contact_potential = -20.0;
  const SolvedHalfSpace potential = solve(problem);
  ASSERT_EQ(potential.status, HalfSpaceStatus::kSolved) << potential.message;
  EXPECT_EQ(potential.rest_height, voltage.rest_height);
  EXPECT_EQ(potential.contact_area, voltage.contact_area);
  // by other states on the way
  EXPECT_NEAR(potential.pull_off_force / voltage.pull_off_force_under_voltage, 1.0, 1e-3);
  EXPECT_EQ(potential.pull_off_force_under_voltage, potential.pull_off_force);
  EXPECT_GT(potential.work_of_adhesion, voltage.work_of_adhesion);
  // with a voltage beside it the bodies part under the potential alone
  problem.load.voltage = 15.0;
  const SolvedHalfSpace both = solve(problem);
  EXPECT_GT(both.contact_area, potential.contact_area);
  EXPECT_NEAR(both.pull_off_force / potential.pull_off_force, 1.0, 0.005);
  EXPECT_NEAR(both.work_of_adhesion / potential.work_of_adhesion, 1.0, 0.005);
  EXPECT_GT(both.pull_off_force_under_voltage, both.pull_off_force);
}

TEST(HalfSpaceSolver, AVoltageThatStaysOnHoldsByItsField) {
  HalfSpaceProblem problem = problemOf(analytic::flat(12, 15, 2e-9, 3e-9));
  problem.interface.insulator_thickness = 20e-9;
  problem.load.voltage = 20.0;
  const SolvedHalfSpace solution = solve(problem);
  ASSERT_EQ(solution.status, HalfSpaceStatus::kSolved) << solution.message;
  const double area = 12 * 15 * 6e-18;
  // the field at the height of the largest force of two planes, where it hardly changes: 3^(1/6) z0
  const double gap =
      std::pow(3.0, 1.0 / 6.0) * kRange + 20e-9 / problem.interface.insulator_relative_permittivity;
  const double field = 0.5 * kVacuumPermittivity * 400.0 / (gap * gap) * area;
  EXPECT_NEAR(solution.pull_off_force_under_voltage - solution.pull_off_force, field,
              5e-3 * solution.pull_off_force);
}

TEST(HalfSpaceSolver, WhatFlowedUnderAVoltageStaysFlowed) {
  HalfSpaceProblem problem = problemOf(waves(24, 24, 5e-9, 5e-9, 1e-9));
  problem.interface.insulator_thickness = 10e-9;
  problem.lower_material.hardness = problem.upper_material.hardness = 3e9;
  HalfSpaceOptions flowing = elastic();
  flowing.flow = true;
  const SolvedHalfSpace plain = solve(problem, flowing);
  problem.load.voltage = 40.0;
  const SolvedHalfSpace charged = solve(problem, flowing);
  ASSERT_EQ(charged.status, HalfSpaceStatus::kSolved) << charged.message;
  EXPECT_GT(charged.flowed_volume, 1.5 * plain.flowed_volume);
  EXPECT_GT(charged.pull_off_force, 1.05 * plain.pull_off_force);
  EXPECT_GT(charged.pull_off_force_under_voltage, charged.pull_off_force);
}

TEST(HalfSpaceSolver, WaterPullsHarder) {
  HalfSpaceProblem problem = problemOf(waves(24, 24, 5e-9, 5e-9, 1e-9));
  const SolvedHalfSpace dry = solve(problem);
  problem.capillary.relative_humidity = 0.4;
  const SolvedHalfSpace wet = solve(problem);
  ASSERT_EQ(wet.status, HalfSpaceStatus::kSolved) << wet.message;
  EXPECT_GT(wet.pull_off_force, dry.pull_off_force);
}

TEST(HalfSpaceSolver, BitsDoNotDependOnTheThreads) {
  const HalfSpaceProblem problem = problemOf(waves(45, 50, 5e-9, 5e-9, 0.4e-9));
  HalfSpaceOptions options = elastic();
  const SolvedHalfSpace one = solve(problem, options);
  options.threads = 3;
  const SolvedHalfSpace three = solve(problem, options);
  ASSERT_EQ(one.retraction.size(), three.retraction.size());
  for (std::size_t i = 0; i < one.retraction.size(); ++i) {
    EXPECT_EQ(one.retraction[i].height, three.retraction[i].height);
    EXPECT_EQ(one.retraction[i].force, three.retraction[i].force);
  }
  EXPECT_EQ(one.pull_off_force, three.pull_off_force);
  EXPECT_EQ(cv::norm(one.gap, three.gap, cv::NORM_INF), 0.0);
}

TEST(HalfSpaceSolver, HalvingTheStepChangesThePullOffForceByLessThanTwoPercent) {
  // at 10 GPa this frame parts along one of two ways, whose forces differ by 5 %: round-off
  // chooses, not the step
  for (const double modulus : {20e9, 88.8e9}) {
    const HalfSpaceProblem problem = problemOf(waves(48, 48, 3e-9, 3e-9, 0.5e-9), modulus);
    HalfSpaceOptions options = elastic();
    const SolvedHalfSpace usual = solve(problem, options);
    options.step *= 0.5;
    const SolvedHalfSpace half = solve(problem, options);
    EXPECT_TRUE(usual.is_step_converged);
    EXPECT_NEAR(half.pull_off_force / usual.pull_off_force, 1.0, 0.02);
  }
}

TEST(HalfSpaceSolver, NoPointOfTheCurveExceedsTheStrengthOfTheLaw) {
  // brittle contacts whose curves jump many times; the strength of the law is 1.026 Gamma/z0
  for (const double amplitude : {0.05e-9, 0.1e-9, 0.2e-9, 0.4e-9}) {
    for (const double step : {0.2, 0.4}) {
      HalfSpaceProblem problem = problemOf(waves(40, 40, 1.5e-9, 1.5e-9, amplitude), 10e9);
      problem.interface.work_of_adhesion = 0.1;
      HalfSpaceOptions options = elastic();
      options.step = step;
      const SolvedHalfSpace solution = solve(problem, options);
      const double area = 40 * 40 * 1.5e-9 * 1.5e-9;
      const double strength = 1.0264 * problem.interface.work_of_adhesion / kRange * area;
      for (const ForcePoint& point : solution.retraction) EXPECT_LE(point.force, strength);
      EXPECT_LE(solution.pull_off_force, strength);
    }
  }
}

TEST(HalfSpaceSolver, UnresolvedCohesiveZonesAreSaid) {
  EXPECT_TRUE(solve(problemOf(waves(16, 16, 5e-9, 5e-9, 1e-9))).is_resolved);  // 46 nm
  EXPECT_FALSE(solve(problemOf(waves(16, 16, 30e-9, 5e-9, 1e-9))).is_resolved);
  // water pulls with 206 MPa over 0.7 nm: soft edges of contacts part over a few nanometres
  HalfSpaceProblem humid = problemOf(waves(16, 16, 2e-9, 2e-9, 1e-9), 1e9);
  humid.interface.work_of_adhesion = 0.01;
  EXPECT_TRUE(isResolved(humid, HalfSpaceOptions()));
  humid.capillary.relative_humidity = 0.22;
  EXPECT_FALSE(isResolved(humid, HalfSpaceOptions()));
}

TEST(HalfSpaceSolver, LoadBeyondTheHardnessIsNotReached) {
  HalfSpaceProblem problem = problemOf(waves(16, 16, 5e-9, 5e-9, 1e-9));
  problem.load.mechanical_load = 1.1 * 12e9 * 16 * 16 * 25e-18;
  HalfSpaceOptions options = elastic();
  options.flow = true;
  const SolvedHalfSpace solution = solve(problem, options);
  EXPECT_EQ(solution.status, HalfSpaceStatus::kLoadNotReached);
  EXPECT_NE(solution.message.find("load/mechanical_load"), std::string::npos);
  EXPECT_TRUE(std::isnan(solution.pull_off_force));
  EXPECT_TRUE(std::isnan(solution.contact_area));
  EXPECT_FALSE(solution.is_converged);
}

TEST(HalfSpaceSolver, LimitsOfTheSearchAreStatuses) {
  HalfSpaceOptions options = elastic();
  options.max_states = 10;
  const SolvedHalfSpace few = solve(problemOf(waves(16, 16, 5e-9, 5e-9, 1e-9)), options);
  EXPECT_EQ(few.status, HalfSpaceStatus::kTooManyStates);
  EXPECT_NE(few.message.find("half_space/max_states = 10"), std::string::npos);
  EXPECT_NE(few.message.find("; raise it"), std::string::npos) << few.message;
  EXPECT_TRUE(std::isnan(few.pull_off_force));
  EXPECT_FALSE(few.is_converged);
}

TEST(HalfSpaceSolver, PixelsThatTakeTooManyStatesAreNamedWithThoseThatWouldDo) {
  HalfSpaceOptions options = elastic();
  options.max_states = 10;
  const HalfSpaceProblem soft = problemOf(waves(16, 16, 5e-9, 4e-9, 1e-9), 1e9);
  const SolvedHalfSpace few = solve(soft, options);
  ASSERT_EQ(few.status, HalfSpaceStatus::kTooManyStates);
  EXPECT_FALSE(isResolved(soft, options));
  EXPECT_EQ(resolvingPitch(soft, options), 0.5 * few.cohesive_length);
  const std::string advice =
      "pixels of 5e-09 m do not resolve the edges of the contacts, which jump from pixel to pixel: "
      "scan a smaller area with pixels of " +
      shortNumber(resolvingPitch(soft, options)) + " m or less";
  EXPECT_NE(few.message.find(advice), std::string::npos) << few.message;
}

TEST(HalfSpaceSolver, CancelEndsTheSearchWithWhatItHas) {
  std::atomic<bool> cancel{false};
  int states = 0;
  HalfSpaceControl control;
  control.cancel = &cancel;
  control.on_state = [&](const ForcePoint&) {
    if (++states == 3) cancel = true;
  };
  const SolvedHalfSpace solution =
      HalfSpaceSolver(elastic()).solve(problemOf(waves(16, 16, 5e-9, 5e-9, 1e-9)), control);
  EXPECT_EQ(solution.status, HalfSpaceStatus::kCancelled);
  EXPECT_EQ(states, 3);
  EXPECT_TRUE(std::isnan(solution.pull_off_force));
  EXPECT_FALSE(solution.approach.empty());
}

TEST(HalfSpaceSolver, CancelledBeforeItBeginsItSolvesNothing) {
  const std::atomic<bool> cancel{true};
  HalfSpaceControl control;
  control.cancel = &cancel;
  for (const HalfSpaceBoundary boundary :
       {HalfSpaceBoundary::kPeriodic, HalfSpaceBoundary::kFree}) {
    HalfSpaceOptions options = elastic();
    options.boundary = boundary;
    const SolvedHalfSpace solution =
        HalfSpaceSolver(options).solve(problemOf(waves(16, 16, 5e-9, 5e-9, 1e-9)), control);
    EXPECT_EQ(solution.status, HalfSpaceStatus::kCancelled);
    EXPECT_EQ(solution.state_count, 0);
  }
}

std::string errorOf(const HalfSpaceProblem& problem, const HalfSpaceOptions& options = elastic()) {
  try {
    HalfSpaceSolver(options).solve(problem);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(HalfSpaceSolver, ImpossibleProblemsAreRefusedByName) {
  const HeightMap lower = waves(16, 16, 5e-9, 5e-9, 1e-9);
  HalfSpaceProblem problem = problemOf(lower);
  problem.interface.work_of_adhesion = 0.0;
  EXPECT_NE(errorOf(problem).find("interface/work_of_adhesion: 0"), std::string::npos);
  problem = problemOf(lower);
  problem.interface.hamaker_constant = 0.0;
  HalfSpaceOptions options = elastic();
  options.range = 0.0;
  EXPECT_NE(errorOf(problem, options).find("interface/hamaker_constant: 0"), std::string::npos);
  EXPECT_EQ(errorOf(problem), "");  // the range is stated
  problem = problemOf(lower, 0.0);
  EXPECT_NE(errorOf(problem).find("lower/youngs_modulus: 0"), std::string::npos);
  problem = problemOf(HeightMap(cv::Mat(4, 4, CV_64FC1, cv::Scalar(std::nan(""))), 1e-9, 1e-9));
  EXPECT_NE(errorOf(problem).find("no valid pixel"), std::string::npos);
  options = elastic();
  options.max_pixels = 255;
  EXPECT_NE(errorOf(problemOf(lower), options).find("half_space/max_pixels = 255"),
            std::string::npos);
}

TEST(HalfSpaceSolver, OptionsOutOfRangeAreRefusedByName) {
  HalfSpaceOptions options;
  options.step = 0.0;
  options.threads = 0;
  try {
    HalfSpaceSolver solver(options);
    FAIL() << "accepted";
  } catch (const OptionsError& error) {
    ASSERT_EQ(error.violations().size(), 2U);
    EXPECT_NE(error.violations()[0].find("half_space/step"), std::string::npos);
    EXPECT_NE(error.violations()[1].find("half_space/threads"), std::string::npos);
  }
}

}  // namespace
}  // namespace mems_stiction
