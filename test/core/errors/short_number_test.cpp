#include "errors/short_number.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

TEST(ShortNumber, HasNoExponentUpToAMillionAndNoSignOfWhatIsNoNumber) {
  EXPECT_EQ(shortNumber(7254.0), "7250");
  EXPECT_EQ(shortNumber(999999.0), "1000000");
  EXPECT_EQ(shortNumber(0.029941), "0.0299");
  EXPECT_EQ(shortNumber(2.58e-7, 2), "2.6e-07");
  EXPECT_EQ(shortNumber(-std::nan("")), "nan");
}

TEST(ShortNumber, AWideIntervalLeavesTwoDigits) {
  EXPECT_EQ(knownDigits(2.1, 1.5, 2.9), 2);
  EXPECT_EQ(knownDigits(2.1, 2.05, 2.15), 3);
  EXPECT_EQ(knownDigits(2.1, std::nan(""), std::nan("")), 3);
  EXPECT_EQ(withInterval(2.123e-7, 1.512e-7, 2.949e-7, "N"),
            "2.1e-07 N, 95 % within 1.5e-07 to 2.9e-07 N");
  EXPECT_EQ(withInterval(3.2456, 3.2, 3.29), "3.25, 95 % within 3.2 to 3.29");
  EXPECT_EQ(withInterval(3.2456, std::nan(""), std::nan("")), "3.25");
  EXPECT_EQ(withInterval(HUGE_VAL, HUGE_VAL, HUGE_VAL), "inf");
}

}  // namespace
}  // namespace mems_stiction
