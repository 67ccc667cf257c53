#include "paper/level_search.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

TEST(LevelSearch, findsTheFirstLevelOfAConditionThatStaysMet) {
  for (int count = 1; count <= 60; ++count) {
    for (int first = 0; first <= count; ++first) {
      int last_asked = -1;
      const int found = firstLevelThat(count, [&](int level) {
        last_asked = level;
        return level >= first;
      });
      ASSERT_EQ(found, first) << count << " levels";
      if (found == count) continue;
      ASSERT_EQ(last_asked, found);
    }
  }
}

TEST(LevelSearch, returnsALevelThatMeetsAConditionThatComesAndGoes) {
  const auto holds = [](int level) { return level % 3 == 1; };
  for (int count = 4; count <= 60; ++count) {
    const int found = firstLevelThat(count, holds);
    EXPECT_TRUE(found == count || holds(found)) << count << " levels";
  }
}

TEST(LevelSearch, returnsTheCountIfNothingMeetsTheCondition) {
  EXPECT_EQ(firstLevelThat(0, [](int) { return true; }), 0);
  EXPECT_EQ(firstLevelThat(17, [](int) { return false; }), 17);
}

TEST(LevelSearch, asksInAscendingOrderButForOneRestart) {
  for (const int first : {0, 1, 40, 63, 99, 100}) {
    std::vector<int> asked;
    firstLevelThat(100, [&](int level) {
      asked.push_back(level);
      return level >= first;
    });
    int restarts = 0;
    for (std::size_t i = 1; i < asked.size(); ++i) restarts += asked[i] <= asked[i - 1] ? 1 : 0;
    EXPECT_LE(restarts, 1);
    // two passes of ten groups of ten at most
    EXPECT_LE(asked.size(), 20u);
  }
}

}  // namespace
}  // namespace mems_stiction
