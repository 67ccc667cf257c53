#include "paper/asperity_response.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/jkr.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"
#include "numeric/constants.hpp"

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
  const double ratio =
      plasticity_index * law.hardness / law.contact_modulus;  // (9) solved for sigma
  law.composite_rms_height =
      radius * (formulation == Formulation::kPrinted ? ratio : ratio * ratio);
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
  const AsperityLaw law(ContactPair(Material(), soft), 0.2, 3e-9, Formulation::kPaper,
                        Deformation::kThreeRegimes);
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
  EXPECT_NEAR(AsperityResponse(caps, lawOf(0.05, 0.3, 1e-6)).load_weight, volume,
              kRoundOff * volume);
  const AsperityResponse printed(caps, lawOf(0.05, 0.3, 1e-6, Formulation::kPrinted));
  EXPECT_NEAR(printed.load_weight, volume * 5e-9, kRoundOff * volume * 5e-9);  // (6) to the letter
}

TEST(AsperityResponse, isInEquilibriumWhereTheApparentLoadIsJkrs) {
  for (const Sphere& sphere : kSpheres) {
    const AsperityLaw law = lawOf(sphere.work_of_adhesion, 0.3, sphere.radius);
    const double unit = kPi * sphere.work_of_adhesion * sphere.radius;
    for (const double load : {0.0, 0.1 * unit, unit, 30 * unit}) {
      const double a = jkr::equilibriumContactRadius(load, sphere.work_of_adhesion, sphere.radius,
                                                     law.contact_modulus);
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

TEST(AsperityResponse, isJkrsForceWhenElastic) {
  const double radius = 100e-9;
  for (const Formulation formulation : {Formulation::kPaper, Formulation::kPrinted}) {
    const AsperityLaw law = lawOf(0.05, 0.1, radius, formulation);
    const AsperityResponse response(capsOf(20e-9, radius), law);
    const double p1 = response.imposed_load;
    for (const double share : {0.0, 0.4, 1.0, 1.5}) {
      const double expected = -(p1 * std::pow(1.0 - share, 2) - 6 * kPi * 0.05 * radius) / 3;
      EXPECT_NEAR(response.generalizedForce(share * p1, law), expected, kRoundOff * p1);
    }
  }
}

TEST(AsperityResponse, takesStoredEnergyAwayByChiToTheLetter) {
  const double radius = 100e-9;
  for (const Formulation formulation : {Formulation::kPaper, Formulation::kPrinted}) {
    for (const double index : {0.1, 0.7, 0.85, 2.0}) {
      const AsperityLaw law = lawOf(0.05, index, radius, formulation);
      const AsperityResponse response(capsOf(30e-9, radius), law);
      EXPECT_NEAR(response.elastic_share, regimeFactor(index), 1e-9);
      const double p1 = response.imposed_load;
      for (const double p0 : {0.0, 0.3 * p1, p1, 1.5 * p1}) {
        const double chi = response.elastic_share;
        const double expected =
            (2 * p0 - 2 * p0 * p0 / p1 - chi * (p1 - p0 * p0 / p1) + 6 * kPi * 0.05 * radius) / 3;
        EXPECT_NEAR(response.generalizedForce(p0, law), expected, kRoundOff * p1);
      }
    }
  }
}

TEST(AsperityResponse, restsWithLessResistanceOnALargerContact) {
  // r = 0 is chi P1^2 - 2 b P1 + (2 - chi) P0^2 = 0 with b = P0 + 3 pi Gamma R; the force falls at
  // its larger root
  for (const Sphere& sphere : kSpheres) {
    const double unit = kPi * sphere.work_of_adhesion * sphere.radius;
    for (const double chi : {0.9, 0.5, 0.1}) {
      const AsperityLaw law = lawOf(sphere.work_of_adhesion, 1.1 - 0.5 * chi, sphere.radius);
      for (const double load : {0.0, 0.1 * unit, unit, 30 * unit}) {
        const double b = load + 3 * unit;
        const double apparent = (b + std::sqrt(b * b - chi * (2 - chi) * load * load)) / chi;
        const double rc = jkr::contactRadius(apparent, sphere.radius, law.contact_modulus);
        const auto forceAt = [&](double cap_radius) {
          return AsperityResponse(capsOf(cap_radius, sphere.radius), law)
              .generalizedForce(load, law);
        };
        EXPECT_NEAR(forceAt(rc), 0.0, 1e-9 * apparent) << chi;
        EXPECT_GT(forceAt(0.99 * rc), 0.0) << chi;
        EXPECT_LT(forceAt(1.01 * rc), 0.0) << chi;
        EXPECT_GT(rc, jkr::equilibriumContactRadius(load, sphere.work_of_adhesion, sphere.radius,
                                                    law.contact_modulus));
        EXPECT_GE(AsperityResponse(capsOf(rc, sphere.radius), law).carriedLoad(), load);
      }
    }
  }
}

TEST(AsperityResponse, restsWithoutAdhesionOnHertzsContactOfAManifoldLoad) {
  const double radius = 1e-6;
  const double load = 2e-6;
  for (const double chi : {0.8, 0.5, 0.2}) {
    const AsperityLaw law = lawOf(0.0, 1.1 - 0.5 * chi, radius);
    const double a =
        std::cbrt((2.0 - chi) / chi * load * radius / law.stiffness);  // P1 = (2 - chi)/chi P0
    EXPECT_NEAR(AsperityResponse(capsOf(a, radius), law).generalizedForce(load, law), 0.0,
                1e-9 * load)
        << chi;
  }
}

TEST(AsperityResponse, neverRestsWhenFullyPlastic) {
  for (const Sphere& sphere : kSpheres) {
    const AsperityLaw law = lawOf(sphere.work_of_adhesion, 1.5, sphere.radius);
    const double adhesion = 2 * kPi * sphere.work_of_adhesion * sphere.radius;
    for (const double load : {0.0, adhesion, 10 * adhesion}) {
      // from where it carries the load, P1 = P0, on: the more contact, the nearer the pull to
      // adhesion and 2/3 of the load
      const double hertz = std::cbrt(load * sphere.radius / law.stiffness);
      double previous = 0.0;
      for (double rc = std::max(hertz, 1e-3 * sphere.radius) * (1 + 1e-9); rc < sphere.radius;
           rc *= 1.3) {
        const AsperityResponse response(capsOf(rc, sphere.radius), law);
        EXPECT_EQ(response.elastic_share, 0.0);
        const double p1 = law.stiffness * rc * rc * rc / sphere.radius;
        const double force = response.generalizedForce(load, law);
        EXPECT_NEAR(force, adhesion + 2.0 / 3.0 * load * (1.0 - load / p1),
                    1e-9 * (adhesion + load));
        EXPECT_GE(force, previous);
        EXPECT_GE(force, adhesion);
        EXPECT_NEAR(response.carriedLoad(), std::min(p1, 12e9 * kPi * rc * rc), kRoundOff * p1);
        previous = force;
      }
    }
  }
}

TEST(AsperityResponse, resistsLessThanAnElasticOneThatCarriesItsLoad) {
  for (const Sphere& sphere : kSpheres) {
    const AsperityLaw elastic_law = lawOf(sphere.work_of_adhesion, 0.1, sphere.radius);
    for (const double index : {0.61, 0.7, 0.85, 1.0, 1.09, 1.2, 3.0}) {
      const AsperityLaw law = lawOf(sphere.work_of_adhesion, index, sphere.radius);
      for (double rc = 0.01 * sphere.radius; rc < sphere.radius; rc *= 1.3) {
        const AsperityResponse mixed(capsOf(rc, sphere.radius), law);
        const AsperityResponse elastic(capsOf(rc, sphere.radius), elastic_law);
        const double round_off = kRoundOff * elastic.imposed_load;
        ASSERT_LE(mixed.carriedLoad(), elastic.carriedLoad() * (1.0 + kRoundOff));
        for (const double share : {0.0, 0.1, 0.5, 0.99, 1.0, 2.0}) {
          const double load = share * elastic.imposed_load;
          // by the stored energy's (P1^2 - P0^2)/(3 P1) per 1 - chi: turned round where P0 is above
          // P1
          const double relief =
              elastic.imposed_load * (1.0 - share * share) / 3.0 * (1.0 - mixed.elastic_share);
          ASSERT_NEAR(mixed.generalizedForce(load, law),
                      elastic.generalizedForce(load, elastic_law) + relief, 10 * round_off);
          if (share < 1.0) {
            ASSERT_GT(mixed.generalizedForce(load, law),
                      elastic.generalizedForce(load, elastic_law));
          }
        }
      }
    }
  }
}

TEST(AsperityResponse, carriesWhatChiAndTheHardnessLeaveIt) {
  const double radius = 100e-9;
  const AsperityLaw law = lawOf(0.05, 0.7, radius);  // chi = 0.8
  for (const double rc : {5e-9, 90e-9}) {            // before yield, far beyond it
    const AsperityResponse response(capsOf(rc, radius), law);
    const double p1 = law.stiffness * rc * rc * rc / radius;
    const double yield = 12e9 * kPi * rc * rc;
    EXPECT_EQ(p1 > yield, rc > 50e-9);
    EXPECT_NEAR(response.carriedLoad(), 0.8 * p1 + 0.2 * std::min(p1, yield), 1e-9 * p1);
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
