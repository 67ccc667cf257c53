/// A half-space that can judges in the prediction's place and says so; one that cannot does not,
/// and the reason says why. Other cleanings widen the interval.

#include <cmath>

#include <gtest/gtest.h>

#include "device/device_evidence.hpp"
#include "errors/short_number.hpp"
#include "mems_stiction/verdict/verdict.hpp"
#include "numeric/constants.hpp"
#include "paper/contact_growth.hpp"
#include "support/paper_options.hpp"
#include "support/predicted_contacts.hpp"
#include "verdict/margin_uncertainty.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

using predicted_contacts::kArea;
using predicted_contacts::kCell;
using predicted_contacts::kPullOff;

Prediction predicted() {
  Prediction prediction = predicted_contacts::predicted();
  prediction.model.error = {0.05, 0.04};
  return prediction;
}

/// With a pull-off force and work `factor` times those of the prediction.
SolvedHalfSpace solved(double factor) {
  SolvedHalfSpace solution;
  solution.status = HalfSpaceStatus::kSolved;
  solution.is_converged = solution.is_resolved = solution.is_step_converged = true;
  solution.pull_off_force = factor * kPullOff;
  solution.pull_off_uncertainty = 0.0;
  solution.work_of_adhesion = factor * 0.01;
  return solution;
}

/// Whose spring has `margin` by the prediction.
DeviceOptions springOf(double margin) {
  DeviceOptions device;
  device.travel = 1e-6;
  device.spring_stiffness = margin * kPullOff / device.travel;
  device.contact_area = kArea;
  return device;
}

UncertaintyOptions exact() {
  UncertaintyOptions uncertainty;
  uncertainty.work_of_adhesion = uncertainty.hardness = uncertainty.youngs_modulus = 0.0;
  uncertainty.pitch = uncertainty.cutoff_distance = uncertainty.hamaker_constant = 0.0;
  uncertainty.scan_sampling = false;
  uncertainty.samples = 20000;
  return uncertainty;
}

Verdict verdictWith(const Evidence& evidence, const Prediction& prediction, double margin,
                    const UncertaintyOptions& uncertainty = exact()) {
  return verdictOf(prediction, springOf(margin), uncertainty, Options(), kCell, evidence);
}

Verdict verdictWith(const SolvedHalfSpace& solution, const Prediction& prediction, double margin) {
  Evidence evidence;
  evidence.half_space = &solution;
  return verdictWith(evidence, prediction, margin);
}

bool says(const Verdict& verdict, const std::string& words) {
  return verdict.reason.find(words) != std::string::npos;
}

TEST(HalfSpaceVerdict, JudgesYesWhereTheCurveSaysNo) {
  const Verdict by_curve = verdictWith(Evidence(), predicted(), 3.0);
  EXPECT_EQ(by_curve.sticks, Sticks::kNo);
  EXPECT_EQ(by_curve.judge, Judge::kPrediction);
  const Verdict verdict = verdictWith(solved(6.0), predicted(), 3.0);
  EXPECT_EQ(verdict.sticks, Sticks::kYes);
  EXPECT_EQ(verdict.judge, Judge::kHalfSpace);
  EXPECT_DOUBLE_EQ(verdict.margin, 0.5);
  EXPECT_DOUBLE_EQ(verdict.margin_transition, 0.5);
  EXPECT_DOUBLE_EQ(verdict.device_pull_off_force, 6.0 * kPullOff);
  EXPECT_DOUBLE_EQ(verdict.device_apparent_work_of_adhesion, 0.06);
  EXPECT_EQ(verdict.reason.find("by the half-space: margin 0.5, 95 % within "), 0U)
      << verdict.reason;
}

TEST(HalfSpaceVerdict, OneThatCannotJudgeLeavesThePredictionsVerdictAndSaysWhy) {
  SolvedHalfSpace unsolved = solved(6.0);
  unsolved.status = HalfSpaceStatus::kTooManyStates;
  unsolved.message = "half_space/max_states did not suffice";
  SolvedHalfSpace unresolved = solved(6.0);
  unresolved.is_resolved = false;
  SolvedHalfSpace coarse = solved(6.0);
  coarse.is_step_converged = false;
  const Verdict by_curve = verdictWith(Evidence(), predicted(), 3.0);
  for (const auto& [solution, why] :
       {std::make_pair(unsolved, "half_space/max_states did not suffice"),
        std::make_pair(unresolved, "its pixels are too large"),
        std::make_pair(coarse, "half_space/step"),
        std::make_pair(unsolvedHalfSpace("no valid pixel"), "no valid pixel")}) {
    const Verdict verdict = verdictWith(solution, predicted(), 3.0);
    EXPECT_EQ(verdict.sticks, by_curve.sticks);
    EXPECT_EQ(verdict.judge, Judge::kPrediction);
    EXPECT_EQ(verdict.margin, by_curve.margin);
    EXPECT_EQ(verdict.margin_lower, by_curve.margin_lower);
    EXPECT_EQ(verdict.reason.find(by_curve.reason + "; the half-space does not count: "), 0U)
        << verdict.reason;
    EXPECT_TRUE(says(verdict, why)) << verdict.reason;
  }
}

