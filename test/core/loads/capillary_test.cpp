/// The capillary term against the numbers of water at room temperature and closed forms of flat and
/// sphere.

#include "mems_stiction/loads/capillary.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "approach/gap_order.hpp"
#include "mechanics/traction_law.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/frame_gaps.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

constexpr double kNm = 1e-9;
constexpr double kRoundOff = 1e-12;

CapillaryOptions humid(double relative_humidity, double contact_angle = 0.0) {
  CapillaryOptions options;
  options.relative_humidity = relative_humidity;
  options.contact_angle = contact_angle;
  return options;
}

double sumOverCells(const GapField& field, double approach, int touching, const WaterLaw& water) {
  int filled = 0;
  for (const double gap : frameGaps(field)) filled += gap - approach < water.gapLimit() ? 1 : 0;
  return (filled - touching) * (water.pressure() * field.cellArea());
}

TEST(WaterLaw, hasTheKelvinRadiusOfWater) {
  for (const double humidity : {0.1, 0.45, 0.7, 0.95}) {
    const double length = humid(humidity).law().kelvinRadius() * std::log(1.0 / humidity);
    EXPECT_GT(length, 0.52 * kNm);  // published for water at room temperature: 0.52 to 0.54 nm
    EXPECT_LT(length, 0.54 * kNm);
  }
}

TEST(WaterLaw, costsTwiceTheSurfaceTensionAtEveryHumidity) {
  for (const double humidity : {0.1, 0.45, 0.95}) {
    const WaterLaw water = humid(humidity).law();
    EXPECT_NEAR(water.pressure() * water.gapLimit(), 144e-3, kRoundOff);
    const WaterLaw slanted = humid(humidity, 1.2).law();
    EXPECT_NEAR(slanted.pressure() * slanted.gapLimit(), 144e-3 * std::cos(1.2), kRoundOff);
  }
}

TEST(WaterLaw, pressureIsTheWorkOfBringingVaporToTheLiquid) {
  // second route: a mole of liquid under tension p has the vapour's chemical potential, p V_m = R T
  // ln(1/RH); 50 % at 25 degrees: 95.1 MPa
  EXPECT_NEAR(humid(0.5).law().pressure(), 95.1e6, 0.05e6);
}

TEST(WaterLaw, scalesInSI) {
  CapillaryOptions options = humid(0.6);
  options.surface_tension = 0.0227;  // ethanol
  options.molar_volume = 58.4e-6;
  options.temperature = 310.0;
  const WaterLaw liquid = options.law();
  EXPECT_NEAR(liquid.kelvinRadius(), 0.0227 * 58.4e-6 / (8.314462618 * 310.0 * std::log(1.0 / 0.6)),
              1e-9 * kNm);
  EXPECT_NEAR(liquid.pressure() * liquid.kelvinRadius(), 0.0227, kRoundOff);
}

TEST(WaterLaw, isOffWhenDryAndActsOnlyBelowTheKelvinGap) {
  EXPECT_FALSE(humid(0.0).law().isOn());
  EXPECT_EQ(humid(0.0).law().pressure(), 0.0);
  const WaterLaw water = humid(0.5).law();
  const auto forceAt = [&](double gap) {  // of one cell beside another that touches
    GapField field;
    field.compute(HeightMap((cv::Mat1d(1, 2) << gap, 0.0), 10 * kNm, 10 * kNm));
    GapOrder order;
    order.build(field, 1.0);
    return capillaryForce(order, 0.0, 1, water, 1e-16);
  };
  EXPECT_EQ(forceAt(0.999 * water.gapLimit()), water.pressure() * 1e-16);
  EXPECT_EQ(forceAt(1.001 * water.gapLimit()), 0.0);
  EXPECT_EQ(water.pressure(0.999 * water.gapLimit()), water.pressure());
  EXPECT_EQ(water.pressure(1.001 * water.gapLimit()), 0.0);
  EXPECT_EQ(water.energy(1.001 * water.gapLimit()), 0.0);
}

