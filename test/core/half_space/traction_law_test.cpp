/// The traction between two surfaces against its own integral, derivative and limits, in SI.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "half_space/traction_law.hpp"
#include "mechanics/surface_forces.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

TEST(TractionLaw, IsTheLawOfAdhesionWhereNothingElseActs) {
  for (const double range : {0.0, 3e-10}) {
    TractionLawOptions options;
    options.range = range;
    const TractionLaw law(options);
    const AdhesionLaw adhesion(0.05, range > 0.0 ? range : AdhesionLaw::rangeOf(0.05, 65e-21));
    EXPECT_DOUBLE_EQ(law.range(), adhesion.range());
    for (const double x : {1.5, 1.0, 0.8, 0.2, 1.0 / 300.0}) {
      const auto point = law.at(law.range() / x);
      EXPECT_NEAR(point.traction / adhesion.strength(), adhesion.traction(x) / adhesion.strength(),
                  1e-12)
          << x;
      EXPECT_NEAR(point.slope / adhesion.slope(x), 1.0, 1e-12) << x;
      EXPECT_NEAR(point.energy / -adhesion.energy(x), 1.0, 1e-12) << x;
    }
  }
}

void expectDerivatives(const TractionLawOptions& options) {
  const TractionLaw law(options);
  const double z0 = law.range();
  for (double gap = 0.3 * z0; gap < 12.0 * z0; gap *= 1.013) {
    const double h = 1e-5 * z0;
    const auto below = law.at(gap - h);
    const auto above = law.at(gap + h);
    const auto here = law.at(gap);
    // central differences: error h^2 of the third derivative; kinks only where a straight line
    // begins
    if (std::abs(gap - law.closestGap()) < 2.0 * h) continue;
    const double scale = std::abs(here.traction) + law.stress();
    EXPECT_NEAR((above.energy - below.energy) / (2.0 * h), here.traction, 1e-6 * scale) << gap / z0;
    EXPECT_NEAR((above.traction - below.traction) / (2.0 * h), here.slope,
                1e-6 * (std::abs(here.slope) + scale / z0))
        << gap / z0;
  }
}

TEST(TractionLaw, DerivativesAreThoseOfItsParts) {
  TractionLawOptions options;
  expectDerivatives(options);
  options.hardness = 3e9;
  expectDerivatives(options);
  options.voltage = 40.0;
  options.insulator_thickness = 2e-9;
  expectDerivatives(options);
  options.water.relative_humidity = 0.3;
  expectDerivatives(options);
}

/// Polysilicon under 2 nm of native oxide, retarded.
TractionLawOptions coated() {
  TractionLawOptions options;
  options.lower = options.upper = {2e-9, 261e-21};
  options.retardation_length = 20e-9;
  return options;
}

TEST(TractionLaw, DerivativesUnderFilmsAreThoseOfItsParts) {
  TractionLawOptions options = coated();
  expectDerivatives(options);
  options.upper = {0.3e-9, 10e-21};
  options.hardness = 3e9;
  options.water.relative_humidity = 0.3;
  options.water.water_film = 0.8e-9;
  expectDerivatives(options);
}

TEST(TractionLaw, UnderFilmsHasTheWorkAtZ0AndTheirAttractionFarAway) {
  const TractionLaw law(coated());
  EXPECT_NEAR(law.at(law.range()).energy, -0.05, 1e-14);
  EXPECT_NEAR(law.at(law.range()).traction / law.stress(), 0.0, 1e-12);
  EXPECT_NEAR(law.contactGap() / law.range(), 1.0, 1e-12);
  const LayeredAttraction attraction(65e-21, {2e-9, 261e-21}, {2e-9, 261e-21}, 20e-9);
  EXPECT_NEAR(law.at(40e-9).traction / attraction.at(40e-9).traction, 1.0, 1e-11);
  EXPECT_NEAR(-law.at(40e-9).energy / attraction.at(40e-9).energy, 1.0, 1e-11);
}

TEST(TractionLaw, RowsUnderFilmsAreTheirCells) {
  TractionLawOptions options = coated();
  options.hardness = 5e9;
  const TractionLaw law(options);
  double gaps[11], traction[11], slope[11], energy[11];
  for (int i = 0; i < 11; ++i) gaps[i] = (0.2 + 0.23 * i) * law.range();
  gaps[4] = std::numeric_limits<double>::infinity();
  law.atRow(11, gaps, traction, slope, energy);
  for (int i = 0; i < 11; ++i) {
    EXPECT_EQ(traction[i], law.at(gaps[i]).traction);
    EXPECT_EQ(slope[i], law.at(gaps[i]).slope);
    EXPECT_EQ(energy[i], law.at(gaps[i]).energy);
  }
  EXPECT_EQ(traction[4], 0.0);
  EXPECT_EQ(energy[4], 0.0);
  EXPECT_NEAR(traction[0], -5e9, 1.0);
}

