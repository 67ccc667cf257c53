/// Forces are not scaled further than they go with area.

#include "verdict/contact_size.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mems_stiction/verdict/verdict.hpp"
#include "verdict/part_verdict.hpp"

namespace mems_stiction {
namespace {

constexpr double kArea = 26e-12;
constexpr double kPullOff = 2e-7;

Prediction predicted() {
  Prediction prediction;
  prediction.status = Status::kEquilibrium;
  prediction.nominal_area = kArea;
  prediction.pull_off_force = kPullOff;
  prediction.apparent_work_of_adhesion = 1e-5;
  prediction.pull_off_exponents = prediction.work_exponents = {1.0, 0.0, 0.0};
  prediction.model.error = {0.05, 0.04};
  prediction.model.assumes_jkr = false;
  prediction.asperity_count = prediction.pull_off_contact_count = 25;
  Asperity asperity;
  asperity.composite_radius = 1e-6;
  asperity.area = 2500e-18;
  prediction.asperities.assign(25, asperity);
  return prediction;
}

/// @param margin by the scan's force, scaled to the area
DeviceOptions device(double margin, double area, int contacts = 1) {
  DeviceOptions device;
  device.travel = 1e-6;
  device.contact_area = area;
  device.contacts = contacts;
  device.spring_stiffness = margin * kPullOff * area / kArea / device.travel;
  return device;
}

Verdict verdictFor(const DeviceOptions& device) {
  return verdictOf(predicted(), device, UncertaintyOptions(), Options(), 25e-18);
}

TEST(ContactSize, agreesWithinAFactorOfTwo) {
  for (const double ratio : {0.5, 1.0, 2.0}) {
    EXPECT_TRUE(hasSizeOfScan(predicted(), device(1.0, ratio * kArea))) << ratio;
  }
  for (const double ratio : {0.49, 2.01, 64.0}) {
    EXPECT_FALSE(hasSizeOfScan(predicted(), device(1.0, ratio * kArea))) << ratio;
  }
  EXPECT_TRUE(hasSizeOfScan(predicted(), DeviceOptions()));
}

TEST(ContactSize, isThatOfOneContact) {
  EXPECT_TRUE(hasSizeOfScan(predicted(), device(1.0, 40.0 * kArea, 40)));
  EXPECT_FALSE(hasSizeOfScan(predicted(), device(1.0, kArea, 40)));
}

TEST(ContactSize, whatItLacksNamesBothAreasAndWhatToDo) {
  const std::string objection = whatSizeLacks(predicted(), device(1.0, 104e-12, 1), "");
  for (const char* word : {"1.04e-10", "2.6e-11", "device_force/enabled", "predict_device"}) {
    EXPECT_NE(objection.find(word), std::string::npos) << objection;
  }
  const std::string later =
      whatSizeLacks(predicted(), device(1.0, 104e-12, 1), "it is being found");
  EXPECT_NE(later.find("has not been found (it is being found)"), std::string::npos) << later;
  EXPECT_EQ(later.find("device_force/enabled"), std::string::npos) << later;
}

TEST(ContactSize, beyondItNothingIsScaledByArea) {
  for (const double margin : {50.0, 0.02}) {
    const Verdict fitting = verdictFor(device(margin, kArea));
    EXPECT_EQ(fitting.sticks, margin > 1.0 ? Sticks::kNo : Sticks::kYes);
    EXPECT_NEAR(fitting.margin, margin, 1e-9 * margin);
    const Verdict larger = verdictFor(device(margin, 10.0 * kArea));
    EXPECT_EQ(larger.sticks, Sticks::kUnknown);
    EXPECT_EQ(larger.reason.find("the device's own force has not been found"), 0U) << larger.reason;
    EXPECT_TRUE(std::isnan(larger.margin) && std::isnan(larger.margin_lower) &&
                std::isnan(larger.margin_upper));
    EXPECT_TRUE(std::isnan(larger.device_pull_off_force));
    EXPECT_GT(larger.restoring_force, 0.0);
    EXPECT_EQ(verdictFor(device(margin, 10.0 * kArea, 10)).sticks, fitting.sticks);
  }
}

TEST(ContactSize, holdsForTheHalfSpaceToo) {
  SolvedHalfSpace solution;
  solution.status = HalfSpaceStatus::kSolved;
  solution.is_converged = solution.is_resolved = solution.is_step_converged = true;
  solution.pull_off_force = kPullOff;
  solution.pull_off_uncertainty = 0.0;
  solution.work_of_adhesion = 1e-5;
  Evidence evidence;
  evidence.half_space = &solution;
  const auto judged = [&](double area) {
    return verdictOf(predicted(), device(50.0, area), UncertaintyOptions(), Options(), 25e-18,
                     evidence)
        .sticks;
  };
  EXPECT_EQ(judged(kArea), Sticks::kNo);
  EXPECT_EQ(judged(10.0 * kArea), Sticks::kUnknown);
}

TEST(ContactSize, holdsForBeamsUnlessTheirWorkIsMeasured) {
  DeviceOptions beam = device(0.0, 10.0 * kArea);
  beam.beam_type = BeamType::kCantilever;
  beam.beam_length = 1e-2;
  beam.beam_thickness = 1e-6;
  beam.beam_gap = 1e-6;
  beam.beam_modulus = 169e9;
  EXPECT_EQ(verdictFor(beam).sticks, Sticks::kUnknown);
  EXPECT_TRUE(std::isnan(verdictFor(beam).peel_number));
  beam.apparent_work_of_adhesion = 1e-5;
  EXPECT_EQ(verdictFor(beam).sticks, Sticks::kYes);
  beam.apparent_work_of_adhesion = 0.0;
  beam.contact_area = 0.0;
  const Verdict without_area = verdictFor(beam);
  EXPECT_EQ(without_area.sticks, Sticks::kYes);
  EXPECT_NE(without_area.reason.find("by the scan's work of adhesion"), std::string::npos)
      << without_area.reason;
}

TEST(ContactSize, aScanBeyondItDoesNotCountForThePart) {
  const auto statement = [](const std::string& name, double area) {
    return statementOf(name, predicted(), verdictFor(device(50.0, area)));
  };
  EXPECT_EQ(pooledVerdictOf({statement("a", kArea), statement("b", kArea)}).sticks, Sticks::kNo);
  const PooledVerdict part =
      pooledVerdictOf({statement("a", 10.0 * kArea), statement("b", 10.0 * kArea)});
  EXPECT_EQ(part.sticks, Sticks::kUnknown);
  EXPECT_EQ(part.counted_scans, 0);
  EXPECT_NE(part.reason.find("the device's own force has not been found"), std::string::npos)
      << part.reason;
}

}  // namespace
}  // namespace mems_stiction
