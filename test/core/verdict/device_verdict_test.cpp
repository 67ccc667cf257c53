/// A device whose own force has been found is judged by that, whatever its area over that of the
/// scan.

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "device/device_evidence.hpp"
#include "mems_stiction/verdict/verdict.hpp"
#include "support/predicted_contacts.hpp"
#include "verdict/finding.hpp"
#include "verdict/margin_uncertainty.hpp"
#include "verdict/part_verdict.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

using predicted_contacts::kArea;
using predicted_contacts::kCell;
using predicted_contacts::kPullOff;
using predicted_contacts::predicted;

constexpr double kOfDevice =
    4e-7;  ///< pull-off force of the device, whose area is 100 times that of the scan [N]
constexpr double kDeviation = 0.25;

/// Whose spring has `margin` by its own force.
DeviceOptions springOf(double margin) {
  DeviceOptions device;
  device.travel = 1e-6;
  device.spring_stiffness = margin * kOfDevice / device.travel;
  device.contact_area = 100.0 * kArea;
  return device;
}

Evidence found(double freedom = 7.0) {
  DeviceForce force;
  force.pull_off_force = kOfDevice;
  force.apparent_work_of_adhesion = 1e-4;
  force.linear_pull_off_force = 100.0 * kPullOff;
  force.force_factors.assign(20000, 1.0);
  widen(force.force_factors, factorsWithin(studentQuantile(freedom) * kDeviation));
  force.work_factors.assign(20000, 1.0);
  widen(force.work_factors, factorsWithin(studentQuantile(freedom) * 0.5 * kDeviation));
  force.warnings = {"measure a field of at least 40 um", "another one"};
  Evidence evidence;
  evidence.device = deviceEvidence(force);
  return evidence;
}

UncertaintyOptions exact() {
  UncertaintyOptions uncertainty;
  uncertainty.work_of_adhesion = uncertainty.hardness = uncertainty.youngs_modulus = 0.0;
  uncertainty.pitch = uncertainty.cutoff_distance = uncertainty.hamaker_constant = 0.0;
  uncertainty.samples = 20000;
  return uncertainty;
}

Verdict verdictWith(const Evidence& evidence, double margin,
                    const UncertaintyOptions& uncertainty = exact(),
                    const Prediction& prediction = predicted()) {
  return verdictOf(prediction, springOf(margin), uncertainty, Options(), kCell, evidence);
}

bool says(const Verdict& verdict, const std::string& words) {
  return verdict.reason.find(words) != std::string::npos;
}

TEST(DeviceVerdict, marginIsByTheDevicesOwnForce) {
  const Verdict verdict = verdictWith(found(), 5.0);
  EXPECT_EQ(verdict.sticks, Sticks::kNo);
  EXPECT_DOUBLE_EQ(verdict.device_pull_off_force, kOfDevice);
  EXPECT_NEAR(verdict.margin, 5.0, 1e-12);
  EXPECT_NEAR(verdict.margin_transition, 5.0, 1e-12);
  EXPECT_TRUE(says(verdict, "the scan's force by area would say margin 0.2")) << verdict.reason;
  EXPECT_EQ(verdict.place_deviation, 0.0);
}

TEST(DeviceVerdict, exactConstantsLeaveStudentsInterval) {
  const double student = 2.364624;  // 97.5 % of 7 degrees of freedom
  const Verdict verdict = verdictWith(found(), 5.0);
  EXPECT_NEAR(std::log(verdict.margin_upper / 5.0), student * kDeviation,
              0.03 * student * kDeviation);
  EXPECT_NEAR(std::log(5.0 / verdict.margin_lower), student * kDeviation,
              0.03 * student * kDeviation);
  const Verdict of_three = verdictWith(found(2.0), 5.0);
  EXPECT_NEAR(std::log(of_three.margin_upper / 5.0), 4.302653 * kDeviation,
              0.03 * 4.3 * kDeviation);
  EXPECT_EQ(of_three.sticks, Sticks::kNo);
  EXPECT_EQ(verdictWith(found(2.0), 2.5).sticks, Sticks::kMarginal);
}