TEST(TractionLaw, UnderFilmsActsBelowItsRangeOnlyWithoutAttraction) {
  TractionLawOptions options = coated();
  options.attracts = false;
  const TractionLaw law(options);
  EXPECT_EQ(law.at(1.01 * law.range()).traction, 0.0);
  EXPECT_NEAR(law.at(1.01 * law.range()).energy, 0.0, 1e-17);
  EXPECT_LT(law.at(0.9 * law.range()).traction, 0.0);
}

TEST(TractionLaw, FilmsOfWaterWidenTheGapThatIsFilled) {
  TractionLawOptions options;
  options.water.relative_humidity = 0.3;
  const TractionLaw without(options);
  options.water.water_film = 0.8e-9;
  const TractionLaw with(options);
  const WaterLaw water = options.water.law();
  const double gap = without.range() + water.gapLimit() - 0.8e-9;  // beyond the Kelvin gap
  EXPECT_NEAR(with.at(gap).traction - without.at(gap).traction, water.pressure(), 1e-3);
  EXPECT_NEAR(without.at(0.8 * with.range()).energy - with.at(0.8 * with.range()).energy,
              water.pressure() * 1.6e-9, 1e-12);
}

TEST(TractionLaw, WaterAddsItsEnergyPerArea) {
  TractionLawOptions dry;
  TractionLawOptions wet = dry;
  wet.water.relative_humidity = 0.5;
  const WaterLaw water = wet.water.law();
  const TractionLaw law(wet);
  // in contact there is no water, but it was there on the way: p d_K
  EXPECT_NEAR(law.at(0.8 * law.range()).energy - TractionLaw(dry).at(0.8 * law.range()).energy,
              -water.pressure() * water.gapLimit(), 1e-12);
  const double inside = law.range() + 0.5 * water.gapLimit();
  EXPECT_NEAR(law.at(inside).traction - TractionLaw(dry).at(inside).traction, water.pressure(),
              1e-3);
  EXPECT_GT(law.reach(), law.range() + water.gapLimit());
}

TEST(TractionLaw, VoltageAddsTheFieldsPressure) {
  TractionLawOptions options;
  const TractionLaw without(options);
  options.voltage = 25.0;
  options.insulator_thickness = 50e-9;
  const TractionLaw with(options);
  EXPECT_NEAR(with.at(4e-9).traction - without.at(4e-9).traction,
              surface_forces::electrostaticPressure(4e-9, 25.0, 50e-9, 3.9), 1e-6);
  EXPECT_LT(with.contactGap(), without.contactGap());
}

TEST(TractionLaw, RepelsNoHarderThanTheHardness) {
  TractionLawOptions options;
  options.hardness = 5e9;
  const TractionLaw law(options);
  EXPECT_TRUE(law.flows());
  EXPECT_NEAR(law.at(law.closestGap()).traction, -5e9, 1.0);
  EXPECT_NEAR(law.at(0.1 * law.range()).traction, -5e9, 1.0);
  EXPECT_EQ(law.at(0.1 * law.range()).slope, 0.0);
}

TEST(TractionLaw, UpToAPressureItIsTheSameAndBeyondItsTangent) {
  const TractionLaw law{TractionLawOptions()};
  const double pressure = 7e9;
  const TractionLaw wall = law.steepUpTo(pressure);
  const double edge = law.gapUnder(pressure);
  EXPECT_NEAR(wall.closestGap() / edge, 1.0, 1e-8);
  EXPECT_FALSE(wall.flows());
  for (const double share : {1.001, 1.2, 3.0}) {
    EXPECT_EQ(wall.at(share * edge).traction, law.at(share * edge).traction);
    EXPECT_EQ(wall.at(share * edge).energy, law.at(share * edge).energy);
  }
  const double inside = 0.9 * edge;
  const double slope = law.at(edge).slope;
  EXPECT_NEAR(wall.at(inside).traction / (-pressure - slope * (edge - inside)), 1.0, 1e-7);
  EXPECT_NEAR(wall.at(inside).slope / slope, 1.0, 1e-6);
  EXPECT_GT(wall.at(inside).traction, law.at(inside).traction);
  EXPECT_EQ(wall.steepUpTo(1e30).closestGap(), wall.closestGap());  // its own line begins before
  TractionLawOptions flowing;
  flowing.hardness = 5e9;
  EXPECT_EQ(TractionLaw(flowing).steepUpTo(1e9).at(inside).traction,
            TractionLaw(flowing).at(inside).traction);
}

TEST(TractionLaw, WithoutAttractionActsBelowItsRangeOnly) {
  TractionLawOptions options;
  options.attracts = false;
  const TractionLaw law(options);
  const TractionLaw full{TractionLawOptions()};
  EXPECT_EQ(law.at(1.01 * law.range()).traction, 0.0);
  EXPECT_NEAR(law.at(1.01 * law.range()).energy, 0.0, 1e-17);
  EXPECT_EQ(law.at(0.9 * law.range()).traction, full.at(0.9 * law.range()).traction);
}

