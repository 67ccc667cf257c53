/// Which scans are solved as a half-space, why, and what it may cost.

#include "evaluation/half_space_call.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <gtest/gtest.h>

#include "evaluation/frame_load.hpp"
#include "evaluation/plausibility.hpp"
#include "mems_stiction/evaluation/half_space_scan.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/verdict/evidence.hpp"
#include "surface/gaussian_surface.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

/// - @p rms [m]: low ones are near bonding
HeightMap roughSurface(double rms) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = 64;
  options.pitch_x = options.pitch_y = 5e-9;
  options.correlation_length_x = options.correlation_length_y = 60e-9;
  options.rms_height = rms;
  return gaussianSurface(options);
}

constexpr double kSmooth = 0.4e-9;
constexpr double kRough = 5e-9;

/// With a device whose spring pulls at a contact of any size.
Configuration withDevice() {
  Configuration configuration;
  configuration.device.spring_stiffness = 1.0;
  configuration.device.travel = 1e-6;
  configuration.device.contact_area = 1e-13;
  return configuration;
}

/// A scan with all that is asked about it.
struct Case {
  Configuration configuration;
  PreparedScan prepared;
  Prediction prediction;
  Options options;

  Case(const Configuration& settings, double rms)
      : configuration(settings), prepared(ScanPreparer(settings).prepare(roughSurface(rms))) {
    ScanPredictor predictor(settings);
    prediction = predictor.predict(prepared);
    options = onFrame(settings.model, settings.device, prepared.surfaces);
  }
  HalfSpaceCall call() const { return halfSpaceCall(prediction, prepared, options, configuration); }
  SolvedHalfSpace answer(const HalfSpaceControl& control = {}) const {
    return answerOf(call(), HalfSpaceSolver(configuration.half_space),
                    halfSpaceProblem(prepared, options), control);
  }
};

TEST(HalfSpaceCall, FlagsAskWhereADeviceIsStated) {
  const Case flagged(withDevice(), kSmooth);
  EXPECT_TRUE(mayCallHalfSpace(flagged.configuration));
  EXPECT_TRUE(flagged.call().is_made);
  EXPECT_EQ(flagged.call().why, "near_bonding");
  EXPECT_EQ(flagged.call().objection, "");
  EXPECT_FALSE(Case(withDevice(), kRough).call().is_made);
  EXPECT_FALSE(mayCallHalfSpace(Configuration()));
  EXPECT_FALSE(Case(Configuration(), kSmooth).call().is_made);
  Configuration half_stated = withDevice();
  half_stated.device.contact_area = 0.0;
  EXPECT_FALSE(mayCallHalfSpace(half_stated));
  Configuration beam;
  beam.device.beam_type = BeamType::kCantilever;
  EXPECT_TRUE(mayCallHalfSpace(beam));
}

TEST(HalfSpaceCall, ThinBodiesAskForTheirOwnStiffness) {
  Configuration plate = withDevice();
  plate.model.lower.thickness = 8e-9;  // of a frame of 320 nm
  const Case thin(plate, kRough);
  ASSERT_TRUE(thin.call().is_made);
  const SolvedHalfSpace answer = thin.answer();
  ASSERT_EQ(answer.status, HalfSpaceStatus::kSolved) << answer.message;
  Configuration thick = withDevice();
  thick.half_space.enabled = HalfSpaceUse::kAlways;
  EXPECT_GT(std::abs(answer.pull_off_force / Case(thick, kRough).answer().pull_off_force - 1.0),
            0.03);
}

TEST(HalfSpaceCall, PublishedFormulationsAreAskedForWhatWasPublished) {
  Configuration paper = withDevice();
  paper.model.formulation = "paper";
  EXPECT_FALSE(mayCallHalfSpace(paper));
  EXPECT_FALSE(Case(paper, kSmooth).call().is_made);
  paper.half_space.enabled = HalfSpaceUse::kAlways;
  EXPECT_TRUE(Case(paper, kSmooth).call().is_made);
}

TEST(HalfSpaceCall, TheSettingCallsForAllOrNone) {
  Configuration settings = withDevice();
  settings.half_space.enabled = HalfSpaceUse::kNever;
  EXPECT_FALSE(Case(settings, kSmooth).call().is_made);
  settings = Configuration();
  settings.half_space.enabled = HalfSpaceUse::kAlways;
  const HalfSpaceCall call = Case(settings, kRough).call();
  EXPECT_TRUE(call.is_made);
  EXPECT_EQ(call.why, "");
}

TEST(HalfSpaceCall, OnlyFlagsOfTheModelsForceCount) {
  EXPECT_EQ(flagsForHalfSpace(kResolutionFlag | kFewContactsFlag | kBorderFlag | kOnePixelFlag |
                              kPlasticityFlag),
            0U);
  EXPECT_EQ(flagsForHalfSpace(kBondedFlag), 0U);  // bonded, and no doubt how strongly
  for (const std::uint32_t flag : {kNoEquilibriumFlag, kNearBondingFlag}) {
    EXPECT_EQ(flagsForHalfSpace(flag | kBorderFlag), flag);
  }
}