TEST(DeviceVerdict, cleaningsAddInQuadrature) {
  Evidence evidence = found();
  evidence.cleaning = CleaningReach{{0.5, 2.0}, {1.0, 1.0}};
  const Verdict verdict = verdictWith(evidence, 5.0);
  const double expected = std::hypot(std::log(2.0), 2.364624 * kDeviation);
  EXPECT_NEAR(std::log(verdict.margin / verdict.margin_lower), expected, 0.03 * expected);
  EXPECT_NEAR(std::log(verdict.margin_upper / verdict.margin), expected, 0.03 * expected);
}

/// A beam of the same area that pulls with `margin` times that force.
DeviceOptions beamOf(double margin, BeamType type, double length) {
  DeviceOptions device;
  device.beam_type = type;
  device.beam_length = length;
  device.beam_width = 50e-6;
  device.beam_thickness = device.beam_gap = 2e-6;
  device.beam_modulus = 160e9;
  device.contact_area = 100.0 * kArea;
  device.beam_modulus *= margin * kOfDevice / device.restoringForce();
  return device;
}

/// Settings at random: margin and force are two faces of one distribution, whoever judges; of beams
/// peel number and work.
TEST(DeviceVerdict, marginIsTheRestoringForceOverTheForceQuantileByQuantile) {
  std::mt19937_64 engine(20021126);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  const auto chance = [&] { return draw(0.0, 1.0) < 0.5; };
  SolvedHalfSpace solution;
  solution.status = HalfSpaceStatus::kSolved;
  solution.is_converged = solution.is_resolved = solution.is_step_converged = true;
  int plain = 0, pulled = 0, peeled = 0;
  for (int i = 0; i < 600; ++i) {
    SCOPED_TRACE(i);
    UncertaintyOptions uncertainty;
    uncertainty.work_of_adhesion = draw(0.0, 0.5);
    uncertainty.pitch = draw(0.0, 0.1);
    uncertainty.scan_sampling = chance();
    uncertainty.seed = i;
    Evidence evidence;
    const bool has_own_force = chance();
    if (has_own_force) evidence = found(draw(2.0, 20.0));
    if (has_own_force && chance()) evidence.device->contacts = 1 + i % 4;
    if (chance())
      evidence.cleaning =
          CleaningReach{{draw(0.3, 1.0), draw(1.0, 3.0)}, {draw(0.3, 1.0), draw(1.0, 3.0)}};
    solution.pull_off_force = draw(0.5, 2.0) * kPullOff;
    solution.pull_off_uncertainty = draw(0.0, 0.2) * solution.pull_off_force;
    solution.work_of_adhesion = 0.01;
    if (chance()) evidence.half_space = &solution;
    DeviceOptions device = springOf(std::exp(draw(-2.0, 3.0)));
    if (i % 2 == 1) {
      device = beamOf(std::exp(draw(-2.0, 3.0)),
                      chance() ? BeamType::kCantilever : BeamType::kDoublyClamped,
                      std::exp(draw(-9.5, -7.5)));
    }
    if (!has_own_force) device.contact_area = draw(0.6, 1.8) * kArea;
    const Verdict verdict =
        verdictOf(predicted(1 + i % 30), device, uncertainty, Options(), kCell, evidence);
    ASSERT_TRUE(std::isfinite(verdict.margin)) << verdict.reason;
    const double round_off = 1e-12;
    EXPECT_NEAR(verdict.margin * verdict.device_pull_off_force / verdict.restoring_force, 1.0,
                round_off);
    EXPECT_NEAR(
        verdict.margin_lower * verdict.device_pull_off_force_upper / verdict.restoring_force, 1.0,
        round_off);
    EXPECT_NEAR(
        verdict.margin_upper * verdict.device_pull_off_force_lower / verdict.restoring_force, 1.0,
        round_off);
    if (has_own_force) {
      const double own_upper =
          evidence.device->pull_off_force * quantile(evidence.device->force_factors, kUpperShare);
      const double moved = verdict.device_pull_off_force / evidence.device->pull_off_force;
      EXPECT_GE(verdict.device_pull_off_force_upper, own_upper * moved * (1.0 - round_off))
          << "surer than the force";
    }
    const bool is_peeled = verdict.governed_by == kGovernedByPeeling;
    pulled += static_cast<int>(verdict.governed_by == kGovernedByForce);
    peeled += static_cast<int>(is_peeled);
    EXPECT_EQ(verdict.governed_by.empty(), !device.hasBeam());
    if (device.hasBeam()) {
      const double own_work = peelNumber(device.beam(), 1.0);
      const AdhesionSpread spread =
          adhesionSpread(predicted(1 + i % 30), Options(), uncertainty, evidence);
      EXPECT_NEAR(verdict.peel_number * verdict.device_apparent_work_of_adhesion / own_work, 1.0,
                  round_off);
      EXPECT_NEAR(verdict.peel_number_lower * verdict.device_apparent_work_of_adhesion *
                      quantile(spread.apparent_work, kUpperShare) / own_work,
                  1.0, round_off);
      EXPECT_NEAR(verdict.peel_number_upper * verdict.device_apparent_work_of_adhesion *
                      quantile(spread.apparent_work, kLowerShare) / own_work,
                  1.0, round_off);
    }
    if (verdict.sticks == Sticks::kNo && is_peeled) {
      EXPECT_GT(verdict.peel_number_lower, 1.0);
    } else if (verdict.sticks == Sticks::kNo) {
      EXPECT_LT(verdict.device_pull_off_force_upper, verdict.restoring_force);
    }
    if (verdict.sticks == Sticks::kNo) {
      EXPECT_GE(has_own_force ? evidence.device->contacts : 1 + i % 30, 3);
      ++plain;
    }
    if (verdict.sticks == Sticks::kYes && is_peeled) {
      EXPECT_LT(verdict.peel_number_upper, 1.0);
    } else if (verdict.sticks == Sticks::kYes) {
      EXPECT_GT(verdict.device_pull_off_force_lower, verdict.restoring_force);
    }
  }
  EXPECT_GT(plain, 60);
  EXPECT_GT(pulled, 30);
  EXPECT_GT(peeled, 30);
}