TEST(HalfSpaceVerdict, WhatFlagsAskedForIsSaid) {
  const SolvedHalfSpace solution = solved(6.0);
  Evidence evidence;
  evidence.half_space = &solution;
  evidence.why_half_space = "near_bonding";
  const Verdict judged = verdictWith(evidence, predicted(), 3.0);
  EXPECT_EQ(judged.judge, Judge::kHalfSpace);
  EXPECT_EQ(judged.reason.find("by the half-space, as near_bonding asks for it: margin 0.5"), 0U)
      << judged.reason;
  const SolvedHalfSpace none = unsolvedHalfSpace("the frame is large");
  evidence.half_space = &none;
  const Verdict by_curve = verdictWith(Evidence(), predicted(), 3.0);
  EXPECT_EQ(verdictWith(evidence, predicted(), 3.0).reason,
            by_curve.reason +
                "; near_bonding asks for the half-space, which does not count: the frame is large");
  evidence.half_space = nullptr;
  evidence.where_half_space = "it follows";
  EXPECT_EQ(verdictWith(evidence, predicted(), 3.0).reason,
            by_curve.reason + "; near_bonding asks for the half-space: it follows");
}

TEST(HalfSpaceVerdict, ItsErrorTakesThePlaceOfTheModels) {
  Prediction near_bonding = predicted();
  near_bonding.model.error = {0.10, 0.11};
  near_bonding.model.doubt = "it tears";
  // By the error map the interval of the curve holds 1, by 0.02 that of the half-space does not.
  EXPECT_EQ(verdictWith(Evidence(), near_bonding, 1.2).sticks, Sticks::kMarginal);
  const Verdict verdict = verdictWith(solved(1.0), near_bonding, 1.2);
  EXPECT_EQ(verdict.sticks, Sticks::kNo) << verdict.reason;
  EXPECT_NE(verdict.regime_flags & kNearBondingFlag, 0U);
  // 20000 samples: their 2.5 % quantile is within 3 % of a normal distribution's
  EXPECT_NEAR(std::log(verdict.margin / verdict.margin_lower), 1.96 * 0.02, 0.03 * 1.96 * 0.02);
  EXPECT_NEAR(std::log(verdict.margin_upper / verdict.margin), 1.96 * 0.02, 0.03 * 1.96 * 0.02);
  SolvedHalfSpace coarser = solved(1.0);
  coarser.pull_off_uncertainty = 0.015 * kPullOff;
  const Verdict wider = verdictWith(coarser, near_bonding, 1.2);
  EXPECT_NEAR(std::log(wider.margin / wider.margin_lower), 1.96 * 0.025,
              0.03 * 1.96 * 0.025);  // hypot(0.02, 0.015)
}