TEST(HalfSpaceCall, TheAnswerIsTheSolvers) {
  const Case flagged(withDevice(), kSmooth);
  const SolvedHalfSpace expected = HalfSpaceSolver(flagged.configuration.half_space)
                                       .solve(halfSpaceProblem(flagged.prepared, flagged.options));
  ASSERT_EQ(expected.status, HalfSpaceStatus::kSolved) << expected.message;
  const SolvedHalfSpace answer = flagged.answer();
  EXPECT_EQ(answer.pull_off_force, expected.pull_off_force);
  EXPECT_EQ(answer.work_of_adhesion, expected.work_of_adhesion);
  EXPECT_EQ(whyNotJudging(answer), whyNotJudging(expected));
}

TEST(HalfSpaceCall, LargeFramesAreNotSolvedForTheirFlags) {
  Configuration settings = withDevice();
  settings.half_space.max_flagged_pixels = 64 * 64 - 1;
  const Case large(settings, kSmooth);
  EXPECT_TRUE(large.call().is_made);
  EXPECT_NE(large.call().objection.find("half_space/max_flagged_pixels = 4095"), std::string::npos)
      << large.call().objection;
  EXPECT_EQ(large.answer().message, large.call().objection);
  EXPECT_EQ(whyNotJudging(large.answer()), large.call().objection);
  settings.half_space.enabled = HalfSpaceUse::kAlways;  // who asks gets it
  EXPECT_EQ(Case(settings, kSmooth).answer().status, HalfSpaceStatus::kSolved);
}

TEST(HalfSpaceCall, RestAloneIsNotBegunForFlagsAsItCouldNotJudge) {
  Configuration settings = withDevice();
  settings.half_space.path = HalfSpacePath::kRest;
  EXPECT_NE(Case(settings, kSmooth).call().objection.find("half_space/path is rest"),
            std::string::npos);
  SolvedHalfSpace rest;
  rest.status = HalfSpaceStatus::kSolved;
  rest.path = HalfSpacePath::kRest;
  rest.is_converged = rest.is_resolved = true;
  EXPECT_EQ(whyNotJudging(rest), kRestAlone);
}

TEST(HalfSpaceCall, WhatCouldNotJudgeIsNotBegun) {
  Configuration soft = withDevice();
  soft.model.lower.youngs_modulus = soft.model.upper.youngs_modulus = 1e9;
  const Case unresolved(soft, kRough);
  ASSERT_TRUE(unresolved.call().is_made);
  EXPECT_EQ(unresolved.call().objection, kPixelsTooLarge);
  Configuration tilting = withDevice();
  tilting.model.guidance = Guidance::kFree;
  const Case level(tilting, kSmooth);
  ASSERT_TRUE(level.call().is_made);
  EXPECT_EQ(level.call().objection, kMayTilt);
  SolvedHalfSpace as_it_lies;
  as_it_lies.status = HalfSpaceStatus::kSolved;
  as_it_lies.is_resolved = as_it_lies.is_step_converged = as_it_lies.may_tilt = true;
  EXPECT_EQ(whyNotJudging(as_it_lies), kMayTilt);
  Configuration free_plate = withDevice();
  free_plate.model.lower.thickness = 1e-6;
  free_plate.half_space.boundary = HalfSpaceBoundary::kFree;
  const Case refused(free_plate, kSmooth);
  ASSERT_TRUE(refused.call().is_made);
  EXPECT_NE(refused.call().objection.find("lower/backing free is not allowed"), std::string::npos)
      << refused.call().objection;
}

TEST(HalfSpaceCall, WhoAsksIsWarnedOfPixelsThatAreTooLarge) {
  const auto isWarned = [](HalfSpaceUse use, double modulus) {
    Configuration settings;
    settings.half_space.enabled = use;
    settings.model.lower.youngs_modulus = settings.model.upper.youngs_modulus = modulus;
    const Case one(settings, kRough);
    const std::vector<std::string> lines =
        predictionWarnings(one.prepared, settings, one.prediction, one.options);
    return std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
             return line.find("half-space: pixels of 5e-09 m are too large for the edges") == 0;
           }) == 1;
  };
  EXPECT_TRUE(isWarned(HalfSpaceUse::kAlways, 1e9));
  EXPECT_FALSE(isWarned(HalfSpaceUse::kAlways, 169e9));
  EXPECT_FALSE(isWarned(HalfSpaceUse::kFlagged, 1e9));
}

TEST(HalfSpaceCall, ASolutionThatTakesTooMuchIsGivenUpWithAReason) {
  Configuration settings = withDevice();
  settings.half_space.max_flagged_products = 3;
  settings.half_space.max_flagged_pixels = 2 * 64 * 64;
  const SolvedHalfSpace answer = Case(settings, kSmooth).answer();
  EXPECT_EQ(answer.status, HalfSpaceStatus::kCancelled);
  EXPECT_EQ(answer.message.find(
                "its solution takes more than 6 products (half_space/max_flagged_products = 3)"),
            0U)
      << answer.message;
  EXPECT_EQ(whyNotJudging(answer), answer.message);
}

TEST(HalfSpaceCall, ItsCallerEndsItAndIsAskedToGiveWay) {
  const Case flagged(withDevice(), kSmooth);
  std::atomic<bool> cancel{false};
  int ways = 0;
  HalfSpaceControl control;
  control.cancel = &cancel;
  control.give_way = [&] { cancel = ++ways == 2; };
  const SolvedHalfSpace answer = flagged.answer(control);
  EXPECT_EQ(ways, 2);
  EXPECT_EQ(answer.status, HalfSpaceStatus::kCancelled);
  EXPECT_EQ(answer.message.find("max_flagged_products"), std::string::npos) << answer.message;
}

}  // namespace
}  // namespace mems_stiction
