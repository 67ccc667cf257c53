/// Flags that go by a share of the adhesion: where the share tips.

#include "verdict/regime_flags.hpp"

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

TEST(RegimeFlags, nearBondingIsAsTheModelSays) {
  for (const char* doubt : {static_cast<const char*>(nullptr), "it tears"}) {
    Prediction prediction = contactsWith(0.5);
    prediction.model.doubt = doubt;
    const std::uint32_t flags = regimeFlags(prediction, kCell);
    EXPECT_EQ((flags & kNearBondingFlag) != 0, doubt != nullptr);
    EXPECT_EQ((flagsForHalfSpace(flags) & kNearBondingFlag) != 0, doubt != nullptr);
    EXPECT_EQ(modelDoubt(prediction), doubt != nullptr ? "it tears" : "");
  }
}

TEST(RegimeFlags, taborIsThatOfModelsWithJkr) {
  for (const bool assumes_jkr : {false, true}) {
    Prediction prediction = contactsWith(0.5);
    prediction.contact_theory = ContactTheory::kDmt;
    prediction.model.assumes_jkr = assumes_jkr;
    EXPECT_EQ((regimeFlags(prediction, kCell) & kTaborFlag) != 0, assumes_jkr);
  }
}

TEST(RegimeFlags, areThoseOfTheContactsThatHoldAtThePullOff) {
  Prediction prediction = contactsWith(0.5);
  prediction.status = Status::kEquilibrium;
  prediction.model.assumes_jkr = false;
  prediction.asperity_count = 200;  // what a load presses together
  prediction.pull_off_contact_count = 1;
  Asperity holding;
  holding.composite_radius = 1e-6;
  holding.area = kCell;
  holding.is_at_border = true;
  prediction.pull_off_contacts = {holding};
  EXPECT_EQ(regimeFlagNames(regimeFlags(prediction, kCell)),
            "resolution, few_contacts, border, one_pixel");
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
