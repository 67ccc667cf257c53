/// Flags that go by a share of the adhesion: where the share tips.

#include "mems_stiction/verdict/regime_flags.hpp"

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

}  // namespace
}  // namespace mems_stiction
