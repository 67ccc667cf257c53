#include "mems_stiction/base/value_range.hpp"

#include "mems_stiction/base/lanes.hpp"
#include "mems_stiction/base/vectorized.hpp"

namespace mems_stiction {

MEMS_STICTION_VECTORIZED void addToRange(const double* values, std::size_t size, ValueRange& range) {
  Lanes lowest = Lanes{} + range.lowest;
  Lanes highest = Lanes{} + range.highest;
  LaneMask count{};
  Lanes lanes;
  std::size_t i = 0;
  for (; i + kLanes <= size; i += kLanes) {
    load(values + i, lanes);
    lowest = lanes < lowest ? lanes : lowest;
    highest = lanes > highest ? lanes : highest;
    count -= lanes == lanes;
  }
  for (; i < size; ++i) {
    lowest[0] = values[i] < lowest[0] ? values[i] : lowest[0];
    highest[0] = values[i] > highest[0] ? values[i] : highest[0];
    count[0] += values[i] == values[i];
  }
  range.lowest = smallestOf(lowest);
  range.highest = largestOf(highest);
  range.count += count[0] + count[1] + count[2] + count[3];
}

}  // namespace mems_stiction