TEST(TractionLaw, InfiniteGapsHaveNoTraction) {
  TractionLawOptions options;
  options.voltage = 5.0;
  options.insulator_thickness = 1e-9;
  options.water.relative_humidity = 0.5;
  const auto point = TractionLaw(options).at(std::numeric_limits<double>::infinity());
  EXPECT_EQ(point.traction, 0.0);
  EXPECT_EQ(point.slope, 0.0);
  EXPECT_EQ(point.energy, 0.0);
}

TEST(TractionLaw, RowsAreTheirCells) {
  TractionLawOptions options;
  options.hardness = 5e9;
  const TractionLaw law(options);
  double gaps[11], traction[11], slope[11], energy[11];
  for (int i = 0; i < 11; ++i) gaps[i] = (0.2 + 0.23 * i) * law.range();
  law.atRow(11, gaps, traction, slope, energy);
  for (int i = 0; i < 11; ++i) {
    EXPECT_EQ(traction[i], law.at(gaps[i]).traction);
    EXPECT_EQ(slope[i], law.at(gaps[i]).slope);
    EXPECT_EQ(energy[i], law.at(gaps[i]).energy);
  }
}

TEST(TractionLaw, SecantEndsWhereTheOtherTractionIs) {
  const TractionLaw law{TractionLawOptions()};
  const double gap = 0.7 * law.range();
  const double other = 0.85 * law.range();
  const double expected = (law.at(other).traction - law.at(gap).traction) / (other - gap);
  EXPECT_NEAR(law.secant(gap, law.at(gap).traction, law.at(other).traction) / expected, 1.0, 1e-3);
}

TEST(TractionLaw, SecantsGoOnAlongTheLineBehindTheNarrowestGap) {
  const TractionLaw law{TractionLawOptions()};
  const double begin = law.at(law.narrowestGap()).slope;
  const double gap = 0.3 * law.range();
  const double other = 0.1 * law.range();
  EXPECT_NEAR(law.secant(gap, law.at(gap).traction, law.at(other).traction) / begin, 1.0, 1e-9);
  const double wide = 0.6 * law.range();
  const double expected = (law.at(other).traction - law.at(wide).traction) / (other - wide);
  EXPECT_NEAR(law.secant(wide, law.at(wide).traction, law.at(other).traction) / expected, 1.0,
              1e-3);
}

TEST(TractionLaw, SecantsEndWhereTheSurfacesFlow) {
  TractionLawOptions options;
  options.hardness = 5e9;
  const TractionLaw law(options);
  const double gap = 1.01 * law.closestGap();
  const double expected = (-5e9 - law.at(gap).traction) / (law.closestGap() - gap);
  EXPECT_NEAR(law.secant(gap, law.at(gap).traction, -9e9) / expected, 1.0, 1e-6);
  const double flowing = 0.9 * law.closestGap();
  EXPECT_EQ(law.secant(flowing, law.at(flowing).traction, -9e9), 0.0);
}

TEST(TractionLaw, TheGapUnderAPressureHasIt) {
  const TractionLaw law{TractionLawOptions()};
  EXPECT_NEAR(law.gapUnder(0.0) / law.range(), 1.0, 1e-9);
  for (const double pressure : {1e7, 1e9, 20e9, 200e9}) {
    EXPECT_NEAR(-law.at(law.gapUnder(pressure)).traction / pressure, 1.0, 1e-9) << pressure;
  }
  EXPECT_EQ(law.gapUnder(1e14), law.narrowestGap());
}

TEST(TractionLaw, SecantsOfSeveralGapsAreThoseOfEach) {
  const TractionLaw law{TractionLawOptions()};
  const double gaps[] = {0.4 * law.range(), 0.6 * law.range(), 0.9 * law.range(),
                         0.97 * law.range()};
  const double tractions[] = {law.at(gaps[0]).traction, law.at(gaps[1]).traction,
                              law.at(gaps[2]).traction, law.at(gaps[3]).traction};
  const double others[] = {-3e9, -1e14, 0.0, -2e8};
  const Packet secants =
      law.secant(Packet::load(gaps), Packet::load(tractions), Packet::load(others));
  for (std::size_t i = 0; i < Packet::kCount; ++i) {
    EXPECT_DOUBLE_EQ(secants[i], law.secant(gaps[i], tractions[i], others[i])) << i;
  }
}

TEST(TractionLaw, ImpossibleInterfacesAreNamed) {
  TractionLawOptions options;
  EXPECT_TRUE(options.validate().empty());
  options.work_of_adhesion = 0.0;
  options.hamaker_constant = 0.0;
  options.voltage = 1.0;
  const auto violations = options.validate();
  ASSERT_EQ(violations.size(), 3U);
  EXPECT_NE(violations[0].find("interface/work_of_adhesion: 0 "), std::string::npos);
  EXPECT_NE(violations[1].find("interface/hamaker_constant: 0 "), std::string::npos);
  EXPECT_NE(violations[2].find("interface/insulator_thickness: 0 "), std::string::npos);
  options.range = 1e-10;
  EXPECT_EQ(options.validate().size(), 2U);
}

}  // namespace
}  // namespace mems_stiction
