#include "surface/numbered_noise.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

TEST(NumberedNoise, isBoxAndMullersFormulaOnPhiloxOfTheCellsNumber) {
  constexpr std::uint64_t kSeed = 0x0123456789abcdefU;
  NumberedNoise noise(kSeed, 5);
  constexpr int kCount = 4096;
  std::vector<float> values(kCount);
  noise.fill(-3, -2048, kCount, values.data());
  for (int i = 0; i < kCount; i += 4) {
    const auto bits = r123::Philox4x32()(
        {{static_cast<std::uint32_t>((i - 2048) / 4), static_cast<std::uint32_t>(-3), 5, 0}},
        {{0x89abcdefU, 0x01234567U}});
    for (int pair = 0; pair < 2; ++pair) {
      const double radius =
          std::sqrt(-2.0 * std::log((bits[static_cast<std::size_t>(2 * pair)] + 0.5) * 0x1p-32));
      const double angle = 2.0 * kPi * bits[static_cast<std::size_t>(2 * pair + 1)] * 0x1p-32;
      const auto index = static_cast<std::size_t>(i + 2 * pair);
      EXPECT_FLOAT_EQ(values[index], static_cast<float>(radius * std::cos(angle)));
      EXPECT_FLOAT_EQ(values[index + 1], static_cast<float>(radius * std::sin(angle)));
    }
  }
}

// Machines that share a surface must agree: a processor or compiler that rounds otherwise would
// show here.
TEST(NumberedNoise, hasTheSameBitsOnEveryMachine) {
  NumberedNoise noise(20, 3);
  std::vector<float> values(1 << 16);
  noise.fill(12345, 6789 * 8, 1 << 16, values.data());
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a
  for (const float value : values) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    hash = (hash ^ bits) * 1099511628211U;
  }
  EXPECT_EQ(hash, 9954758820825403434U);
}

TEST(NumberedNoise, doesNotDependOnWhatWasAskedFor) {
  NumberedNoise noise(1, 0);
  std::vector<float> row(256);
  noise.fill(17, 1000, 256, row.data());
  std::vector<float> part(64);
  noise.fill(17, 1080, 64, part.data());
  for (std::size_t i = 0; i < part.size(); ++i) EXPECT_EQ(part[i], row[i + 80]);
}

TEST(NumberedNoise, isTheSameWhereItIsRemembered) {
  NumberedNoise noise(1, 0);
  noise.remember(4, -64, 256);
  const auto expectSame = [&](std::int64_t row, std::int64_t col, int count, std::uint64_t seed) {
    std::vector<float> expected(static_cast<std::size_t>(count));
    NumberedNoise(seed, 0).fill(row, col, count, expected.data());
    std::vector<float> values(expected.size());
    noise.fill(row, col, count, values.data());
    EXPECT_EQ(values, expected) << row << ", " << col;
  };
  for (const std::int64_t row : {0, -1, 3, 4, -1, 0}) {  // 4 takes the place of 0, and 0 that of 4
    expectSame(row, 0, 64, 1);
    expectSame(row, 32, 72, 1);    // goes on
    expectSame(row, -64, 256, 1);  // from before
    expectSame(row, 120, 64, 1);
    expectSame(row, -128, 512, 1);  // more than is remembered
  }
  noise.reseed(2);
  expectSame(0, 0, 64, 2);
}

TEST(NumberedNoise, isNormalAndIndependentOfItsNeighboursLayersAndSeeds) {
  constexpr int kCount = 1 << 16;
  constexpr int kRows = 16;
  std::vector<float> values(kCount);
  std::vector<float> below(kCount);
  std::vector<float> other_layer(kCount);
  std::vector<float> other_seed(kCount);
  std::array<double, 5> moments{};
  std::array<double, 4> products{};
  NumberedNoise noise(2, 1);
  for (int row = 0; row < kRows; ++row) {
    noise.fill(row, 0, kCount, values.data());
    noise.fill(row + 100, 0, kCount, below.data());
    NumberedNoise(2, 2).fill(row, 0, kCount, other_layer.data());
    NumberedNoise(3, 1).fill(row, 0, kCount, other_seed.data());
    for (std::size_t i = 0; i < kCount; ++i) {
      const double value = values[i];
      double power = 1.0;
      for (double& moment : moments) {
        moment += power;
        power *= value;
      }
      products[0] += value * values[(i + 1) % kCount];
      products[1] += value * below[i];
      products[2] += value * other_layer[i];
      products[3] += value * other_seed[i];
    }
  }
  const double count = moments[0];
  const double error =
      1.0 / std::sqrt(count);  // of a mean of variance 1; four of them come about once in 16000
  EXPECT_NEAR(moments[1] / count, 0.0, 4.0 * error);
  EXPECT_NEAR(moments[2] / count, 1.0, 4.0 * error * std::sqrt(2.0));
  EXPECT_NEAR(moments[3] / count, 0.0, 4.0 * error * std::sqrt(15.0));
  EXPECT_NEAR(moments[4] / count, 3.0, 4.0 * error * std::sqrt(96.0));
  for (const double product : products) EXPECT_NEAR(product / count, 0.0, 4.0 * error);
}

}  // namespace
}  // namespace mems_stiction
