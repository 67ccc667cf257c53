/// Attraction of bodies under films and its retardation, against closed forms, sums over pairs of
/// layers and values of Lifshitz' theory; and the law of adhesion with such a tail.

#include "mechanics/layered_attraction.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "mechanics/surface_forces.hpp"
#include "mechanics/traction_law.hpp"
#include "numeric/constants.hpp"
#include "numeric/packet.hpp"
#include "support/reference_contacts.hpp"

namespace mems_stiction {
namespace {

constexpr double kOxide = 65e-21;
constexpr double kSilicon = 261e-21;
constexpr double kRetardation = 20e-9;
constexpr double kDryWork = 0.05;
constexpr CoatedBody kCoatedSilicon{2e-9, kSilicon};
constexpr CoatedBody kBare{};

LayeredAttraction siliconUnderOxide() {
  return LayeredAttraction(kOxide, kCoatedSilicon, kCoatedSilicon, kRetardation);
}

/// Attractions of every kind: films stronger and weaker than what is under them, two bodies.
std::vector<LayeredAttraction> allKinds() {
  return {siliconUnderOxide(), LayeredAttraction(kOxide, kBare, kBare, kRetardation),
          LayeredAttraction(kOxide, kCoatedSilicon, kBare, 0.0),
          LayeredAttraction(kOxide, {1e-9, 300e-21}, {5e-9, 20e-21}, 0.0),
          LayeredAttraction(300e-21, {3e-9, 20e-21}, {0.4e-9, 1e-21}, 50e-9)};
}

TEST(LayeredAttraction, followsLifshitzTheoryOfSiliconUnderNativeOxide) {
  // one oscillator for silicon, 2 nm of oxide; the table has whole zJ
  const double table[][2] = {{2e-9, 98.0}, {8e-9, 130.0}, {21e-9, 110.0}, {43e-9, 79.0}};
  for (const auto& [gap, lifshitz] : table) {
    EXPECT_NEAR(siliconUnderOxide().hamakerConstant(gap) * 1e21, lifshitz, 0.035 * lifshitz + 0.5)
        << gap;
  }
}

TEST(LayeredAttraction, narrowGapsSeeTheFilmsAndWideOnesWhatIsUnderThem) {
  const LayeredAttraction attraction(kOxide, kCoatedSilicon, kCoatedSilicon, 0.0);
  EXPECT_NEAR(attraction.hamakerConstant(1e-13) / kOxide, 1.0, 1e-6);
  EXPECT_NEAR(attraction.hamakerConstant(1e-3) / kSilicon, 1.0, 1e-5);  // (1 + 4e-6)^-2
}

TEST(LayeredAttraction, twoBodiesAttractAsEachPairOfTheirLayers) {
  // by hand: layers as half-spaces that begin at their upper faces, less those that begin below
  const double film = 65e-21, first = 300e-21, second = 20e-21;
  const double t1 = 1e-9, t2 = 5e-9;
  const LayeredAttraction attraction(film, {t1, first}, {t2, second}, 0.0);
  const auto plates = [](double a, double b, double gap) {
    return surface_forces::vanDerWaalsEnergy(gap, std::sqrt(a * b));
  };
  for (const double gap : {0.3e-9, 2e-9, 7e-9, 40e-9}) {
    const double slab_on_slab = plates(film, film, gap) - plates(film, film, gap + t1) -
                                plates(film, film, gap + t2) + plates(film, film, gap + t1 + t2);
    const double slab_on_second =
        plates(film, second, gap + t2) - plates(film, second, gap + t1 + t2);
    const double first_on_slab = plates(first, film, gap + t1) - plates(first, film, gap + t1 + t2);
    const double both = plates(first, second, gap + t1 + t2);
    EXPECT_NEAR(attraction.at(gap).energy / (slab_on_slab + slab_on_second + first_on_slab + both),
                1.0, 1e-12)
        << gap;
  }
}

TEST(LayeredAttraction, isHalvedAtTheRetardationLength) {
  const LayeredAttraction late(kOxide, kBare, kBare, kRetardation);
  EXPECT_NEAR(late.hamakerConstant(kRetardation) / kOxide, 0.5, 1e-14);
  EXPECT_NEAR(late.hamakerConstant(1e-13) / kOxide, 1.0, 1e-5);
}

TEST(LayeredAttraction, withoutFilmsAndRetardationIsHamakers) {
  EXPECT_TRUE(LayeredAttraction(kOxide, kBare, kBare, 0.0).isPlain());
  EXPECT_TRUE(LayeredAttraction(kOxide, {2e-9, 0.0}, {2e-9, kOxide}, 0.0).isPlain());
  EXPECT_TRUE(LayeredAttraction(kOxide, {0.0, kSilicon}, kBare, 0.0).isPlain());
  EXPECT_FALSE(LayeredAttraction(kOxide, kBare, kCoatedSilicon, 0.0).isPlain());
  EXPECT_FALSE(LayeredAttraction(kOxide, kBare, kBare, kRetardation).isPlain());
  const auto point = LayeredAttraction(kOxide, kBare, kBare, 0.0).at(3e-9);
  EXPECT_NEAR(point.energy / surface_forces::vanDerWaalsEnergy(3e-9, kOxide), 1.0, 1e-14);
  EXPECT_NEAR(point.traction / surface_forces::vanDerWaalsPressure(3e-9, kOxide), 1.0, 1e-14);
}

TEST(LayeredAttraction, eachDerivativeIsThatOfTheOneBefore) {
  for (const LayeredAttraction& attraction : allKinds()) {
    for (double gap = 0.15e-9; gap < 400e-9; gap *= 1.7) {
      const double h = 1e-4 * gap;  // central differences: some tens times h^2/gap^2
      const auto here = attraction.at(gap);
      const auto below = attraction.at(gap - h);
      const auto above = attraction.at(gap + h);
      EXPECT_NEAR((below.energy - above.energy) / (2.0 * h) / here.traction, 1.0, 1e-6) << gap;
      EXPECT_NEAR((above.traction - below.traction) / (2.0 * h) / here.slope, 1.0, 1e-6) << gap;
      EXPECT_NEAR((above.slope - below.slope) / (2.0 * h) / here.curvature, 1.0, 1e-6) << gap;
    }
  }
}

TEST(LayeredAttraction, fallsNoFasterThanItsSteepness) {
  for (const LayeredAttraction& attraction : allKinds()) {
    for (double gap = 0.15e-9; gap < 1e-5; gap *= 1.7) {
      const auto point = attraction.at(gap);
      EXPECT_GT(point.traction, 0.0);
      EXPECT_LE(-point.slope * gap / point.traction, 3.0 * attraction.steepness() + 1e-9) << gap;
    }
  }
  EXPECT_NEAR(allKinds().back().steepness(), 2.0, 1e-15);
  EXPECT_EQ(LayeredAttraction(kOxide, kCoatedSilicon, kBare, 0.0).steepness(), 1.0);
}

TEST(LayeredAttraction, ofSeveralGapsIsThatOfEach) {
  const Packet gaps(0.2e-9, 1.7e-9, 20e-9, 300e-9);
  const auto several = siliconUnderOxide().at(gaps);
  for (std::size_t i = 0; i < Packet::kCount; ++i) {
    const auto one = siliconUnderOxide().at(gaps[i]);
    EXPECT_EQ(several.energy[i], one.energy);
    EXPECT_EQ(several.traction[i], one.traction);
    EXPECT_EQ(several.slope[i], one.slope);
    EXPECT_EQ(several.curvature[i], one.curvature);
  }
}

/// The whole law with its tail at a gap.
double tractionOf(const AdhesionLaw& law, double gap) {
  return law.traction(law.range() / gap) + law.tail().at(gap).traction;
}

TEST(AdhesionLawWithTail, hasTheWholeWorkWhereItsTractionVanishesAndTheAttractionFarAway) {
  for (const LayeredAttraction& attraction : allKinds()) {
    const double range = AdhesionLaw::rangeOf(kDryWork, attraction);
    const AdhesionLaw law(kDryWork, range, attraction);
    ASSERT_TRUE(law.hasTail());
    EXPECT_NEAR(tractionOf(law, range) / law.stress(), 0.0, 1e-13);
    EXPECT_NEAR((law.energy(1.0) + law.tail().at(range).energy) / kDryWork, 1.0, 1e-12);
    // (z0/g)^6 is below 3e-11, and what is left of the films a tenth
    for (const double gap : {20e-9, 200e-9}) {
      EXPECT_NEAR(tractionOf(law, gap) / attraction.at(gap).traction, 1.0, 1e-9) << gap;
    }
  }
}

TEST(AdhesionLawWithTail, rangeIsNearlyThatOfTheFilms) {
  const double bare = AdhesionLaw::rangeOf(kDryWork, kOxide);
  EXPECT_NEAR(AdhesionLaw::rangeOf(kDryWork, siliconUnderOxide()) / bare, 1.0, 0.01);
  EXPECT_EQ(AdhesionLaw::rangeOf(kDryWork, LayeredAttraction(kOxide, kBare, kBare, 0.0)), bare);
}

TEST(AdhesionLawWithTail, isStrongestWhereItSays) {
  for (const LayeredAttraction& attraction : allKinds()) {
    const AdhesionLaw law(kDryWork, AdhesionLaw::rangeOf(kDryWork, attraction), attraction);
    double largest = 0.0;
    for (int i = 0; i < 4000; ++i) {
      largest = std::max(largest, tractionOf(law, (1.0 + 1e-3 * i) * law.range()));
    }
    EXPECT_NEAR(law.strength() / largest, 1.0, 3e-6);  // 10 times the half step's square
    EXPECT_NEAR(law.strength() / tractionOf(law, law.strongestGap()), 1.0, 1e-13);
  }
}

TEST(AdhesionLawWithTail, takesAFactorWhereItsRangeIsStated) {
  const AdhesionLaw law(kDryWork, 0.3e-9, siliconUnderOxide());
  EXPECT_NEAR((law.energy(1.0) + law.tail().at(0.3e-9).energy) / kDryWork, 1.0, 1e-12);
  const double far = tractionOf(law, 300e-9) / siliconUnderOxide().at(300e-9).traction;
  const double near = tractionOf(law, 30e-9) / siliconUnderOxide().at(30e-9).traction;
  EXPECT_NEAR(far / near, 1.0, 1e-9);
  EXPECT_GT(far, 3.0);  // (0.3/0.161)^2
}

TEST(AdhesionLawWithTail, isNoneWherePlain) {
  const LayeredAttraction plain(kOxide, {2e-9, kOxide}, kBare, 0.0);
  const AdhesionLaw law(kDryWork, AdhesionLaw::rangeOf(kDryWork, plain), plain);
  const AdhesionLaw bare(kDryWork, AdhesionLaw::rangeOf(kDryWork, kOxide));
  EXPECT_FALSE(law.hasTail());
  EXPECT_EQ(law.range(), bare.range());
  EXPECT_EQ(law.stress(), bare.stress());
  EXPECT_EQ(law.strength(), bare.strength());
  EXPECT_FALSE(AdhesionLaw(0.0, 0.2e-9, siliconUnderOxide()).hasTail());
}

}  // namespace
}  // namespace mems_stiction