TEST(DeviceVerdict, placesThatAreCutFromScansNeedThreeContactsForAPlainNo) {
  Evidence evidence = found();
  evidence.device->contacts = 2;
  const Verdict verdict = verdictWith(evidence, 50.0);
  EXPECT_EQ(verdict.sticks, Sticks::kUnknown);
  EXPECT_TRUE(says(verdict, "the answer rests on 2 contacts in all scans")) << verdict.reason;
  EXPECT_EQ(verdictWith(evidence, 0.05).sticks, Sticks::kYes);
  evidence.device->contacts = 3;
  EXPECT_EQ(verdictWith(evidence, 50.0).sticks, Sticks::kNo);
}

TEST(DeviceVerdict, fewContactsOfTheScanOrItsBorderDoNotObject) {
  Prediction few = predicted(2);
  for (Asperity& asperity : few.asperities) asperity.is_at_border = true;
  EXPECT_EQ(verdictWith(found(), 5.0, exact(), few).sticks, Sticks::kNo);
  Evidence none;
  DeviceOptions of_scans_size = springOf(5.0);
  of_scans_size.contact_area = kArea;
  EXPECT_EQ(verdictOf(few, of_scans_size, exact(), Options(), kCell, none).sticks,
            Sticks::kUnknown);
  Prediction coarse = predicted();
  for (Asperity& asperity : coarse.asperities) asperity.area = kCell;
  EXPECT_EQ(verdictWith(found(), 5.0, exact(), coarse).sticks, Sticks::kUnknown)
      << "its pixels are those of the scan";
}

