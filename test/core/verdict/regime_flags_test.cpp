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
  prediction.asperity_count = prediction.pull_off_contact_count = 2;
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
  const auto flagged = [](double flattening_ratio, double rise) {
    Prediction prediction = contactsWith(0.5);
    prediction.median_tabor_parameter = 0.0;
    prediction.flattening_ratio = flattening_ratio;
    prediction.joining_rise = rise;
    return (regimeFlags(prediction, kCell) & kNearBondingFlag) != 0;
  };
  EXPECT_TRUE(flagged(5.9, 0.11));
  EXPECT_FALSE(flagged(5.9, 0.09));
  EXPECT_FALSE(flagged(6.1, 0.4));
}

TEST(RegimeFlags, areThoseOfTheContactsThatHoldAtThePullOff) {
  Prediction prediction = contactsWith(0.5);
  prediction.status = Status::kEquilibrium;
  prediction.apparent_work_of_adhesion = 1e-4;
  prediction.asperity_count = 200;  // what a load presses together
  prediction.pull_off_contact_count = 1;
  Asperity holding;
  holding.composite_radius = 1e-6;
  holding.area = kCell;
  holding.is_at_border = true;
  holding.tabor_parameter = 1.0;
  prediction.pull_off_contacts = {holding};
  prediction.flattening_ratio = 3.9;
  EXPECT_EQ(regimeFlagNames(regimeFlags(prediction, kCell)),
            "resolution, few_contacts, near_bonding, border, one_pixel");
}

TEST(RegimeFlags, surfacesThatALoadPressesTogetherNearlyEverywhereAreNotBonded) {
  Prediction prediction = contactsWith(0.5);
  prediction.status = Status::kBonded;
  EXPECT_TRUE(regimeFlags(prediction, kCell) & kBondedFlag);
  prediction.is_bonded_by_load = true;
  EXPECT_FALSE(regimeFlags(prediction, kCell) & kBondedFlag);
}

}  // namespace
}  // namespace mems_stiction