/// What the curve doubts is in the device's force, too, until the half-space has answered.
TEST(HalfSpaceVerdict, AnswersTheDoubtInTheForceOfADevice) {
  constexpr double kDoubted = 0.5;
  constexpr double kSure = 0.1;
  Prediction doubted = predicted();
  doubted.model.doubt = "it tears";
  DeviceEvidence device;
  device.pull_off_force = 100.0 * kPullOff;
  device.apparent_work_of_adhesion = 0.01;
  for (std::vector<double>* const factors : {&device.force_factors, &device.work_factors}) {
    factors->assign(20000, 1.0);
    widen(*factors, factorsWithin(1.96 * kDoubted));
  }
  for (std::vector<double>* const factors :
       {&device.force_factors_without_doubt, &device.work_factors_without_doubt}) {
    factors->assign(20000, 1.0);
    widen(*factors, factorsWithin(1.96 * kSure));
  }
  Evidence evidence;
  evidence.device = device;
  const auto reach = [](const Verdict& verdict) {
    return std::log(verdict.margin / verdict.margin_lower);
  };
  EXPECT_NEAR(reach(verdictWith(evidence, doubted, 3.0)), 1.96 * kDoubted, 0.03);
  const SolvedHalfSpace solution = solved(2.0);
  evidence.half_space = &solution;
  const Verdict judged = verdictWith(evidence, doubted, 3.0);
  EXPECT_EQ(judged.judge, Judge::kHalfSpace);
  EXPECT_NEAR(reach(judged), 1.96 * std::hypot(kSure, 0.02), 0.01);

  DeviceForce force;
  force.pull_off_force = device.pull_off_force;
  force.apparent_work_of_adhesion = device.apparent_work_of_adhesion;
  const DeviceForce moved = judgedByHalfSpace(force, doubted, Options(), exact(), evidence);
  EXPECT_DOUBLE_EQ(moved.pull_off_force, judged.device_pull_off_force);
  EXPECT_DOUBLE_EQ(moved.pull_off_force_upper, judged.device_pull_off_force_upper);
  EXPECT_DOUBLE_EQ(moved.pull_off_force_lower, judged.device_pull_off_force_lower);
}

TEST(HalfSpaceVerdict, ConstantsMoveItAsTheyMoveThePrediction) {
  UncertaintyOptions uncertainty = exact();
  uncertainty.work_of_adhesion = 0.3;
  const SolvedHalfSpace solution = solved(1.0);
  Evidence evidence;
  evidence.half_space = &solution;
  const Verdict verdict = verdictWith(evidence, predicted(), 3.0, uncertainty);
  const double deviation = std::hypot(std::sqrt(std::log1p(0.09)), 0.02);
  EXPECT_NEAR(std::log(verdict.margin / verdict.margin_lower), 1.96 * deviation,
              0.05 * 1.96 * deviation);
}

TEST(HalfSpaceVerdict, AContactOfOnePixelIsNoBetterByTheHalfSpace) {
  Prediction prediction = predicted();
  for (Asperity& asperity : prediction.asperities) asperity.area = kCell;
  const Verdict verdict = verdictWith(solved(1.0), prediction, 5.0);
  EXPECT_EQ(verdict.sticks, Sticks::kUnknown);
  EXPECT_EQ(verdict.judge, Judge::kHalfSpace);
  EXPECT_TRUE(says(verdict, "contacts of one pixel")) << verdict.reason;
}

TEST(HalfSpaceVerdict, OfContactsThatAreSmallAndFewOneSentenceSaysWhatComesFirst) {
  Prediction prediction = predicted();
  for (Asperity& asperity : prediction.asperities) asperity.area = kCell;
  const Verdict many = verdictWith(Evidence(), prediction, 5.0);
  const std::string finer = "scan finer pixels, of at most " +
                            shortNumber(std::sqrt(kCell / 20.0), 2) + " m (now " +
                            shortNumber(std::sqrt(kCell), 2) + " m)";
  EXPECT_TRUE(says(many, finer)) << many.reason;
  EXPECT_FALSE(says(many, "places")) << many.reason;

  prediction.pull_off_contact_count = 2;
  const Verdict few = verdictWith(Evidence(), prediction, 5.0);
  EXPECT_TRUE(says(few, "scan finer pixels first")) << few.reason;
  EXPECT_TRUE(says(few, "then as many such places as have 3 contacts inside")) << few.reason;

  for (Asperity& asperity : prediction.asperities) asperity.area = 100.0 * kCell;
  const Verdict large = verdictWith(Evidence(), prediction, 5.0);
  EXPECT_TRUE(says(large, "2 contacts: scan more places, or an area at least 1.5 times as large"))
      << large.reason;
  EXPECT_FALSE(says(large, "pixels")) << large.reason;
}

TEST(HalfSpaceVerdict, ASearchThatEndedIsNoObstacle) {
  Prediction prediction = predicted();
  prediction.status = Status::kNoEquilibrium;
  EXPECT_EQ(verdictWith(Evidence(), prediction, 3.0).sticks, Sticks::kUnknown);
  EXPECT_EQ(verdictWith(solved(1.0), prediction, 3.0).sticks, Sticks::kNo);
}

