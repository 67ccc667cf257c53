#include "numeric/value_range.hpp"

#include "numeric/packet.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {

MEMS_STICTION_VECTORIZED void addToRange(const double* values, std::size_t size,
                                         ValueRange& range) {
  Packet lowest = range.lowest;
  Packet highest = range.highest;
  Packet count;
  const auto add = [&](const Packet& packet) {
    lowest = select(packet < lowest, packet, lowest);
    highest = select(packet > highest, packet, highest);
    count += oneWhere(isNumber(packet));
  };
  std::size_t i = 0;
  for (; i + Packet::kCount <= size; i += Packet::kCount) add(Packet::load(values + i));
  if (i < size)
    add(Packet::loadFirst(values + i, size - i, std::numeric_limits<double>::quiet_NaN()));
  range.lowest = lowest.smallest();
  range.highest = highest.largest();
  range.count += static_cast<long long>(count.sum());
}

}  // namespace mems_stiction
