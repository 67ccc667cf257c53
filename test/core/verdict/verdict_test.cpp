#include "mems_stiction/verdict/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/paper_options.hpp"
#include "verdict/finding.hpp"
#include "verdict/margin_uncertainty.hpp"
#include "verdict/part_verdict.hpp"
#include "verdict/regime_flags.hpp"
#include "verdict/verdict_fields.hpp"

namespace mems_stiction {
namespace {

constexpr double kNm = 1e-9;
constexpr double kRadius = 2e-6;
constexpr double kCell = 4e-18;

/// 20 spheres on a flat without van der Waals forces: pull-off 20 (3/2) pi w R.
struct Spheres {
  Options options = paperOptions();
  HeightMap surface = analytic::sphereArray(4 * 90, 5 * 90, 2 * kNm, 2 * kNm, {kRadius}, 5, 4);
  Prediction prediction;

  Spheres() {
    options.interface.hamaker_constant = 0.0;
    prediction = AdhesionModel(options).predict(surface);
  }
  double pullOff() const { return 20 * 1.5 * kPi * options.interface.work_of_adhesion * kRadius; }
};

DeviceOptions springOf(double force, double area) {
  DeviceOptions device;
  device.travel = 1e-6;
  device.spring_stiffness = force / device.travel;
  device.contact_area = area;
  return device;
}

Verdict verdictFor(const Spheres& spheres, const DeviceOptions& device,
                   const UncertaintyOptions& uncertainty = UncertaintyOptions()) {
  return verdictOf(spheres.prediction, device, uncertainty, spheres.options, kCell);
}

TEST(Verdict, takesTheScansForceForEachContactOfItsSize) {
  const Spheres spheres;
  DeviceOptions device =
      springOf(2.0 * 3.0 * spheres.pullOff(), 3.0 * spheres.prediction.nominal_area);
  device.contacts = 3;  // each of the scan's size
  const Verdict verdict = verdictFor(spheres, device);
  EXPECT_NEAR(verdict.restoring_force, 6.0 * spheres.pullOff(), 1e-12 * verdict.restoring_force);
  // composite radius of a cap cut at pixels: 3 %
  EXPECT_NEAR(verdict.device_pull_off_force, 3.0 * spheres.pullOff(),
              0.03 * verdict.device_pull_off_force);
  EXPECT_NEAR(verdict.margin, 2.0, 0.06);
  EXPECT_LT(verdict.margin_lower, verdict.margin);
  EXPECT_GT(verdict.margin_upper, verdict.margin);
  EXPECT_LE(verdict.margin_transition, verdict.margin);
  EXPECT_GE(verdict.margin_transition, 0.75 * verdict.margin);  // prefactors 2 and 1.5
}

TEST(Verdict, answersNoMarginalAndYes) {
  const Spheres spheres;
  const double area = spheres.prediction.nominal_area;
  EXPECT_EQ(verdictFor(spheres, springOf(10.0 * spheres.pullOff(), area)).sticks, Sticks::kNo);
  EXPECT_EQ(verdictFor(spheres, springOf(1.05 * spheres.pullOff(), area)).sticks,
            Sticks::kMarginal);
  const Verdict stuck = verdictFor(spheres, springOf(0.1 * spheres.pullOff(), area));
  EXPECT_EQ(stuck.sticks, Sticks::kYes);
  EXPECT_NE(stuck.reason.find("margin 0.1"), std::string::npos);
}

TEST(Verdict, saysWhatPressedTheContactsIfTheyFlowed) {
  Options options;
  options.lower.hardness = options.upper.hardness = 0.5e9;
  const HeightMap surface = analytic::sphereArray(60, 60, 2 * kNm, 2 * kNm, {100 * kNm}, 2, 2);
  const double area = 60 * 60 * kCell;
  const auto reasonUnder = [&](double pressure, double contact_potential = 0.0) {
    options.load.mechanical_load = pressure * area;
    options.load.contact_potential = contact_potential;
    const Prediction prediction = AdhesionModel(options).predict(surface);
    return verdictOf(prediction, springOf(1e-6, area), UncertaintyOptions(), options, kCell).reason;
  };
  EXPECT_NE(reasonUnder(30e6).find("; after 30 MPa, under which contacts have flowed"),
            std::string::npos);
  EXPECT_EQ(reasonUnder(0.0).find("after"), std::string::npos);
  options.interface.insulator_thickness = 4 * kNm;
  EXPECT_NE(reasonUnder(0.0, -20.0)
                .find("; after 20 V of contact potential, under which contacts have flowed"),
            std::string::npos);
  EXPECT_NE(reasonUnder(30e6, 20.0).find("; after 30 MPa and 20 V of contact potential, under"),
            std::string::npos);
  options.lower.hardness = options.upper.hardness = 1e12;
  EXPECT_EQ(reasonUnder(30e6).find("after"), std::string::npos);
}

TEST(Verdict, writesNumbersForPeople) {
  const Spheres spheres;
  const double area = spheres.prediction.nominal_area;
  const double held = spheres.prediction.pull_off_force;
  const auto reasonFor = [&](double margin) {
    return verdictFor(spheres, springOf(margin * held, area)).reason;
  };
  EXPECT_EQ(reasonFor(12.34).find("margin 12.3, 95 % within "), 0U);
  EXPECT_EQ(reasonFor(999.96).find("margin 1000, 95 % within "), 0U);
  EXPECT_EQ(reasonFor(136468.0).find("margin 136000, 95 % within "), 0U);
  EXPECT_EQ(reasonFor(0.02994).find("margin 0.0299, 95 % within "), 0U);
}

TEST(Verdict, exactConstantsStillLeaveTheTheoriesApart) {
  const Spheres spheres;
  UncertaintyOptions exact;
  exact.work_of_adhesion = exact.hardness = exact.youngs_modulus = exact.pitch =
      exact.cutoff_distance = 0.0;
  exact.hamaker_constant = 0.0;
  exact.scan_sampling = false;
  const double between =
      0.5 * (spheres.prediction.pull_off_force_transition + spheres.prediction.pull_off_force);
  const Verdict verdict =
      verdictFor(spheres, springOf(between, spheres.prediction.nominal_area), exact);
  EXPECT_EQ(verdict.sticks, Sticks::kMarginal);
  EXPECT_GT(verdict.margin_lower, 1.0);
  EXPECT_NEAR(verdict.margin_uncertainty, 0.0, 1e-12);
  EXPECT_LT(verdict.margin_transition, 1.0);
}

TEST(Verdict, intervalHoldsNinetyFivePercentOfTheMargins) {
  const Spheres spheres;
  UncertaintyOptions uncertainty;
  uncertainty.hardness = uncertainty.youngs_modulus = uncertainty.pitch =
      uncertainty.cutoff_distance = 0.0;
  uncertainty.scan_sampling = false;
  uncertainty.work_of_adhesion = 0.1;
  uncertainty.samples = 20000;
  const Verdict verdict = verdictFor(
      spheres, springOf(spheres.pullOff(), spheres.prediction.nominal_area), uncertainty);
  // no load, no van der Waals: the demand is all adhesion, growth ~ w, pull-off ~ w^2; margins
  // lognormal
  const double deviation = 2.0 * std::sqrt(std::log1p(0.01));
  EXPECT_NEAR(std::log(verdict.margin_lower / verdict.margin), -1.96 * deviation,
              0.05 * 1.96 * deviation);
  EXPECT_NEAR(std::log(verdict.margin_upper / verdict.margin), 1.96 * deviation,
              0.05 * 1.96 * deviation);
  EXPECT_NEAR(verdict.margin_uncertainty / verdict.margin, std::sinh(deviation), 0.05 * deviation);
}

TEST(Verdict, isUnknownWithItsReasonWhenTheDeviceIsNotStated) {
  const Spheres spheres;
  DeviceOptions device = springOf(1e-3, 0.0);
  const Verdict verdict = verdictFor(spheres, device);
  EXPECT_EQ(verdict.sticks, Sticks::kUnknown);
  EXPECT_NE(verdict.reason.find("device/contact_area"), std::string::npos);
  EXPECT_EQ(verdict.restoring_force, 1e-3);
  EXPECT_TRUE(std::isnan(verdict.margin));
  EXPECT_TRUE(std::isnan(verdict.peel_number));
  EXPECT_TRUE(std::isnan(verdict.device_apparent_work_of_adhesion))
      << "nobody asks for what the paper's formulation lacks";
}

TEST(Verdict, bondedSurfacesCanSayYesButNotNo) {
  Spheres spheres;
  spheres.prediction.status = Status::kBonded;
  const double area = spheres.prediction.nominal_area;
  EXPECT_EQ(verdictFor(spheres, springOf(0.1 * spheres.pullOff(), area)).sticks, Sticks::kYes);
  const Verdict unsure = verdictFor(spheres, springOf(10.0 * spheres.pullOff(), area));
  EXPECT_EQ(unsure.sticks, Sticks::kUnknown);
  EXPECT_NE(unsure.reason.find("bond"), std::string::npos);
}

TEST(Verdict, isUnknownWhereNothingTellsHowFarTheMarginMayBeOff) {
  const Spheres listed;
  const DeviceOptions strong = springOf(10.0 * listed.pullOff(), listed.prediction.nominal_area);
  ASSERT_EQ(verdictFor(listed, strong).sticks, Sticks::kNo);
  Spheres spheres;
  spheres.prediction.asperities.clear();
  const DeviceOptions weak = springOf(0.1 * spheres.pullOff(), spheres.prediction.nominal_area);
  for (const Status status : {Status::kEquilibrium, Status::kBonded}) {
    spheres.prediction.status = status;
    for (const DeviceOptions& device : {strong, weak}) {
      const Verdict verdict = verdictFor(spheres, device);
      EXPECT_EQ(verdict.sticks, Sticks::kUnknown);
      EXPECT_NE(verdict.reason.find("output/asperities"), std::string::npos) << verdict.reason;
      EXPECT_EQ(verdict.margin, verdictFor(listed, device).margin);
      EXPECT_TRUE(std::isnan(verdict.margin_lower));
      EXPECT_TRUE(std::isnan(verdict.margin_upper));
      EXPECT_TRUE(std::isnan(verdict.margin_uncertainty));
    }
  }
  spheres.prediction.has_asperities = false;  // of a solver that parts the contact into none
  EXPECT_NE(verdictFor(spheres, strong).reason.find("approach/formulation"), std::string::npos);
}

TEST(Verdict, ofABeamIsUnknownWithoutTheContactsThatItsAdhesionIsSummedOver) {
  Spheres spheres;
  spheres.prediction.asperities.clear();
  DeviceOptions device;
  device.beam_type = BeamType::kCantilever;
  device.beam_length = 50e-6;
  device.beam_thickness = 2e-6;
  device.beam_gap = 2e-6;
  device.beam_modulus = 160e9;
  const Verdict unmeasured = verdictFor(spheres, device);
  EXPECT_EQ(unmeasured.sticks, Sticks::kUnknown);
  EXPECT_NE(unmeasured.reason.find("output/asperities"), std::string::npos) << unmeasured.reason;
  EXPECT_TRUE(std::isnan(unmeasured.peel_number_lower));
  EXPECT_TRUE(std::isnan(unmeasured.peel_number_upper));
  device.apparent_work_of_adhesion = 1e-3;  // measured on beams: no contacts are needed
  EXPECT_NE(verdictFor(spheres, device).sticks, Sticks::kUnknown);
}

TEST(Verdict, anEndedSearchSaysNothing) {
  Spheres spheres;
  spheres.prediction.status = Status::kNoEquilibrium;
  const Verdict verdict = verdictFor(spheres, springOf(1.0, spheres.prediction.nominal_area));
  EXPECT_EQ(verdict.sticks, Sticks::kUnknown);
  EXPECT_NE(verdict.reason.find("approach/max_steps"), std::string::npos);
}

TEST(Verdict, noAdhesionDoesNotStick) {
  Spheres spheres;
  spheres.prediction.pull_off_force = 0.0;
  spheres.prediction.pull_off_force_jkr = spheres.prediction.pull_off_force_transition = 0.0;
  const Verdict verdict = verdictFor(spheres, springOf(1e-9, spheres.prediction.nominal_area));
  EXPECT_EQ(verdict.sticks, Sticks::kNo);
  EXPECT_TRUE(std::isinf(verdict.margin));
}

DeviceOptions cantilever(double length) {
  DeviceOptions device;
  device.beam_type = BeamType::kCantilever;
  device.beam_length = length;
  device.beam_thickness = device.beam_gap = 2e-6;
  device.beam_modulus = 169e9;
  return device;
}

TEST(Verdict, judgesABeamByItsPeelNumber) {
  const Spheres spheres;
  DeviceOptions device = cantilever(500e-6);
  device.apparent_work_of_adhesion = 32.448e-6;  // arc at 500 um
  const Verdict verdict = verdictFor(spheres, device);
  EXPECT_NEAR(verdict.peel_number, 1.0, 1e-4);  // published to five digits
  EXPECT_NEAR(verdict.detachment_length, 500e-6, 500e-6 * 1e-4);
  EXPECT_TRUE(std::isnan(verdict.margin));
  device.apparent_work_of_adhesion = 129.792e-6;
  EXPECT_EQ(verdictFor(spheres, device).sticks, Sticks::kYes);
  EXPECT_NEAR(verdictFor(spheres, device).unstuck_length, 500e-6, 500e-6 * 1e-4);
  device.apparent_work_of_adhesion = 8e-6;
  EXPECT_EQ(verdictFor(spheres, device).sticks, Sticks::kNo);
}

TEST(Verdict, takesTheContactsEnergyForABeamUnlessStated) {
  const Spheres spheres;
  const Verdict verdict = verdictFor(spheres, cantilever(100e-6));
  EXPECT_NEAR(verdict.device_apparent_work_of_adhesion,
              apparentWorkOfAdhesion(spheres.prediction, spheres.options), 0.0);
  EXPECT_NEAR(verdict.peel_number,
              peelNumber(cantilever(100e-6).beam(), verdict.device_apparent_work_of_adhesion),
              1e-12);
  EXPECT_LT(verdict.peel_number_lower, verdict.peel_number);
  EXPECT_GT(verdict.peel_number_upper, verdict.peel_number);
}

TEST(Verdict, countsTheWorseOfSpringAndBeam) {
  const Spheres spheres;
  DeviceOptions device = springOf(10.0 * spheres.pullOff(), spheres.prediction.nominal_area);
  const DeviceOptions beam = cantilever(2e-3);
  device.beam_type = beam.beam_type;
  device.beam_length = beam.beam_length;
  device.beam_thickness = device.beam_gap = beam.beam_gap;
  device.beam_modulus = beam.beam_modulus;
  device.apparent_work_of_adhesion = 1e-3;
  const Verdict verdict = verdictFor(spheres, device);
  EXPECT_GT(verdict.margin_lower, 1.0);
  EXPECT_LT(verdict.peel_number, 1.0);
  EXPECT_EQ(verdict.sticks, Sticks::kYes);
  EXPECT_NE(verdict.reason.find("peel number"), std::string::npos);
}

/// Whatever decides of the beam: a short contact opens by its force, a long one is peeled.
TEST(Verdict, neverImprovesByASpringBesideABeam) {
  const Spheres spheres;
  for (const double reach_share : {1e-3, 0.9}) {
    for (const double length : {50e-6, 100e-6, 300e-6, 1000e-6}) {
      DeviceOptions beam = cantilever(length);
      beam.contact_area = spheres.prediction.nominal_area;
      beam.beam_width = beam.contact_area / (reach_share * length);
      const Verdict of_beam = verdictFor(spheres, beam);
      for (const double margin : {1e-2, 1.0, 1e2}) {
        DeviceOptions both = springOf(margin * spheres.pullOff(), beam.contact_area);
        const Verdict of_spring = verdictFor(spheres, both);
        both.beam_type = beam.beam_type;
        both.beam_length = beam.beam_length;
        both.beam_width = beam.beam_width;
        both.beam_thickness = beam.beam_thickness;
        both.beam_gap = beam.beam_gap;
        both.beam_modulus = beam.beam_modulus;
        const Verdict verdict = verdictFor(spheres, both);
        const std::string what = "length " + std::to_string(length) + ", spring's margin " +
                                 std::to_string(margin) + ": " + verdict.reason;
        EXPECT_EQ(gravity(verdict.sticks),
                  std::max(gravity(of_beam.sticks), gravity(of_spring.sticks)))
            << what;
        if (isPeeled(of_beam)) {
          EXPECT_DOUBLE_EQ(verdict.peel_number, of_beam.peel_number) << what;
        } else {
          EXPECT_DOUBLE_EQ(verdict.margin, std::min(of_beam.margin, of_spring.margin)) << what;
          EXPECT_DOUBLE_EQ(verdict.restoring_force,
                           std::min(beamForce(beam.beam()), of_spring.restoring_force))
              << what;
        }
      }
    }
  }
}

TEST(Verdict, judgesAShortContactOfABeamByItsForceAndALongOneByItsWork) {
  const Spheres spheres;
  DeviceOptions device = cantilever(300e-6);
  device.contact_area = spheres.prediction.nominal_area;
  device.beam_width = 20e-6;
  const Verdict pulled = verdictFor(spheres, device);
  EXPECT_EQ(pulled.governed_by, kGovernedByForce);
  EXPECT_DOUBLE_EQ(pulled.margin, beamForce(device.beam()) / pulled.device_pull_off_force);
  EXPECT_DOUBLE_EQ(pulled.margin_lower,
                   pulled.restoring_force / pulled.device_pull_off_force_upper);
  EXPECT_EQ(pulled.reason.rfind("margin ", 0), 0U) << pulled.reason;
  EXPECT_NE(pulled.reason.find("the margin decides, the worse of both (peel number "),
            std::string::npos)
      << pulled.reason;
  EXPECT_EQ(statementOf("a", spheres.prediction, pulled).peel_number.value, pulled.peel_number);

  device.beam_width = device.contact_area / (0.9 * device.beam_length);
  const Verdict peeled = verdictFor(spheres, device);
  EXPECT_EQ(peeled.governed_by, kGovernedByPeeling);
  EXPECT_DOUBLE_EQ(peeled.peel_number, pulled.peel_number) << "per width";
  EXPECT_EQ(peeled.reason.rfind("peel number ", 0), 0U) << peeled.reason;
  EXPECT_NE(peeled.reason.find("the peel number decides (margin "), std::string::npos)
      << peeled.reason;
  EXPECT_EQ(peeled.reason.substr(peeled.reason.size() - 9), " m, peels");
  EXPECT_EQ(statementOf("a", spheres.prediction, peeled).margin.value, peeled.margin);

  device.beam_width = 0.0;
  const Verdict unstated = verdictFor(spheres, device);
  EXPECT_EQ(unstated.governed_by, "");
  EXPECT_TRUE(std::isnan(unstated.margin));
}

/// A contact that would open with its force may hold more than the beam peels off.
TEST(Verdict, ofABeamWithoutItsWidthIsNoPlainNo) {
  const Spheres spheres;
  DeviceOptions device = cantilever(30e-6);
  EXPECT_EQ(verdictFor(spheres, device).sticks, Sticks::kNo) << "no contact is stated";
  device.contact_area = spheres.prediction.nominal_area;
  const Verdict verdict = verdictFor(spheres, device);
  EXPECT_GT(verdict.peel_number_lower, 1.0);
  EXPECT_EQ(verdict.sticks, Sticks::kUnknown);
  EXPECT_NE(verdict.reason.find("device/beam_width"), std::string::npos) << verdict.reason;
}

TEST(Verdict, ofABeamThatBucklesIsUnknown) {
  const Spheres spheres;
  DeviceOptions device = cantilever(300e-6);
  device.beam_type = BeamType::kDoublyClamped;
  device.beam_width = 20e-6;
  device.contact_area = spheres.prediction.nominal_area;
  const double limit = bucklingStress(device.beam());
  EXPECT_NEAR(limit, -kPi * kPi * 169e9 * 4e-12 / (3.0 * 9e-8), 1e-6 * std::abs(limit));
  device.beam_residual_stress = 0.9 * limit;
  EXPECT_GT(verdictFor(spheres, device).margin, 0.0);
  EXPECT_GT(verdictFor(spheres, device).peel_number, 0.0);
  device.beam_residual_stress = 1.1 * limit;
  const Verdict verdict = verdictFor(spheres, device);
  EXPECT_EQ(verdict.sticks, Sticks::kUnknown);
  EXPECT_EQ(verdict.reason.rfind("the beam buckles: ", 0), 0U) << verdict.reason;
  EXPECT_TRUE(std::isnan(verdict.margin));
  EXPECT_TRUE(std::isnan(verdict.restoring_force));
  device.beam_type = BeamType::kCantilever;
  EXPECT_TRUE(std::isinf(bucklingStress(device.beam())));
}

/// Widths that take the contact from beyond all lengths over which adhesion may give way to below
/// them: between, no answer is better than the worse of force and peeling.
TEST(Verdict, takesTheWorseOfForceAndPeelingWhereTheLengthOfTheContactLeavesItOpen) {
  const Spheres spheres;
  int open = 0;
  std::string last;
  for (const double length : {100e-6, 200e-6, 300e-6, 400e-6, 600e-6}) {
    DeviceOptions device = cantilever(length);
    device.contact_area = spheres.prediction.nominal_area;
    for (double share = 0.9; share > 1e-4; share *= 0.95) {
      device.beam_width = device.contact_area / (share * device.beam_length);
      const Verdict verdict = verdictFor(spheres, device);
      if (verdict.reason.find("the worse of both") == std::string::npos) continue;
      ++open;
      EXPECT_NE(verdict.reason.find(" m along the beam may open as a whole or peel, as any from "),
                std::string::npos)
          << verdict.reason;
      const auto wordOf = [](double lower, double upper) {
        return upper < 1.0 ? Sticks::kYes : lower > 1.0 ? Sticks::kNo : Sticks::kMarginal;
      };
      const Sticks by_force =
          wordOf(std::min(verdict.margin_lower, verdict.margin_transition), verdict.margin_upper);
      const Sticks by_peeling = wordOf(verdict.peel_number_lower, verdict.peel_number_upper);
      const bool is_force_worse = gravity(by_force) > gravity(by_peeling);
      EXPECT_EQ(verdict.sticks, is_force_worse ? by_force : by_peeling) << verdict.reason;
      if (by_force != by_peeling) {
        EXPECT_EQ(verdict.governed_by, is_force_worse ? kGovernedByForce : kGovernedByPeeling)
            << verdict.reason;
        last = verdict.reason;
      } else {
        EXPECT_EQ(verdict.governed_by,
                  verdict.margin < verdict.peel_number ? kGovernedByForce : kGovernedByPeeling)
            << verdict.reason;
      }
    }
  }
  EXPECT_GT(open, 5) << "widths near the threshold";
  EXPECT_NE(last, "") << "where force and peeling say two things";
}

TEST(VerdictFields, showEveryFigureOnce) {
  Verdict verdict;
  std::set<std::string> names;
  std::set<const void*> places;
  std::size_t size = 0;
  visitVerdictFields(verdict, [&](const Figure& figure, auto& value) {
    names.insert(figure.name);
    places.insert(&value);
    if (std::is_same<std::decay_t<decltype(value)>, double>::value) size += sizeof(double);
  });
  EXPECT_EQ(names.size(), 20u);
  EXPECT_EQ(places.size(), 20u);
  // a figure that is added to the struct and not to the list makes this fail: words before, flags
  // after the figures
  const auto* first = reinterpret_cast<const char*>(&verdict.restoring_force);
  EXPECT_EQ(reinterpret_cast<const char*>(&verdict.regime_flags) - first,
            static_cast<std::ptrdiff_t>(size));
}

TEST(RegimeFlags, nameWhatLeavesTheModel) {
  Spheres spheres;
  const std::uint32_t flags = regimeFlags(spheres.prediction, kCell);
  EXPECT_TRUE(flags & kTaborFlag);  // 2 um, 50 mJ/m^2: Tabor's parameter about 0.4
  EXPECT_FALSE(flags & (kBondedFlag | kNoEquilibriumFlag | kResolutionFlag | kFewContactsFlag));
  EXPECT_TRUE(regimeFlags(spheres.prediction, 1e3 * kCell) &
              kResolutionFlag);  // the same contacts on coarse pixels
  spheres.prediction.status = Status::kBonded;
  for (Asperity& asperity : spheres.prediction.asperities) asperity.regime = Regime::kPlastic;
  spheres.prediction.pull_off_contact_count = 9;
  const std::uint32_t more = regimeFlags(spheres.prediction, kCell);
  EXPECT_EQ(regimeFlagNames(more), "bonded, tabor, plasticity, few_contacts");
  EXPECT_EQ(regimeFlagNames(0), "");
}

TEST(RegimeFlags, doWithoutAListOfContacts) {
  Spheres spheres;
  const std::uint32_t with_list = regimeFlags(spheres.prediction, kCell);
  spheres.prediction.asperities.clear();
  EXPECT_EQ(regimeFlags(spheres.prediction, kCell), with_list);
  EXPECT_TRUE(regimeFlags(spheres.prediction, 1e3 * kCell) & kResolutionFlag);
}

}  // namespace
}  // namespace mems_stiction