TEST(HalfSpaceVerdict, ThePapersContactsMoveItToo) {
  Prediction prediction = predicted();
  prediction.apparent_work_of_adhesion = Prediction::kUnknown;
  prediction.model.respond = contactGrowth;
  for (Asperity& asperity : prediction.asperities) asperity.cap_radius = 30e-9;
  const SolvedHalfSpace solution = solved(0.1);
  Evidence evidence;
  evidence.half_space = &solution;
  const Verdict verdict =
      verdictOf(prediction, springOf(3.0), exact(), paperOptions(), kCell, evidence);
  EXPECT_NEAR(verdict.margin, 30.0, 1e-9);
  EXPECT_NEAR(std::log(verdict.margin / verdict.margin_lower), 1.96 * 0.02, 0.03 * 1.96 * 0.02);
}

TEST(HalfSpaceVerdict, WithoutADeviceNobodyJudges) {
  const SolvedHalfSpace solution = solved(1.0);
  Evidence evidence;
  evidence.half_space = &solution;
  const Verdict verdict =
      verdictOf(predicted(), DeviceOptions(), exact(), Options(), kCell, evidence);
  EXPECT_EQ(verdict.judge, Judge::kPrediction);
  EXPECT_EQ(verdict.reason.find("the device is not stated"), 0U);
}

TEST(HalfSpaceVerdict, JudgesABeamByItsWork) {
  DeviceOptions device;
  device.beam_type = BeamType::kCantilever;
  device.beam_length = 100e-6;
  device.beam_thickness = 2e-6;
  device.beam_gap = 2e-6;
  device.beam_modulus = 160e9;
  const SolvedHalfSpace solution = solved(4.0);
  Evidence evidence;
  evidence.half_space = &solution;
  const double by_curve = verdictOf(predicted(), device, exact(), Options(), kCell).peel_number;
  const Verdict verdict = verdictOf(predicted(), device, exact(), Options(), kCell, evidence);
  EXPECT_DOUBLE_EQ(verdict.peel_number, by_curve / 4.0);
  EXPECT_EQ(verdict.judge, Judge::kHalfSpace);
}

TEST(CleaningInVerdict, AddsToTheIntervalInQuadrature) {
  Evidence evidence;
  evidence.cleaning = CleaningReach{{0.5, 1.25}, {}};
  const Verdict plain = verdictWith(Evidence(), predicted(), 3.0);
  const Verdict verdict = verdictWith(evidence, predicted(), 3.0);
  EXPECT_EQ(verdict.margin, plain.margin);
  const double model = 1.96 * 0.05;  // of contacts that stay apart
  // two halves of normal numbers, the wider of which reaches somewhat over the middle: 5 %
  EXPECT_NEAR(std::log(verdict.margin_upper / verdict.margin) / std::hypot(model, std::log(2.0)),
              1.0, 0.05);
  EXPECT_NEAR(std::log(verdict.margin / verdict.margin_lower) / std::hypot(model, std::log(1.25)),
              1.0, 0.05);
  EXPECT_TRUE(says(verdict, " (cleaning included): ")) << verdict.reason;
  EXPECT_FALSE(says(plain, "cleaning")) << plain.reason;
}

TEST(CleaningInVerdict, NeverBringsAnEndNearerWhateverTheSamples) {
  UncertaintyOptions uncertainty = exact();
  uncertainty.samples = 20;
  Evidence evidence;
  evidence.cleaning = CleaningReach{{0.95, 1.02}, {}};
  for (uncertainty.seed = 1; uncertainty.seed <= 20; ++uncertainty.seed) {
    const Verdict plain = verdictWith(Evidence(), predicted(), 3.0, uncertainty);
    const Verdict verdict = verdictWith(evidence, predicted(), 3.0, uncertainty);
    EXPECT_LT(verdict.margin_lower, plain.margin_lower) << uncertainty.seed;
    EXPECT_GT(verdict.margin_upper, plain.margin_upper) << uncertainty.seed;
  }
}

TEST(CleaningInVerdict, CanMakeANoMarginal) {
  Evidence evidence;
  evidence.cleaning = CleaningReach{{1.0, 4.0}, {}};
  EXPECT_EQ(verdictWith(Evidence(), predicted(), 3.0).sticks, Sticks::kNo);
  EXPECT_EQ(verdictWith(evidence, predicted(), 3.0).sticks, Sticks::kMarginal);
  const SolvedHalfSpace solution = solved(1.0);
  evidence.half_space = &solution;
  const Verdict by_half_space = verdictWith(evidence, predicted(), 3.0);
  EXPECT_EQ(by_half_space.sticks, Sticks::kMarginal) << "the cleaning is the half-space's too";
  EXPECT_EQ(by_half_space.reason.find("by the half-space: "), 0U);
}

}  // namespace
}  // namespace mems_stiction