TEST(DeviceVerdict, saysWhatToMeasureWhereItIsNotPlain) {
  EXPECT_FALSE(says(verdictWith(found(), 5.0), "measure a field"));
  const Verdict verdict = verdictWith(found(), 1.1);
  EXPECT_EQ(verdict.sticks, Sticks::kMarginal);
  EXPECT_TRUE(says(verdict, "; measure a field of at least 40 um")) << verdict.reason;
}

TEST(DeviceVerdict, doesNotNameALinearRuleThatAgrees) {
  Evidence evidence = found();
  evidence.device->linear_pull_off_force = 1.4 * kOfDevice;
  EXPECT_FALSE(says(verdictWith(evidence, 5.0), "by area"));
  evidence.device->linear_pull_off_force = kOfDevice / 1.6;
  EXPECT_TRUE(says(verdictWith(evidence, 5.0), "the scan's force by area would say margin 8"))
      << "too weak, too";
}

TEST(DeviceVerdict, withoutItsForceItIsUnknown) {
  Evidence evidence;
  evidence.why_no_device = "it is being found";
  const Verdict verdict = verdictWith(evidence, 5.0);
  EXPECT_EQ(verdict.sticks, Sticks::kUnknown);
  EXPECT_TRUE(says(verdict, "has not been found (it is being found)")) << verdict.reason;
  Evidence failed = found();
  failed.device->pull_off_force = std::nan("");
  EXPECT_EQ(verdictWith(failed, 5.0).sticks, Sticks::kUnknown);
  EXPECT_TRUE(
      says(verdictWith(failed, 5.0), "has not been found (measure a field of at least 40 um)"));
}

TEST(DeviceVerdict, beamsTakeTheDevicesWork) {
  DeviceOptions beam;
  beam.contact_area = 100.0 * kArea;
  beam.beam_type = BeamType::kCantilever;
  beam.beam_thickness = 2e-6;
  beam.beam_gap = 1e-6;
  beam.beam_modulus = 169e9;
  beam.beam_length = std::pow(0.375 * 169e9 * 8e-18 * 1e-12 / 1e-4, 0.25) * 0.5;
  const Verdict verdict = verdictOf(predicted(), beam, exact(), Options(), kCell, found());
  EXPECT_DOUBLE_EQ(verdict.device_apparent_work_of_adhesion, 1e-4);
  EXPECT_NEAR(verdict.peel_number, 16.0, 1e-9);
  EXPECT_NEAR(verdict.detachment_length, 2.0 * beam.beam_length, 1e-9 * beam.beam_length);
  EXPECT_NEAR(std::log(verdict.peel_number_upper / 16.0), 2.364624 * 0.5 * kDeviation,
              0.03 * 1.2 * kDeviation);
  EXPECT_TRUE(says(verdict, "peel number 16, 95 % within ")) << verdict.reason;
}

TEST(DeviceVerdict, theHalfSpaceMovesItAsItMovesTheScan) {
  SolvedHalfSpace solution;
  solution.status = HalfSpaceStatus::kSolved;
  solution.is_converged = solution.is_resolved = solution.is_step_converged = true;
  solution.pull_off_force = 1.2 * kPullOff;
  solution.pull_off_uncertainty = 0.0;
  solution.work_of_adhesion = 0.02;
  Evidence evidence = found();
  evidence.half_space = &solution;
  const Verdict verdict = verdictWith(evidence, 6.0);
  EXPECT_EQ(verdict.judge, Judge::kHalfSpace);
  EXPECT_NEAR(verdict.margin, 5.0, 1e-12);
  EXPECT_DOUBLE_EQ(verdict.device_apparent_work_of_adhesion, 2e-4);
}

