/// The law of adhesion counted from contact, and the layer that it puts between the bodies.

#include "separation/contact_traction.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

InterfaceOptions interfaceOf(double work, double hamaker) {
  InterfaceOptions interface;
  interface.work_of_adhesion = work;
  interface.hamaker_constant = hamaker;
  return interface;
}

const InterfaceOptions kSilica = interfaceOf(0.05, 65e-21);

TEST(ContactTraction, isTheLawOfAdhesionCountedFromContact) {
  const ContactTraction law(kSilica);
  const AdhesionLaw adhesion(0.05, AdhesionLaw::rangeOf(0.05, 65e-21));
  EXPECT_DOUBLE_EQ(law.range(), adhesion.range());
  EXPECT_DOUBLE_EQ(law.stress(), adhesion.stress());
  EXPECT_DOUBLE_EQ(law.strength(), adhesion.strength());
  EXPECT_NEAR(law.traction(law.strongestGap()) / adhesion.strength(), 1.0, 1e-14);
  EXPECT_EQ(law.traction(0.0), 0.0);
  for (const double gap : {0.0, 0.05, 0.2, 1.0, 7.0, 600.0}) {  // of z0
    const double d = gap * law.range();
    const double x = 1.0 / (1.0 + gap);
    EXPECT_NEAR(law.traction(d) / law.strength(), adhesion.traction(x) / adhesion.strength(), 1e-14)
        << gap;
    EXPECT_NEAR(law.energy(d) / adhesion.energy(x), 1.0, 1e-14) << gap;
    EXPECT_NEAR(law.curvature(d) / adhesion.curvature(x), 1.0, 1e-13) << gap;
  }
}

/// Polysilicon under 2 nm of native oxide, retarded.
ContactTraction coatedLaw() {
  InterfaceOptions interface = kSilica;
  interface.retardation_length = 20e-9;
  Material body;
  body.film_thickness = 2e-9;
  body.hamaker_constant = 261e-21;
  return ContactTraction(interface, body, body);
}

TEST(ContactTraction, underFilmsHasTheWorkOfAdhesionAndItsDerivatives) {
  const ContactTraction law = coatedLaw();
  EXPECT_NEAR(law.energy(0.0) / 0.05, 1.0, 1e-12);
  EXPECT_NEAR(law.traction(0.0) / law.stress(), 0.0, 1e-12);
  for (double d = 0.05 * law.range(); d < 1e-7; d *= 2.3) {
    const double h = 1e-4 * (d + law.range());
    EXPECT_NEAR((law.energy(d - h) - law.energy(d + h)) / (2.0 * h) / law.traction(d), 1.0, 1e-4)
        << d;
    EXPECT_NEAR((law.slope(d + h) - law.slope(d - h)) / (2.0 * h) / law.curvature(d), 1.0, 1e-4)
        << d;
    const double slope = (law.traction(d + h) - law.traction(d - h)) / (2.0 * h);
    EXPECT_NEAR((slope - law.slope(d)) * law.range() / law.stress(), 0.0, 1e-4) << d;
  }
}

TEST(ContactTraction, underFilmsMeansOverGapsAreThoseOfTheirMoments) {
  // two gaps: the terms of the fourth order are below 1e-7 of the sum
  for (const ContactTraction& law : {ContactTraction(kSilica), coatedLaw()}) {
    for (const double gap : {1e-9, 30e-9}) {
      const double h = 0.01 * gap;
      EXPECT_NEAR(
          0.5 * (law.traction(gap - h) + law.traction(gap + h)) / law.meanTraction(gap, h * h), 1.0,
          1e-6);
      EXPECT_NEAR(0.5 * (law.energy(gap - h) + law.energy(gap + h)) / law.meanEnergy(gap, h * h),
                  1.0, 1e-6);
    }
  }
}

TEST(ContactTraction, underFilmsIsThatOfPlatesFarApart) {
  const LayeredAttraction plates(65e-21, {2e-9, 261e-21}, {2e-9, 261e-21}, 20e-9);
  const ContactTraction law = coatedLaw();
  for (const double gap : {10e-9, 45e-9}) {  // (z0/d)^6 is below 1e-10
    const double distance = gap + law.range();
    EXPECT_NEAR(law.traction(gap) / plates.at(distance).traction, 1.0, 1e-9);
    EXPECT_NEAR(law.energy(gap) / plates.at(distance).energy, 1.0, 1e-9);
  }
}

