/// Flags that go by a share of the adhesion: where the share tips.

#include "mems_stiction/verdict/regime_flags.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

constexpr double kCell = 1e-18;

/// Two contacts; `marked` of the sum of radii belongs to the second.
Prediction contactsWith(double marked) {
  Prediction prediction;
  prediction.asperity_count = 2;
  Asperity first, second;
  first.composite_radius = (1.0 - marked) * 1e-6;
  second.composite_radius = marked * 1e-6;
  first.area = second.area = 2.0 * kFewestCellsPerContact * kCell;
  prediction.asperities = {first, second};
  return prediction;
}

TEST(RegimeFlags, plasticityIsThatOfMoreThanHalfOfTheAdhesion) {
  for (const bool is_more : {false, true}) {
    Prediction prediction = contactsWith(is_more ? 0.51 : 0.49);
    prediction.asperities[1].regime = Regime::kElastoPlastic;
    EXPECT_EQ((regimeFlags(prediction, kCell) & kPlasticityFlag) != 0, is_more);
  }
}

TEST(RegimeFlags, resolutionIsThatOfMoreThanHalfOfTheAdhesion) {
  for (const bool is_more : {false, true}) {
    Prediction prediction = contactsWith(is_more ? 0.51 : 0.49);
    prediction.asperities[1].area = (kFewestCellsPerContact - 1.0) * kCell;
    EXPECT_EQ((regimeFlags(prediction, kCell) & kResolutionFlag) != 0, is_more);
  }
}

TEST(RegimeFlags, brittleContactsMayGrowTogetherAtTwiceTheFlatteningRatio) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const auto& [tabor, limit] :
       {std::pair(0.0, 2.0), {0.4, 2.8}, {1.0, 4.0}, {3.0, 4.0}, {infinite, 4.0}, {nan, 2.0}}) {
    for (const bool is_near : {false, true}) {
      Prediction prediction = contactsWith(0.5);
      prediction.median_tabor_parameter = tabor;
      prediction.flattening_ratio = limit * (is_near ? 0.999 : 1.001);
      EXPECT_EQ((regimeFlags(prediction, kCell) & kNearBondingFlag) != 0, is_near) << tabor;
    }
  }
}

TEST(RegimeFlags, contactsThatJoinOneAfterAnotherMayGrowTogetherUpToSix) {
  // force on the way in, of its largest value; the way out does not count
  const auto flagged = [](double flattening_ratio, std::vector<double> forces) {
    Prediction prediction = contactsWith(0.5);
    prediction.median_tabor_parameter = 0.0;
    prediction.flattening_ratio = flattening_ratio;
    for (const double force : forces) prediction.curve.push_back({0.0, force, false});
    prediction.curve.push_back({0.0, 0.2, true});
    prediction.curve.push_back({0.0, 0.9, true});
    return (regimeFlags(prediction, kCell) & kNearBondingFlag) != 0;
  };
  EXPECT_TRUE(flagged(5.9, {0.1, 1.0, 0.5, 0.61, 0.0})) << "a rise after the maximum";
  EXPECT_TRUE(flagged(5.9, {0.1, 0.7, 0.55, 1.0, 0.0})) << "and before it";
  EXPECT_FALSE(flagged(5.9, {0.1, 1.0, 0.5, 0.59, 0.0}));
  EXPECT_FALSE(flagged(5.9, {0.1, 0.6, 0.8, 1.0, 0.4, -0.3}));
  EXPECT_FALSE(flagged(6.1, {0.1, 1.0, 0.5, 0.9, 0.0}));
  EXPECT_FALSE(flagged(5.9, {}));
}

}  // namespace
}  // namespace mems_stiction
