/// Every operator of four numbers at once against the same operator of one number, to the bit.

#include "numeric/lanes.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Of every size and sign, with all that arithmetic treats on its own.
const std::vector<double> kNumbers = {0.0,   -0.0,    1.0,    -1.0 / 3.0, 2e-9,       -7e-10, 1.0 + 1e-16,
                                      3e200, -4e-310, 5e-324, kInfinity,  -kInfinity, kNan};

std::uint64_t bitsOf(double number) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  return bits;
}

/// NaNs may differ in sign and payload, which no result depends on.
void expectSame(double found, double expected) {
  if (std::isnan(expected)) {
    EXPECT_TRUE(std::isnan(found));
  } else {
    EXPECT_EQ(bitsOf(found), bitsOf(expected)) << found << " " << expected;
  }
}

/// visit(a, b, Lanes of a, Lanes of b) for all pairs of numbers, each in every lane.
template <typename Visitor>
void forEachPair(const Visitor& visit) {
  const std::size_t count = kNumbers.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t shift = 0; shift < count; ++shift) {
      double a[Lanes::kCount];
      double b[Lanes::kCount];
      for (std::size_t lane = 0; lane < Lanes::kCount; ++lane) {
        a[lane] = kNumbers[(i + lane) % count];
        b[lane] = kNumbers[(i + lane + shift) % count];
      }
      visit(a, b, Lanes::load(a), Lanes::load(b));
    }
  }
}

TEST(Lanes, calculateAsOneNumberDoes) {
  forEachPair([](const double* a, const double* b, const Lanes& lanes_a, const Lanes& lanes_b) {
    Lanes added = lanes_a;
    added += lanes_b;
    for (std::size_t lane = 0; lane < Lanes::kCount; ++lane) {
      expectSame((lanes_a + lanes_b)[lane], a[lane] + b[lane]);
      expectSame((lanes_a - lanes_b)[lane], a[lane] - b[lane]);
      expectSame((lanes_a * lanes_b)[lane], a[lane] * b[lane]);
      expectSame((lanes_a / lanes_b)[lane], a[lane] / b[lane]);
      expectSame(added[lane], a[lane] + b[lane]);
    }
  });
}

TEST(Lanes, compareAndSelectAsOneNumberDoes) {
  forEachPair([](const double* a, const double* b, const Lanes& lanes_a, const Lanes& lanes_b) {
    int less = 0;
    int greater = 0;
    int equal = 0;
    for (std::size_t lane = 0; lane < Lanes::kCount; ++lane) {
      expectSame(select(lanes_a < lanes_b, lanes_a, lanes_b)[lane], select(a[lane] < b[lane], a[lane], b[lane]));
      expectSame(select(lanes_a > lanes_b, lanes_a, lanes_b)[lane], select(a[lane] > b[lane], a[lane], b[lane]));
      expectSame(select(lanes_a == lanes_b, lanes_a, lanes_b)[lane], select(a[lane] == b[lane], a[lane], b[lane]));
      less += a[lane] < b[lane] ? 1 : 0;
      greater += a[lane] > b[lane] ? 1 : 0;
      equal += a[lane] == b[lane] ? 1 : 0;
    }
    EXPECT_EQ((lanes_a < lanes_b).count(), less);
    EXPECT_EQ((lanes_a > lanes_b).count(), greater);
    EXPECT_EQ((lanes_a == lanes_b).count(), equal);
  });
}

TEST(Lanes, comeFromOneNumberFromFourAndFromMemory) {
  const double doubles[] = {1.5, -2e-9, kInfinity, 7.0};
  const float floats[] = {1.5F, -2e-9F, -std::numeric_limits<float>::infinity(), 0.1F};
  const Lanes same = -3.25;
  const Lanes four(1.0, 2.0, 3.0, 4.0);
  for (std::size_t lane = 0; lane < Lanes::kCount; ++lane) {
    EXPECT_EQ(same[lane], -3.25);
    EXPECT_EQ(four[lane], static_cast<double>(lane + 1));
    EXPECT_EQ(Lanes::load(doubles)[lane], doubles[lane]);
    EXPECT_EQ(Lanes::load(floats)[lane], static_cast<double>(floats[lane]));
    for (std::size_t count = 0; count <= Lanes::kCount; ++count) {
      EXPECT_EQ(Lanes::loadFirst(doubles, count, 9.0)[lane], lane < count ? doubles[lane] : 9.0);
      EXPECT_EQ(Lanes::loadFirst(floats, count, 9.0)[lane], lane < count ? static_cast<double>(floats[lane]) : 9.0);
    }
  }
}

TEST(Lanes, areReducedFromTheFirstToTheLast) {
  const Lanes lanes(1e16, 1.0, -1e16, 1.0);  // in another order the sum is 0 or 2
  EXPECT_EQ(lanes.sum(), ((1e16 + 1.0) - 1e16) + 1.0);
  EXPECT_EQ(lanes.smallest(), -1e16);
  EXPECT_EQ(lanes.largest(), 1e16);
}

}  // namespace
}  // namespace mems_stiction