TEST(ContactTraction, withoutWorkOfAdhesionNothingAttractsAndNothingGivesWay) {
  const ContactTraction law(interfaceOf(0.0, 65e-21));
  EXPECT_FALSE(law.attracts());
  EXPECT_EQ(law.traction(1e-10), 0.0);
  EXPECT_EQ(law.strength(), 0.0);
  EXPECT_EQ(law.pressureInSeries(3e9, 1e-10), 3e9);
  EXPECT_EQ(law.pressureInSeries(-1.0, 1e-10), 0.0);
}

TEST(ContactTraction, withoutHamakerConstantTheRangeIsTheEquilibriumDistance) {
  InterfaceOptions interface = interfaceOf(0.05, 0.0);
  interface.equilibrium_distance = 0.3e-9;
  const ContactTraction law(interface);
  EXPECT_EQ(law.range(), 0.3e-9);
  EXPECT_TRUE(law.attracts());
}

/// The balance of layer and bodies by bisection.
double bisectedPressure(const ContactTraction& law, double elastic, double depth) {
  double low = 0.0;
  double high = std::min(depth, 0.6 * law.range());
  for (int i = 0; i < 200; ++i) {
    const double s = 0.5 * (low + high);
    const double x = law.range() / (law.range() - s);
    const double layer = law.stress() * (std::pow(x, 9.0) - std::pow(x, 3.0));
    (layer < elastic * (1.0 - s / depth) ? low : high) = s;
  }
  return elastic * (1.0 - 0.5 * (low + high) / depth);
}

TEST(ContactTraction, layerAndBodiesCarryTheSame) {
  const ContactTraction law(kSilica);
  for (const double stiffness : {0.01, 0.3, 3.0, 30.0}) {      // of the bodies against the layer's
    for (const double depth : {1e-4, 0.03, 0.5, 3.0, 50.0}) {  // of z0
      const double elastic = stiffness * law.stress() * depth;
      const double found = law.pressureInSeries(elastic, depth * law.range());
      EXPECT_NEAR(found / bisectedPressure(law, elastic, depth * law.range()), 1.0, 1e-5)
          << stiffness << " " << depth;
      EXPECT_LE(found, elastic);
    }
  }
}

TEST(ContactTraction, underFilmsLayerAndBodiesCarryTheSame) {
  InterfaceOptions interface = kSilica;
  interface.retardation_length = 0.3e-9;  // much shorter than any: the attraction falls steeply
  Material weak;
  weak.film_thickness = 0.1e-9;
  weak.hamaker_constant = 1e-21;
  for (const ContactTraction& law : {coatedLaw(), ContactTraction(interface, weak, weak)}) {
    for (const double stiffness : {0.01, 0.3, 3.0, 30.0}) {  // of the bodies against the layer's
      for (const double depth : {1e-4, 0.03, 0.5, 3.0, 50.0}) {  // of z0
        const double elastic = stiffness * law.stress() * depth;
        const double found = law.pressureInSeries(elastic, depth * law.range());
        const double closing = depth * law.range() * (1.0 - found / elastic);
        // the balance is found to 1e-6 of the depth
        const double missed = 2e-6 * depth * law.range() * law.slope(-closing);
        EXPECT_NEAR(-law.traction(-closing), found, missed) << stiffness << " " << depth;
      }
    }
    for (const double pressure : {1e7, 1e9, 1e11}) {
      EXPECT_NEAR(-law.traction(-law.closingUnder(pressure)) / pressure, 1.0, 1e-6) << pressure;
    }
  }
}

TEST(ContactTraction, shallowOverlapsSeeTheLayersOwnStiffness) {
  const ContactTraction law(kSilica);
  const double depth = 1e-6 * law.range();
  const double layer_stiffness = 6.0 * law.stress() / law.range();  // of t at z0
  const double body_stiffness = 2.0 * layer_stiffness;
  // two springs in a row: 2/3 of the softer one; the layer stiffens by 1e-5 of itself
  EXPECT_NEAR(law.pressureInSeries(body_stiffness * depth, depth) / (layer_stiffness * depth),
              2.0 / 3.0, 2e-5);
}

TEST(ContactTraction, aLayerMuchStifferThanTheBodiesHardlyMatters) {
  const ContactTraction law(kSilica);
  const double depth = 10.0 * law.range();
  const double elastic = 1e-3 * law.stress() * 10.0;
  EXPECT_NEAR(law.pressureInSeries(elastic, depth) / elastic, 1.0, 1e-3);
}

}  // namespace
}  // namespace mems_stiction
