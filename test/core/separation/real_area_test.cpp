/// What touches of a patch that overlaps: closed forms of tops, of adhesion, of the layer and of
/// flow.

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "mechanics/jkr.hpp"
#include "numeric/constants.hpp"
#include "separation/real_area.hpp"

namespace mems_stiction {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

PatchAtRest pressed(double carried) {
  PatchAtRest patch;
  patch.load = {carried, carried, 0.0, 0.0};
  patch.cells = 1000.0;
  patch.capacity = kNever;
  return patch;
}

/// Of pressed()'s cells that of the summit touches in any case, and this share of the others.
double touching(double share) { return 1.0 + 999.0 * share; }

TEST(RealArea, goesFromHalfOfAParaboloidsOverlapToAllOfAPunchs) {
  EXPECT_DOUBLE_EQ(touchingShare(0.0), 0.5);  // Hertz
  // Sneddon, h ~ r^4: delta = (8/3) h(a)
  EXPECT_NEAR(touchingShare(0.5), std::sqrt(3.0 / 8.0), 1e-12);
  // h ~ r^6: delta = (16/5) h(a)
  EXPECT_NEAR(touchingShare(2.0 / 3.0), std::cbrt(5.0 / 16.0), 1e-12);
  EXPECT_DOUBLE_EQ(touchingShare(1.0), 1.0);
  EXPECT_NEAR(touchingShare(1.0 - 1.0 / 127.9) / touchingShare(1.0 - 1.0 / 128.1), 1.0,
              1e-4);  // one formula goes over into the other
  EXPECT_NEAR(touchingShare(1e-9), 0.5, 1e-6);
  PatchAtRest patch = pressed(1e-6);
  EXPECT_DOUBLE_EQ(realCells(patch), touching(0.5));
  patch.load.flatness = 0.5;
  EXPECT_NEAR(realCells(patch), touching(std::sqrt(3.0 / 8.0)), 1e-9);
}

TEST(RealArea, ofARandomSurfaceGoesFromTwoPressuresToAll) {
  const double flattening = 100e9 * 0.02;  // E h'
  EXPECT_EQ(touchingShare(0.0, 100e9, 0.02), 0.0);
  EXPECT_NEAR(touchingShare(0.01 * flattening, 100e9, 0.02), 0.02, 1e-5);
  EXPECT_NEAR(touchingShare(flattening / std::sqrt(kPi), 100e9, 0.02), 0.8427008, 1e-7);
  EXPECT_DOUBLE_EQ(touchingShare(5.0 * flattening, 100e9, 0.02), 1.0);
  EXPECT_DOUBLE_EQ(touchingShare(1.0, 100e9, 0.0), 1.0);
}

TEST(RealArea, ofASoftSphereIsThatPartOfJkrsContactThatPresses) {
  constexpr double kModulus = 1e9;
  constexpr double kRadius = 1e-6;
  constexpr double kWork = 0.05;
  constexpr double kRim = 2.0 * kPi * kWork * kRadius;
  constexpr double kCarried = 0.75 * kRim;
  for (const double load : {0.0, 3.0, 100.0}) {  // [rim forces]
    PatchAtRest patch = pressed(kCarried + load * kRim);
    patch.rim_force = kRim;
    patch.prefactor = 1.5;
    // JKR under that load from outside which the patch carries beside its rim's
    const double outer = std::max(patch.load.carried - kRim, 0.0);
    const double a =
        jkr::contactRadius(jkr::apparentLoad(outer, kWork, kRadius), kRadius, kModulus);
    // p(x) = p1 sqrt(1 - x^2) - p2/sqrt(1 - x^2) presses up to x^2 = 1 - p2/p1
    const double p1 = 2.0 * kModulus * a / (kPi * kRadius);
    const double p2 = std::sqrt(2.0 * kWork * kModulus / (kPi * a));
    const double hertz_cubed = 0.75 * patch.load.carried * kRadius / kModulus;
    const double wide = a * a * (1.0 - p2 / p1) / std::cbrt(hertz_cubed * hertz_cubed);
    EXPECT_NEAR(realCells(patch), touching(std::min(1.0, 0.5 * wide)), 1e-6) << load;
    patch.prefactor = 2.0;  // DMT: Hertz' contact
    EXPECT_DOUBLE_EQ(realCells(patch), touching(0.5)) << load;
  }
}

TEST(RealArea, isAllOfWhatTheLayerTakesOrFlowHasPressedFlat) {
  PatchAtRest patch = pressed(1e-6);
  patch.load.layer_share = 1.0;
  EXPECT_DOUBLE_EQ(realCells(patch), 1000.0);
  patch.load.layer_share = 0.4;
  EXPECT_DOUBLE_EQ(realCells(patch), touching(0.7));
  patch.load.layer_share = 0.0;
  patch.capacity = 1e-6;
  EXPECT_DOUBLE_EQ(realCells(patch), 1000.0);
  patch.capacity = 4e-6;  // a quarter: less than touches elastically
  EXPECT_DOUBLE_EQ(realCells(patch), touching(0.5));
}

TEST(RealArea, isACellAtLeastAndNeverMoreThanOverlaps) {
  PatchAtRest patch = pressed(0.0);
  patch.cells = 1.0;
  EXPECT_DOUBLE_EQ(realCells(patch), 1.0);
  patch.cells = 12.0;
  patch.load.flatness = 1.0;
  patch.rim_force = kNever;  // no depth at all
  EXPECT_DOUBLE_EQ(realCells(patch), 12.0);
  patch = pressed(1e-9);
  patch.rim_force = 1e-6;
  patch.prefactor = 1.5;
  EXPECT_DOUBLE_EQ(realCells(patch), 1000.0);
}

}  // namespace
}  // namespace mems_stiction