TEST(DeviceVerdict, ofAllScansTogetherIsThatOfThePart) {
  const Verdict alone = verdictWith(Evidence(), 5.0);
  const std::vector<ScanStatement> scans = {statementOf("a", predicted(), alone),
                                            statementOf("b", predicted(), alone)};
  const Verdict together = verdictWith(found(), 5.0);
  const PooledVerdict part = pooledVerdictOf(scans, together);
  EXPECT_EQ(part.sticks, Sticks::kNo);
  EXPECT_DOUBLE_EQ(part.margin.value, together.margin);
  EXPECT_DOUBLE_EQ(part.margin.lower, together.margin_lower);
  EXPECT_DOUBLE_EQ(part.margin.upper, together.margin_upper);
  EXPECT_EQ(part.counted_scans, 2);
  EXPECT_EQ(part.verdict_by, "prediction");
  EXPECT_TRUE(part.warnings.empty());
  std::vector<ScanStatement> bonded = scans;
  bonded.back().regime_flags = kBondedFlag;
  EXPECT_EQ(pooledVerdictOf(bonded, together).sticks, Sticks::kUnknown);
}

TEST(DeviceScale, followsTheFrame) {
  DeviceScale scale;
  scale.device = *found().device;
  scale.frame_pull_off_force = kPullOff;
  scale.frame_work = 0.01;
  Prediction pressed = predicted();
  pressed.pull_off_force = 3.0 * kPullOff;
  pressed.apparent_work_of_adhesion = 0.02;
  const DeviceEvidence under = scale.under(pressed);
  EXPECT_DOUBLE_EQ(under.pull_off_force, 3.0 * kOfDevice);
  EXPECT_DOUBLE_EQ(under.linear_pull_off_force, 300.0 * kPullOff);
  EXPECT_DOUBLE_EQ(under.apparent_work_of_adhesion, 2e-4);
  EXPECT_EQ(under.force_factors, scale.device.force_factors);
  scale.frame_pull_off_force = 0.0;
  EXPECT_DOUBLE_EQ(scale.under(pressed).pull_off_force, kOfDevice) << "nothing to follow";
}

TEST(DeviceEvidenceOf, isAskedForWhereItDecides) {
  DeviceForceOptions options;
  EXPECT_TRUE(wantsDeviceForce(springOf(3.0), options));
  DeviceOptions device = springOf(3.0);
  device.contact_area = 0.0;
  EXPECT_FALSE(wantsDeviceForce(device, options));
  device = springOf(0.0);
  EXPECT_FALSE(wantsDeviceForce(device, options)) << "nothing opens it";
  options.enabled = false;
  EXPECT_FALSE(wantsDeviceForce(springOf(3.0), options));
}

TEST(VerdictSentence, saysTheWordTheReasonAndWhatWouldMakeItSurer) {
  const auto sentence = [](double of_surfaces, double margin) {
    Verdict verdict;
    verdict.sticks = margin > 2.0 ? Sticks::kNo : Sticks::kMarginal;
    verdict.reason = "the reason";
    verdict.margin = margin;
    verdict.margin_lower = margin / 2.0;
    verdict.margin_upper = margin * 2.0;
    verdict.surface_reach = of_surfaces;
    return verdictSentence(verdict);
  };
  EXPECT_EQ(sentence(0.6, 1.2),
            "Does it stick? Marginal: the reason. Surer by more scans of other places.");
  EXPECT_EQ(sentence(0.3, 1.2),
            "Does it stick? Marginal: the reason. Surer by a work of adhesion that was measured "
            "(calibrate).");
  EXPECT_EQ(sentence(0.6, 4.0), "Does it stick? No: the reason.");
  EXPECT_EQ(verdictSentence(Verdict()).rfind("Does it stick? Not known: ", 0), 0U);
}

TEST(VerdictSentence, knowsWhatTheScansLeaveOpenOfADevice) {
  Evidence evidence = found();
  evidence.device->surface_reach = studentQuantile(7.0) * kDeviation;
  const Verdict verdict = verdictWith(evidence, 1.1);
  ASSERT_EQ(verdict.sticks, Sticks::kMarginal);
  EXPECT_NE(verdictSentence(verdict).find("Surer by more scans"), std::string::npos)
      << "all else is exact";
}

}  // namespace
}  // namespace mems_stiction
