#include "numeric/lane_functions.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

TEST(LanePower, isThatOfTheLibrary) {
  for (const double exponent : {1.4 / 3.0, -1.0 / 9.0, 0.9}) {
    for (double x = 1e-290; x < 1e290; x *= 7.3e2) {
      const Lanes four(x, 1.1 * x, 1.41421 * x, 1.41422 * x);
      const Lanes result = power(four, exponent);
      for (std::size_t lane = 0; lane < Lanes::kCount; ++lane) {
        const double expected = std::pow(four[lane], exponent);
        ASSERT_NEAR(result[lane] / expected, 1.0, 1e-8) << four[lane] << " to " << exponent;  // what its comment states
      }
    }
  }
}

TEST(LanePower, ofOneIsOne) {
  const Lanes result = power(Lanes(1.0), 0.3);
  for (std::size_t lane = 0; lane < Lanes::kCount; ++lane) EXPECT_EQ(result[lane], 1.0);
}

TEST(LaneFunctions, areThoseOfTheirNumbers) {
  const Lanes numbers(4.0, 0.0, 2.25, 1e-300);
  const Lanes roots = squareRoot(numbers);
  const Lanes greatest = greater(numbers, Lanes(1.0));
  for (std::size_t lane = 0; lane < Lanes::kCount; ++lane) {
    EXPECT_EQ(roots[lane], std::sqrt(numbers[lane]));
    EXPECT_EQ(greatest[lane], std::fmax(numbers[lane], 1.0));
  }
  EXPECT_TRUE(isAnywhere(numbers > 3.0));
  EXPECT_FALSE(isAnywhere(numbers > 5.0));
}

}  // namespace
}  // namespace mems_stiction
