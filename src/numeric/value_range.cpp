#include "numeric/value_range.hpp"

#include "numeric/lanes.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {

MEMS_STICTION_VECTORIZED void addToRange(const double* values, std::size_t size, ValueRange& range) {
  Lanes lowest = range.lowest;
  Lanes highest = range.highest;
  Lanes count;
  const auto add = [&](const Lanes& lanes) {
    lowest = select(lanes < lowest, lanes, lowest);
    highest = select(lanes > highest, lanes, highest);
    count += oneWhere(isNumber(lanes));
  };
  std::size_t i = 0;
  for (; i + Lanes::kCount <= size; i += Lanes::kCount) add(Lanes::load(values + i));
  if (i < size) add(Lanes::loadFirst(values + i, size - i, std::numeric_limits<double>::quiet_NaN()));
  range.lowest = lowest.smallest();
  range.highest = highest.largest();
  range.count += static_cast<long long>(count.sum());
}

}  // namespace mems_stiction
