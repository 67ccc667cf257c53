#include "paper/force_balance.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/jkr.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

struct Sphere {
  double radius;
  double work_of_adhesion;
  double cap_radius;
};

// From a hard nanometre asperity to a micrometre ball: nothing is near one.
const std::vector<Sphere> kSpheres = {
    {2e-6, 50e-3, 30e-9}, {100e-9, 10e-3, 3e-9}, {30e-9, 0.3, 8e-9}};

AsperityLaw lawOf(const Sphere& sphere, Formulation formulation) {
  AsperityLaw law;
  law.contact_modulus = 88.8e9;
  law.stiffness = 4.0 / 3.0 * law.contact_modulus;
  law.hardness = 12e9;
  law.work_of_adhesion = sphere.work_of_adhesion;
  law.formulation = formulation;
  return law;
}

AsperityResponse responseOf(const Sphere& sphere, double cap_radius, double elastic_share,
                            const AsperityLaw& law) {
  CapCouple caps;
  caps.cap_radius = cap_radius;
  caps.composite_radius = sphere.radius;
  caps.height = cap_radius * cap_radius / (2.0 * sphere.radius);
  AsperityResponse response(caps, law);
  response.elastic_share = elastic_share;
  return response;
}

/// dE_t/dD at a fixed load along rc drc/dD = R, by central differences.
double slopeOfTotal(const Sphere& sphere, double elastic_share, double load,
                    const AsperityLaw& law) {
  const double step = 1e-4 * sphere.cap_radius * sphere.cap_radius / sphere.radius;
  const auto totalAt = [&](double advance) {
    const double rc =
        std::sqrt(sphere.cap_radius * sphere.cap_radius + 2.0 * sphere.radius * advance);
    return asperityEnergies(responseOf(sphere, rc, elastic_share, law), load, law).total();
  };
  return (totalAt(step) - totalAt(-step)) / (2.0 * step);
}

// Step 1e-4 of the depth: the difference leaves out terms of its square, and keeps twelve digits of
// the energies.
constexpr double kDifference = 1e-6;

TEST(Energies, haveTheGeneralizedForceAsSlopeInEveryRegime) {
  for (const Sphere& sphere : kSpheres) {
    for (const Formulation formulation : {Formulation::kPaper, Formulation::kPrinted}) {
      const AsperityLaw law = lawOf(sphere, formulation);
      for (const double chi : {1.0, 0.7, 0.4, 0.0}) {
        const AsperityResponse response = responseOf(sphere, sphere.cap_radius, chi, law);
        for (const double share : {0.0, 0.2, 0.9, 1.0, 1.7}) {
          const double load = share * response.imposed_load;
          const double scale =
              response.imposed_load + kPi * sphere.work_of_adhesion * sphere.radius;
          EXPECT_NEAR(slopeOfTotal(sphere, chi, load, law), response.generalizedForce(load, law),
                      kDifference * scale);
        }
      }
    }
  }
}

TEST(Energies, areLargestWhereAMixedAsperityRests) {
  for (const Sphere& sphere : kSpheres) {
    const AsperityLaw law = lawOf(sphere, Formulation::kPaper);
    const double unit = kPi * sphere.work_of_adhesion * sphere.radius;
    for (const double chi : {1.0, 0.6, 0.3}) {
      const double load = 2 * unit;
      const double b = load + 3 * unit;
      const double apparent =
          (b + std::sqrt(b * b - chi * (2 - chi) * load * load)) / chi;  // r = 0
      const double rest = jkr::contactRadius(apparent, sphere.radius, law.contact_modulus);
      const auto totalAt = [&](double rc) {
        return asperityEnergies(responseOf(sphere, rc, chi, law), load, law).total();
      };
      for (const double aside : {0.9, 0.99, 1.01, 1.1})
        EXPECT_GT(totalAt(rest), totalAt(aside * rest)) << chi;
    }
  }
}

/// Two asperities of different volume and tilt.
struct TwoAsperities {
  AsperityLaw law = lawOf(kSpheres[0], Formulation::kPaper);
  std::vector<AsperityResponse> responses = {responseOf(kSpheres[0], 30e-9, 1.0, law),
                                             responseOf(kSpheres[0], 50e-9, 0.4, law)};

  TwoAsperities() { responses[1].cos_tilt = 0.5; }
};

TEST(ForceBalance, sharesTheLoadByVolumeAlongEachAxis) {
  const TwoAsperities two;
  const double load = 3e-6;
  const ForceBalance balance = forceBalance(two.responses, load, two.law);
  const double volume = two.responses[0].load_weight + two.responses[1].load_weight;
  const double first = load * two.responses[0].load_weight / volume;
  const double second = load * two.responses[1].load_weight / volume;
  EXPECT_NEAR(balance.load_share, load / volume, 1e-12 * load / volume);
  const double force = two.responses[0].generalizedForce(first, two.law) +
                       two.responses[1].generalizedForce(0.5 * second, two.law);
  EXPECT_NEAR(generalizedForce(two.responses, balance, two.law), force, 1e-12 * load);
  EXPECT_NEAR(balance.carried_load, two.responses[0].carriedLoad() + two.responses[1].carriedLoad(),
              1e-12 * load);
  EXPECT_NEAR(balance.plastic_force, 0.6 * two.responses[1].yield_load,
              1e-12 * two.responses[1].yield_load);

  const Energies energies = totalEnergies(two.responses, balance, two.law);
  Energies expected = asperityEnergies(two.responses[0], first, two.law);
  expected += asperityEnergies(two.responses[1], 0.5 * second, two.law);
  EXPECT_NEAR(energies.mechanical, expected.mechanical, 1e-12 * expected.mechanical);
  EXPECT_NEAR(energies.surface, expected.surface, 1e-12 * expected.surface);
  EXPECT_NEAR(energies.elastic, expected.elastic, 1e-12 * expected.elastic);
}

TEST(ForceBalance, needsBothToCarryTheLoadAndToResist) {
  const Sphere& sphere = kSpheres[0];
  const AsperityLaw law = lawOf(sphere, Formulation::kPaper);
  const double load = 1e-6;
  const double apparent = jkr::apparentLoad(load, law.work_of_adhesion, sphere.radius);
  const double equilibrium = jkr::contactRadius(apparent, sphere.radius, law.contact_modulus);
  const auto balanceAt = [&](double contact_radius, double normal_load) {
    return forceBalance({responseOf(sphere, contact_radius, 1.0, law)}, normal_load, law);
  };
  EXPECT_FALSE(balanceAt(0.999 * equilibrium, load)
                   .is_equilibrium);  // adhesion still pulls the surfaces together
  EXPECT_TRUE(balanceAt(1.001 * equilibrium, load).is_equilibrium);

  // a contact far too small for its load resists too, since (P1 - P0)^2 knows no sign, but it would
  // be crushed
  const double crushing_load = 100.0 * apparent;
  const ForceBalance crushed = balanceAt(equilibrium, crushing_load);
  EXPECT_LT(crushed.carried_load, crushing_load);
  EXPECT_LT(generalizedForce({responseOf(sphere, equilibrium, 1.0, law)}, crushed, law), 0.0);
  EXPECT_FALSE(crushed.is_equilibrium);
}

}  // namespace
}  // namespace mems_stiction
