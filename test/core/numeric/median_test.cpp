#include "numeric/median.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The finder's median against that of the valid values by sorting, to the bit.
void expectSame(const std::vector<double>& values) {
  std::vector<double> valid;
  for (const double value : values) {
    if (!std::isnan(value)) valid.push_back(value);
  }
  MedianFinder finder;
  EXPECT_EQ(finder.median(values.data(), values.size()), medianOf(valid))
      << values.size() << " values";
}

std::vector<double> normal(std::size_t size, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> distribution;
  std::vector<double> values(size);
  for (double& value : values) value = distribution(engine);
  return values;
}

TEST(MedianFinder, agreesWithSortingForEverySmallSize) {
  for (std::size_t size = 0; size < 700; ++size)
    expectSame(normal(size, static_cast<unsigned>(size)));
}

TEST(MedianFinder, agreesOnManyValues) {
  for (const std::size_t size : {65536u, 100001u, 262144u}) expectSame(normal(size, 1));
}

TEST(MedianFinder, agreesWhereManyValuesAreEqual) {
  for (const double step : {0.1, 1.0, 3.0, 100.0}) {
    for (const std::size_t size : {100u, 999u, 20000u}) {
      std::vector<double> values = normal(size, 2);
      for (double& value : values) value = std::round(value / step) * step;
      expectSame(values);
    }
  }
}

TEST(MedianFinder, takesTheMeanOfTwoValuesThatLieFarApart) {
  std::vector<double> values(1000, -5.0);
  std::fill(values.begin() + 500, values.end(), 7.0);
  MedianFinder finder;
  EXPECT_EQ(finder.median(values.data(), values.size()), 1.0);
  EXPECT_EQ(finder.median(values.data(), 999), -5.0);
}

TEST(MedianFinder, leavesInvalidValuesOut) {
  std::vector<double> values = normal(5000, 3);
  std::mt19937 engine(4);
  for (double& value : values) {
    if (engine() % 3 == 0) value = kNan;
  }
  expectSame(values);
  MedianFinder finder;
  const std::vector<double> nothing(1000, kNan);
  EXPECT_EQ(finder.median(nothing.data(), nothing.size()), 0.0);
}

TEST(MedianFinder, findsItAmongValuesOfEveryMagnitude) {
  // Buckets of equal width part such values only a few at a time.
  std::vector<double> values;
  for (int exponent = -300; exponent <= 300; ++exponent) {
    for (int count = 0; count < 3; ++count)
      values.push_back(std::pow(10.0, exponent) * (1.0 + 0.1 * count));
  }
  expectSame(values);
  values = normal(2000, 5);
  values[7] = 1e200;
  values[8] = -1e300;
  values[9] = 1e308;
  expectSame(values);
}

TEST(MedianFinder, findsItAmongTheSmallestNumbersThereAre) {
  std::vector<double> values;
  for (int count = 0; count < 1001; ++count)
    values.push_back(count * std::numeric_limits<double>::denorm_min());
  expectSame(values);
}

}  // namespace
}  // namespace mems_stiction
