#include "mems_stiction/equilibrium/asperity_response.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "mems_stiction/base/constants.hpp"
#include "mems_stiction/mechanics/jkr.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"

namespace mems_stiction {
namespace {

constexpr double kRoundOff = 1e-12;

struct Sphere {
  double radius;
  double work_of_adhesion;
};

AsperityLaw lawOf(double work_of_adhesion, double plasticity_index, double radius,
                  Formulation formulation = Formulation::kPaper) {
  AsperityLaw law;
  law.contact_modulus = 88.8e9;
  law.stiffness = 4.0 / 3.0 * law.contact_modulus;
  law.hardness = 12e9;
  law.work_of_adhesion = work_of_adhesion;
  law.formulation = formulation;
  const double ratio = plasticity_index * law.hardness / law.contact_modulus;  // (9) solved for sigma
  law.composite_rms_height = radius * (formulation == Formulation::kPrinted ? ratio : ratio * ratio);
  return law;
}

CapCouple capsOf(double cap_radius, double radius) {
  CapCouple caps;
  caps.cap_radius = cap_radius;
  caps.composite_radius = radius;
  caps.height = cap_radius * cap_radius / (2.0 * radius);
  return caps;
}

const std::vector<Sphere> kSpheres = {{2e-6, 50e-3}, {100e-9, 10e-3}, {30e-9, 0.3}};

TEST(AsperityLaw, takesItsConstantsFromBothBodies) {
  Material soft;
  soft.youngs_modulus = 78e9;
  soft.poisson_ratio = 0.44;
  soft.hardness = 1e9;
  const AsperityLaw law(ContactPair(Material(), soft), 0.2, 3e-9, Formulation::kPaper, Deformation::kThreeRegimes);
  const double modulus = 1.0 / ((1 - 0.22 * 0.22) / 169e9 + (1 - 0.44 * 0.44) / 78e9);
  EXPECT_NEAR(law.contact_modulus, modulus, kRoundOff * modulus);
  EXPECT_NEAR(law.stiffness, 4.0 / 3.0 * modulus, kRoundOff * modulus);
  EXPECT_EQ(law.hardness, 1e9);
  const double index = modulus / 1e9 * std::sqrt(3e-9 / 1e-6);  // with the root that the print lost
  EXPECT_NEAR(law.plasticityIndexOf(1e-6), index, kRoundOff * index);
}

TEST(AsperityLaw, losesTheRootInPrint) {
  const AsperityLaw law(ContactPair(Material(), Material()), 0.05, 3e-9, Formulation::kPrinted,
                        Deformation::kThreeRegimes);
  const double index = law.contact_modulus / 12e9 * 3e-9 / 1e-6;
  EXPECT_NEAR(law.plasticityIndexOf(1e-6), index, kRoundOff * index);
}

TEST(AsperityLaw, knowsNoPlasticityWhenAllIsElastic) {
  const AsperityLaw law(ContactPair(Material(), Material()), 0.05, 1e-6, Formulation::kPaper,
                        Deformation::kElastic);
  EXPECT_EQ(law.plasticityIndexOf(1e-9), 0.0);
}

TEST(AsperityResponse, imposesTheApparentLoadOfItsRadius) {
  const AsperityLaw law = lawOf(0.05, 0.85, 1e-6);
  const AsperityResponse response(capsOf(40e-9, 1e-6), law);
  EXPECT_NEAR(response.imposed_load, jkr::apparentLoadOfContact(40e-9, 1e-6, law.contact_modulus),
              kRoundOff * response.imposed_load);
  EXPECT_NEAR(response.yield_load, 12e9 * kPi * 1.6e-15, kRoundOff * response.yield_load);
  EXPECT_NEAR(response.elastic_share, 0.5, 1e-9);  // half-way between 0.6 and 1.1
}

TEST(AsperityResponse, weighsItsShareOfTheLoadByTheCapsVolume) {
  CapCouple caps = capsOf(40e-9, 1e-6);
  caps.height = 5e-9;
  const double volume = (3 * 40e-9 * 40e-9 + 25e-18) * 5e-9;
  EXPECT_NEAR(AsperityResponse(caps, lawOf(0.05, 0.3, 1e-6)).load_weight, volume, kRoundOff * volume);
  const AsperityResponse printed(caps, lawOf(0.05, 0.3, 1e-6, Formulation::kPrinted));
  EXPECT_NEAR(printed.load_weight, volume * 5e-9, kRoundOff * volume * 5e-9);  // (6) to the letter
}

TEST(AsperityResponse, isInEquilibriumWhereTheApparentLoadIsJkrs) {
  for (const Sphere& sphere : kSpheres) {
    const AsperityLaw law = lawOf(sphere.work_of_adhesion, 0.3, sphere.radius);
    const double unit = kPi * sphere.work_of_adhesion * sphere.radius;
    for (const double load : {0.0, 0.1 * unit, unit, 30 * unit}) {
      const double a = jkr::equilibriumContactRadius(load, sphere.work_of_adhesion, sphere.radius, law.contact_modulus);
      const auto forceAt = [&](double cap_radius) {
        return AsperityResponse(capsOf(cap_radius, sphere.radius), law).generalizedForce(load, law);
      };
      EXPECT_NEAR(forceAt(a), 0.0, 1e-9 * unit);
      EXPECT_GT(forceAt(0.99 * a), 0.0);  // still pulled together
      EXPECT_LT(forceAt(1.01 * a), 0.0);
      EXPECT_GE(AsperityResponse(capsOf(a, sphere.radius), law).carriedLoad(), load);
    }
  }
}

TEST(AsperityResponse, isHertzWithoutAdhesion) {
  const double radius = 1e-6;
  const AsperityLaw law = lawOf(0.0, 0.3, radius);
  const double load = 2e-6;
  const double a = std::cbrt(load * radius / law.stiffness);
  const AsperityResponse response(capsOf(a, radius), law);
  EXPECT_NEAR(response.carriedLoad(), load, kRoundOff * load);
  EXPECT_NEAR(response.generalizedForce(load, law), 0.0, kRoundOff * load);
}

TEST(AsperityResponse, isBowdenAndTaborsContactWhenFullyPlastic) {
  for (const Sphere& sphere : kSpheres) {
    const AsperityLaw law = lawOf(sphere.work_of_adhesion, 1.5, sphere.radius);
    const double adhesion = 2 * kPi * sphere.work_of_adhesion * sphere.radius;
    for (const double load : {0.0, adhesion, 10 * adhesion}) {
      // area = (load + adhesion)/Ha
      const double rc = std::sqrt((load + adhesion) / (law.hardness * kPi));
      const AsperityResponse response(capsOf(rc, sphere.radius), law);
      EXPECT_EQ(response.elastic_share, 0.0);
      const double elastic = adhesion - std::pow(response.imposed_load - load, 2) / response.imposed_load / 3;
      EXPECT_NEAR(response.generalizedForce(load, law), std::max(0.0, elastic), 1e-9 * (adhesion + load));
      EXPECT_NEAR(response.carriedLoad(), std::min(response.imposed_load, load + adhesion), 1e-9 * (adhesion + load));
    }
  }
}

TEST(AsperityResponse, neverResistsMoreThanAnElasticOne) {
  for (const Sphere& sphere : kSpheres) {
    const AsperityLaw elastic_law = lawOf(sphere.work_of_adhesion, 0.1, sphere.radius);
    for (const double index : {0.61, 0.7, 0.85, 1.0, 1.09, 1.2, 3.0}) {
      const AsperityLaw law = lawOf(sphere.work_of_adhesion, index, sphere.radius);
      for (double rc = 0.01 * sphere.radius; rc < sphere.radius; rc *= 1.3) {
        const AsperityResponse mixed(capsOf(rc, sphere.radius), law);
        const AsperityResponse elastic(capsOf(rc, sphere.radius), elastic_law);
        ASSERT_LE(mixed.carriedLoad(), elastic.carriedLoad() * (1.0 + kRoundOff));
        for (const double share : {0.0, 0.1, 0.5, 1.0, 2.0}) {
          const double load = share * elastic.imposed_load;
          ASSERT_GE(mixed.generalizedForce(load, law),
                    elastic.generalizedForce(load, elastic_law) - kRoundOff * elastic.imposed_load);
        }
      }
    }
  }
}

TEST(AsperityResponse, mixesBothRegimesByChi) {
  const double radius = 100e-9;
  const AsperityLaw law = lawOf(0.05, 0.7, radius);  // chi = 0.8
  const double rc = 90e-9;                           // far beyond yield
  const AsperityResponse response(capsOf(rc, radius), law);
  ASSERT_GT(response.imposed_load, response.yield_load);
  EXPECT_NEAR(response.elastic_share, 0.8, 1e-9);
  const double load = 0.2 * response.imposed_load;
  const double adhesion = 6 * kPi * 0.05 * radius;
  const double elastic = -(std::pow(response.imposed_load - load, 2) / response.imposed_load - adhesion) / 3;
  const double plastic = load + adhesion / 3 - 12e9 * kPi * rc * rc;
  ASSERT_GT(plastic, elastic);
  EXPECT_NEAR(response.generalizedForce(load, law), 0.8 * elastic + 0.2 * plastic, 1e-9 * load);
  EXPECT_NEAR(response.carriedLoad(), 0.8 * response.imposed_load + 0.2 * response.yield_load, 1e-9 * load);
}

TEST(AsperityResponse, hasThePrintedForceOnRequest) {
  const double radius = 100e-9;
  for (const double index : {0.1, 0.85, 2.0}) {
    const AsperityLaw law = lawOf(0.05, index, radius, Formulation::kPrinted);
    const AsperityResponse response(capsOf(30e-9, radius), law);
    EXPECT_NEAR(response.elastic_share, regimeFactor(index), 1e-9);
    const double p1 = response.imposed_load;
    for (const double p0 : {0.0, 0.3 * p1, p1}) {
      const double chi = response.elastic_share;
      const double expected = (2 * p0 - 2 * p0 * p0 / p1 - chi * (p1 - p0 * p0 / p1) + 6 * kPi * 0.05 * radius) / 3;
      EXPECT_NEAR(response.generalizedForce(p0, law), expected, kRoundOff * p1);
    }
  }
}

TEST(AsperityResponse, isTheSameInBothFormulationsWhenElastic) {
  const double radius = 100e-9;
  const AsperityLaw corrected = lawOf(0.05, 0.1, radius);
  const AsperityLaw printed = lawOf(0.05, 0.1, radius, Formulation::kPrinted);
  const AsperityResponse response(capsOf(20e-9, radius), corrected);
  for (const double share : {0.0, 0.4, 1.0, 1.5}) {
    const double load = share * response.imposed_load;
    EXPECT_NEAR(response.generalizedForce(load, corrected), response.generalizedForce(load, printed),
                kRoundOff * response.imposed_load);
  }
}

TEST(AsperityResponse, takesWhatTheCapsAndTheLawSay) {
  // elastic, between, plastic, and much too large
  for (const double radius : {4e-6, 1e-6, 0.1e-6, 1.0}) {
    CapCouple caps = capsOf(20e-9, radius);
    caps.cos_tilt = 0.9;
    for (const Formulation formulation : {Formulation::kPaper, Formulation::kPrinted}) {
      for (const Deformation deformation : {Deformation::kThreeRegimes, Deformation::kElastic}) {
        AsperityLaw law = lawOf(0.05, 0.85, 1e-6, formulation);
        law.deformation = deformation;
        const AsperityResponse response(caps, law);
        EXPECT_EQ(response.radius, radius);
        EXPECT_EQ(response.cap_radius, 20e-9);
        EXPECT_EQ(response.cos_tilt, 0.9);
        EXPECT_EQ(response.elastic_share, regimeFactor(law.plasticityIndexOf(radius)));
      }
    }
  }
}

}  // namespace
}  // namespace mems_stiction
