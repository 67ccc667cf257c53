#include "numeric/packet_functions.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

TEST(LanePower, isThatOfTheLibrary) {
  for (const double exponent : {1.4 / 3.0, -1.0 / 9.0, 0.9}) {
    for (double x = 1e-290; x < 1e290; x *= 7.3e2) {
      const Packet four(x, 1.1 * x, 1.41421 * x, 1.41422 * x);
      const Packet result = power(four, exponent);
      for (std::size_t element = 0; element < Packet::kCount; ++element) {
        const double expected = std::pow(four[element], exponent);
        ASSERT_NEAR(result[element] / expected, 1.0, 1e-8)
            << four[element] << " to " << exponent;  // what its comment states
      }
    }
  }
}

TEST(LanePower, ofOneIsOne) {
  const Packet result = power(Packet(1.0), 0.3);
  for (std::size_t element = 0; element < Packet::kCount; ++element)
    EXPECT_EQ(result[element], 1.0);
}

TEST(LaneFunctions, areThoseOfTheirNumbers) {
  const Packet numbers(4.0, 0.0, 2.25, 1e-300);
  const Packet roots = squareRoot(numbers);
  const Packet greatest = greater(numbers, Packet(1.0));
  for (std::size_t element = 0; element < Packet::kCount; ++element) {
    EXPECT_EQ(roots[element], std::sqrt(numbers[element]));
    EXPECT_EQ(greatest[element], std::fmax(numbers[element], 1.0));
  }
  EXPECT_TRUE(isAnywhere(numbers > 3.0));
  EXPECT_FALSE(isAnywhere(numbers > 5.0));
}

}  // namespace
}  // namespace mems_stiction
