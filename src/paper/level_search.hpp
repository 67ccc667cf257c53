#pragma once

/// @file
/// Where, inside the step of the approach that meets a condition, is the condition met first?

#include <algorithm>
#include <cmath>

namespace mems_stiction {

/// Searches the levels 0 .. count-1 of the step in two passes: the ends of groups of sqrt(count)
/// levels, then the levels of the first group whose end meets the condition, one by one. Each pass
/// asks in ascending order, so that a sweep starts over once at most.
/// - @p is_met bool(int level); its last call is for the returned level.
/// @return the level, or count if no end of a group meets the condition.
template <typename Condition>
int firstLevelThat(int count, Condition&& is_met) {
  const int group = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))));
  for (int begin = 0; begin < count; begin += group) {
    const int last = std::min(begin + group, count) - 1;
    if (!is_met(last)) continue;
    for (int level = begin; level <= last; ++level) {
      if (is_met(level)) return level;
    }
  }
  return count;
}

}  // namespace mems_stiction