TEST(CapillarySum, fillsAFlatAroundABumpOrNothing) {
  const double pitch = 20 * kNm;
  GapField field;
  field.compute(analytic::flatWithBump(40, 51, pitch, pitch, 2 * kNm));
  GapOrder order;
  order.build(field, 0.5);
  const double rest_of_area = (40 * 51 - 1) * pitch * pitch;
  const WaterLaw wide = humid(0.7).law();  // Kelvin gap 2.9 nm
  EXPECT_NEAR(capillaryForce(order, 0.0, 1, wide, field.cellArea()), wide.pressure() * rest_of_area,
              kRoundOff * wide.pressure() * rest_of_area);
  const WaterLaw narrow =
      humid(0.5).law();  // Kelvin gap 1.5 nm: nothing but the contact, then, 1 nm lower, all
  EXPECT_EQ(capillaryForce(order, 0.0, 1, narrow, field.cellArea()), 0.0);
  EXPECT_NEAR(capillaryForce(order, 1 * kNm, 1, narrow, field.cellArea()),
              narrow.pressure() * rest_of_area, kRoundOff * narrow.pressure() * rest_of_area);
}

TEST(CapillarySum, ofASphereIsFourPiGammaRAtEveryHumidityAndApproach) {
  const double radius = 2e-6;
  GapField field;
  field.compute(analytic::paraboloid(450, 451, 1 * kNm, 1 * kNm, radius));
  GapOrder order;
  order.build(field, 0.2);
  for (const double humidity : {0.4, 0.7, 0.9}) {
    for (const double approach : {0.0, 0.5 * kNm, 1.3 * kNm}) {
      const int touching = order.sortBelow(approach);
      const double force =
          capillaryForce(order, approach, touching, humid(humidity).law(), 1 * kNm * kNm);
      // rings of equal width in gap have equal area 2 pi R d_K; counting cells in a ring some 60
      // pixels across: 1 %
      EXPECT_NEAR(force, 4.0 * kPi * 0.072 * radius, 0.01 * force) << humidity << " " << approach;
    }
  }
}

TEST(CapillarySum, agreesWithTheSumOverCells) {
  for (const samples::Frame& frame : samples::allFrames()) {
    const GapField field = frame.gapField();
    for (const double max_fraction : {0.05, 1.0}) {
      GapOrder order;
      order.build(field, max_fraction);
      for (const double humidity : {0.3, 0.8, 0.99, 0.9999}) {
        const WaterLaw water = humid(humidity).law();
        const double approach =
            0.7 * order.cells()[static_cast<std::size_t>(order.contactLimit() - 1)].gap;
        const int touching = order.sortBelow(approach);
        const double expected = sumOverCells(field, approach, touching, water);
        // only the bucket in which the limit lies is not counted exactly
        const double limit = approach + water.gapLimit();
        const double bucket = std::floor(limit / order.bucketWidth());
        const auto shares_bucket = [&](double gap) {
          return std::floor(gap / order.bucketWidth()) == bucket;
        };
        const std::vector<double> gaps = frameGaps(field);
        const double partial = bucket >= order.orderedBuckets()
                                   ? std::count_if(gaps.begin(), gaps.end(), shares_bucket)
                                   : 0.0;
        const double slack = partial + 1e-9;
        EXPECT_NEAR(capillaryForce(order, approach, touching, water, field.cellArea()), expected,
                    slack * water.pressure() * field.cellArea() + kRoundOff * expected)
            << frame.name << " " << humidity;
      }
    }
  }
}

TEST(CapillaryOptions, defaultsAreAllowedAndViolationsNamed) {
  CapillaryOptions options;
  OptionValidator fine;
  options.describe(fine);
  EXPECT_TRUE(fine.violations().empty());
  options.relative_humidity = 1.0;
  options.contact_angle = 1.6;
  options.temperature = 0.0;
  OptionValidator wrong;
  options.describe(wrong);
  ASSERT_EQ(wrong.violations().size(), 3u);
  EXPECT_NE(wrong.violations()[0].find("interface/relative_humidity: 1"), std::string::npos);
}

}  // namespace
}  // namespace mems_stiction
