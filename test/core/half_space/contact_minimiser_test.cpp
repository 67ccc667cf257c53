/// States that are solved in several searches, taken back and gone on from.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "half_space/contact_minimiser.hpp"
#include "support/rough_relief.hpp"

namespace mems_stiction {
namespace {

constexpr double kModulus = 88.8e9;
constexpr double kPitch = 2e-9;
constexpr int kPixels = 48;

LargePageVector<double> rough() {
  GaussianSurfaceOptions options;
  options.rows = options.cols = kPixels;
  options.pitch_x = options.pitch_y = kPitch;
  options.correlation_length_x = options.correlation_length_y = 30e-9;
  options.rms_height = 0.6e-9;
  options.seed = 4;
  return roughRelief(options);
}

class ContactMinimiserOf : public testing::TestWithParam<HalfSpaceBoundary> {
 protected:
  ContactMinimiserOf()
      : law_(TractionLawOptions()),
        minimiser_(HalfSpaceGrid(kPixels, kPixels, kPitch, kPitch, GetParam()), law_, kModulus,
                   rough(), MinimiserSettings()) {}

  double height(double in_ranges) const { return in_ranges * law_.range(); }
  ContactState solveExactly(double at) { return minimiser_.solve(height(at)); }
  ContactState solveRoughly(double at) {
    ContactMinimiser::Search search;
    search.tolerance = 1000.0;
    return minimiser_.solve(height(at), search);
  }
  /// Wherever it is: without a search.
  void stayAt(double at) {
    ContactMinimiser::Search search;
    search.tolerance = 1e9;
    minimiser_.solve(height(at), search);
  }
  /// Of all cells [m].
  LargePageVector<double> displacement() const { return minimiser_.place().displacement.values; }
  /// Largest |one - other| [z0].
  double difference(const LargePageVector<double>& one,
                    const LargePageVector<double>& other) const {
    double largest = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i)
      largest = std::max(largest, std::abs(one[i] - other[i]));
    return largest / law_.range();
  }

  TractionLaw law_;
  ContactMinimiser minimiser_;
};
INSTANTIATE_TEST_SUITE_P(Edges, ContactMinimiserOf,
                         testing::Values(HalfSpaceBoundary::kPeriodic, HalfSpaceBoundary::kFree),
                         [](const auto& tested) {
                           return tested.param == HalfSpaceBoundary::kPeriodic ? "periodic"
                                                                               : "free";
                         });

TEST_P(ContactMinimiserOf, AStateSolvedInTwoSearchesIsTakenBackAsAWhole) {
  solveExactly(0.0);
  const LargePageVector<double> before = displacement();
  minimiser_.moveOn(0.0);
  ASSERT_TRUE(solveRoughly(-2.0).is_converged);
  ASSERT_TRUE(solveExactly(-2.0).is_converged);
  ASSERT_GT(difference(displacement(), before), 0.1);  // another state
  minimiser_.takeBack();
  EXPECT_LT(difference(displacement(), before), 1e-5);
}

TEST_P(ContactMinimiserOf, WhatTwoSearchesChangedIsContinued) {
  solveExactly(0.0);
  const LargePageVector<double> begin = displacement();
  minimiser_.moveOn(0.0);
  solveRoughly(-2.0);
  solveExactly(-2.0);
  LargePageVector<double> foreseen = displacement();
  for (std::size_t i = 0; i < foreseen.size(); ++i) foreseen[i] += foreseen[i] - begin[i];
  minimiser_.moveOn(1.0);
  stayAt(-4.0);
  EXPECT_LT(difference(displacement(), foreseen), 1e-5);
}

TEST_P(ContactMinimiserOf, ElasticTractionFollowsOverManyStates) {
  solveExactly(4.0);
  for (double at = 3.75; at >= -3.0; at -= 0.25) {
    minimiser_.moveOn(1.0);
    ASSERT_TRUE(solveRoughly(at).is_converged) << at;
  }
  for (double at = -3.0; at <= -1.0; at += 0.5) {
    minimiser_.moveOn(0.5);
    solveRoughly(at);
    minimiser_.takeBack();
  }
  const ContactMinimiser::Place place = minimiser_.place();
  SpectrumMemory memory;
  StiffnessOperator<double> stiffness(minimiser_.grid(), kModulus, 1, memory);
  LargePageVector<double> exact(place.displacement.values.size(), 0.0);
  stiffness.multiply(place.displacement.values.data(), exact.data());
  double error = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    error = std::max(error, std::abs(place.displacement.traction[i] - exact[i]));
  EXPECT_LE(error, place.displacement.staleness);
}

}  // namespace
}  // namespace mems_stiction
