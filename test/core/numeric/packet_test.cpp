/// Every operator of four numbers at once against the same operator of one number, to the bit.

#include "numeric/packet.hpp"

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
const std::vector<double> kNumbers = {0.0,       -0.0,        1.0,   -1.0 / 3.0, 2e-9,
                                      -7e-10,    1.0 + 1e-16, 3e200, -4e-310,    5e-324,
                                      kInfinity, -kInfinity,  kNan};

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

/// visit(a, b, Packet of a, Packet of b) for all pairs of numbers, each in every element.
template <typename Visitor>
void forEachPair(const Visitor& visit) {
  const std::size_t count = kNumbers.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t shift = 0; shift < count; ++shift) {
      double a[Packet::kCount];
      double b[Packet::kCount];
      for (std::size_t element = 0; element < Packet::kCount; ++element) {
        a[element] = kNumbers[(i + element) % count];
        b[element] = kNumbers[(i + element + shift) % count];
      }
      visit(a, b, Packet::load(a), Packet::load(b));
    }
  }
}

TEST(Packet, calculateAsOneNumberDoes) {
  forEachPair([](const double* a, const double* b, const Packet& packet_a, const Packet& packet_b) {
    Packet added = packet_a;
    added += packet_b;
    for (std::size_t element = 0; element < Packet::kCount; ++element) {
      expectSame((packet_a + packet_b)[element], a[element] + b[element]);
      expectSame((packet_a - packet_b)[element], a[element] - b[element]);
      expectSame((packet_a * packet_b)[element], a[element] * b[element]);
      expectSame((packet_a / packet_b)[element], a[element] / b[element]);
      expectSame(added[element], a[element] + b[element]);
    }
  });
}

TEST(Packet, compareAndSelectAsOneNumberDoes) {
  forEachPair([](const double* a, const double* b, const Packet& packet_a, const Packet& packet_b) {
    int less = 0;
    int greater = 0;
    int equal = 0;
    for (std::size_t element = 0; element < Packet::kCount; ++element) {
      expectSame(select(packet_a < packet_b, packet_a, packet_b)[element],
                 select(a[element] < b[element], a[element], b[element]));
      expectSame(select(packet_a > packet_b, packet_a, packet_b)[element],
                 select(a[element] > b[element], a[element], b[element]));
      expectSame(select(packet_a == packet_b, packet_a, packet_b)[element],
                 select(a[element] == b[element], a[element], b[element]));
      less += a[element] < b[element] ? 1 : 0;
      greater += a[element] > b[element] ? 1 : 0;
      equal += a[element] == b[element] ? 1 : 0;
    }
    EXPECT_EQ((packet_a < packet_b).count(), less);
    EXPECT_EQ((packet_a > packet_b).count(), greater);
    EXPECT_EQ((packet_a == packet_b).count(), equal);
  });
}

TEST(Packet, comeFromOneNumberFromFourAndFromMemory) {
  const double doubles[] = {1.5, -2e-9, kInfinity, 7.0};
  const float floats[] = {1.5F, -2e-9F, -std::numeric_limits<float>::infinity(), 0.1F};
  const Packet same = -3.25;
  const Packet four(1.0, 2.0, 3.0, 4.0);
  for (std::size_t element = 0; element < Packet::kCount; ++element) {
    EXPECT_EQ(same[element], -3.25);
    EXPECT_EQ(four[element], static_cast<double>(element + 1));
    EXPECT_EQ(Packet::load(doubles)[element], doubles[element]);
    EXPECT_EQ(Packet::load(floats)[element], static_cast<double>(floats[element]));
    for (std::size_t count = 0; count <= Packet::kCount; ++count) {
      EXPECT_EQ(Packet::loadFirst(doubles, count, 9.0)[element],
                element < count ? doubles[element] : 9.0);
      EXPECT_EQ(Packet::loadFirst(floats, count, 9.0)[element],
                element < count ? static_cast<double>(floats[element]) : 9.0);
    }
  }
}

TEST(Packet, areReducedFromTheFirstToTheLast) {
  const Packet packet(1e16, 1.0, -1e16, 1.0);  // in another order the sum is 0 or 2
  EXPECT_EQ(packet.sum(), ((1e16 + 1.0) - 1e16) + 1.0);
  EXPECT_EQ(packet.smallest(), -1e16);
  EXPECT_EQ(packet.largest(), 1e16);
}

}  // namespace
}  // namespace mems_stiction
