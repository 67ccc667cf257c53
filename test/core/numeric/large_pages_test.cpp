#include "numeric/large_pages.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

TEST(LargePageVector, keepsItsValuesWhileItGrowsFromSmallToSeveralLargePages) {
  LargePageVector<std::uint64_t> values;
  constexpr std::uint64_t kCount = 1000003;  // 8 MB, and a rest that fills no large page
  for (std::uint64_t i = 0; i < kCount; ++i) values.push_back(i);
  std::vector<std::uint64_t> expected(kCount);
  std::iota(expected.begin(), expected.end(), 0U);
  EXPECT_TRUE(std::equal(values.begin(), values.end(), expected.begin(), expected.end()));
}

TEST(LargePageVector, isCopiedMovedAndSwapped) {
  const LargePageVector<float> original(3000000, 1.5F);
  LargePageVector<float> copy = original;
  LargePageVector<float> other(10, 2.5F);
  copy.swap(other);
  const LargePageVector<float> moved = std::move(other);
  EXPECT_EQ(moved, original);
  EXPECT_EQ(copy, LargePageVector<float>(10, 2.5F));
}

TEST(LargePageVector, refusesMoreThanThereIsAndStaysAsItWas) {
  LargePageVector<double> values(7, 1.0);
  EXPECT_THROW(values.reserve(std::numeric_limits<std::size_t>::max()), std::length_error);
  EXPECT_EQ(values, LargePageVector<double>(7, 1.0));
}

}  // namespace
}  // namespace mems_stiction
