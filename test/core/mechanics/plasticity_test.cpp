#include "mems_stiction/mechanics/plasticity.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

constexpr double kModulus = 88.7978e9;
constexpr double kHardness = 12e9;

TEST(PlasticityIndex, scalesWithItsArguments) {
  const double index = plasticityIndex(kModulus, kHardness, 3e-9, 300e-9);
  EXPECT_DOUBLE_EQ(plasticityIndex(4.0 * kModulus, kHardness, 3e-9, 300e-9), 4.0 * index);
  EXPECT_DOUBLE_EQ(plasticityIndex(kModulus, 4.0 * kHardness, 3e-9, 300e-9), 0.25 * index);
  EXPECT_DOUBLE_EQ(plasticityIndex(kModulus, kHardness, 4.0 * 3e-9, 300e-9), 2.0 * index);
  EXPECT_DOUBLE_EQ(plasticityIndex(kModulus, kHardness, 3e-9, 4.0 * 300e-9), 0.5 * index);
}

TEST(PlasticityIndex, isZeroForFlatOrSmoothOrUnyieldingBodies) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(plasticityIndex(kModulus, kHardness, 3e-9, infinity), 0.0);
  EXPECT_EQ(plasticityIndex(kModulus, kHardness, 0.0, 300e-9), 0.0);
  EXPECT_EQ(plasticityIndex(kModulus, infinity, 3e-9, 300e-9), 0.0);
}

TEST(RegimeFactor, isOneBelowTheElasticLimitAndZeroAboveThePlasticLimit) {
  EXPECT_EQ(regimeFactor(0.0), 1.0);
  EXPECT_EQ(regimeFactor(0.599), 1.0);
  EXPECT_EQ(regimeFactor(1.101), 0.0);
  EXPECT_EQ(regimeFactor(50.0), 0.0);
}

TEST(RegimeFactor, fallsInAStraightLineBetween) {
  const double step = 1e-6;
  for (const double index : {0.65, 0.8, 1.05}) {
    // a straight line: only round-off, 1e-16/1e-6
    EXPECT_NEAR((regimeFactor(index + step) - regimeFactor(index - step)) / (2.0 * step), -2.0,
                1e-9);
  }
}

TEST(RegimeFactor, isContinuousAtBothLimits) {
  const double tiny = 1e-12;
  EXPECT_NEAR(regimeFactor(kElasticLimit + tiny), regimeFactor(kElasticLimit - tiny),
              5.0 * tiny);  // slope 2 over 2 tiny
  EXPECT_NEAR(regimeFactor(kPlasticLimit - tiny), regimeFactor(kPlasticLimit + tiny), 5.0 * tiny);
}

TEST(RegimeFactor, doesNotHideAnUndefinedIndex) {
  EXPECT_TRUE(std::isnan(regimeFactor(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace mems_stiction
