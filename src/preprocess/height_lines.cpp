#include "preprocess/height_lines.hpp"

#include <cmath>
#include <limits>

#include "numeric/packet.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

template <typename Scalar>
MEMS_STICTION_INLINE void widen(const Scalar* source, std::size_t size, double* line) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < size; ++i) {
    const double height = source[i];
    line[i] = std::fabs(height) <= kLargest ? height : kNan;
  }
}

/// Visits the values of two lines in packets; those behind the end are NaN.
template <typename Visit>
MEMS_STICTION_INLINE void forElements(const double* first, const double* second, std::size_t size,
                                      const Visit& visit) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::size_t i = 0;
  for (; i + Packet::kCount <= size; i += Packet::kCount) {
    visit(i, Packet::kCount, Packet::load(first + i), Packet::load(second + i));
  }
  if (i == size) return;
  const std::size_t rest = size - i;
  visit(i, rest, Packet::loadFirst(first + i, rest, kNan),
        Packet::loadFirst(second + i, rest, kNan));
}

MEMS_STICTION_INLINE void store(const Packet& packet, std::size_t count, double* values) {
  if (count == Packet::kCount) {
    packet.store(values);
  } else {
    packet.storeFirst(count, values);
  }
}

template <typename Real>
MEMS_STICTION_INLINE Real lessCurve(const LineCurve& curve, const Real& height, const Real& place) {
  return (height - curve.origin) - (curve.a + place * (curve.b + curve.c * place));
}

/// Changes of the valid pixels among up to four.
struct ChangeLanes {
  Packet squares;
  Packet count;
  Packet changed;

  MEMS_STICTION_INLINE void add(const Packet& before, const Packet& after) {
    const Packet change = after - before;
    squares += select(isNumber(change), change * change, 0.0);
    count += oneWhere(isNumber(change));
    changed += oneWhere((change < 0.0) | (change > 0.0));
  }
  void addTo(ChangeSums& sums) const {
    sums.squares += squares.sum();
    sums.count += static_cast<long long>(count.sum());
    sums.changed += static_cast<long long>(changed.sum());
  }
};

}  // namespace

MEMS_STICTION_VECTORIZED void widenLine(const float* source, std::size_t size, double* line) {
  widen(source, size, line);
}

MEMS_STICTION_VECTORIZED void widenLine(const double* source, std::size_t size, double* line) {
  widen(source, size, line);
}

MEMS_STICTION_VECTORIZED LineSums sumsOf(const double* line, const double* places, std::size_t size,
                                         double origin) {
  Packet count, p, pp, h, ph;
  forElements(line, places, size,
              [&](std::size_t, std::size_t, const Packet& heights, const Packet& all_places) {
                const PacketMask is_valid = isNumber(heights);
                const Packet height = select(is_valid, heights - origin, 0.0);
                const Packet place = select(is_valid, all_places, 0.0);
                count += oneWhere(is_valid);
                p += place;
                pp += place * place;
                h += height;
                ph += place * height;
              });
  return {count.sum(), p.sum(), pp.sum(), h.sum(), ph.sum()};
}

MEMS_STICTION_VECTORIZED void subtractCurve(const LineCurve& curve, const double* places,
                                            std::size_t size, double* line, ChangeSums& changes) {
  const LineCurve local = curve;
  ChangeLanes sums;
  forElements(
      line, places, size,
      [&](std::size_t i, std::size_t count, const Packet& heights, const Packet& all_places) {
        const Packet flat = lessCurve(local, heights, all_places);
        sums.add(heights, flat);
        store(flat, count, line + i);
      });
  sums.addTo(changes);
}

MEMS_STICTION_VECTORIZED void flattenLine(const LineCurve& curve, const double* places,
                                          const double* line, std::size_t size, double* flat) {
  const LineCurve local = curve;
  forElements(
      line, places, size,
      [&](std::size_t i, std::size_t count, const Packet& heights, const Packet& all_places) {
        store(lessCurve(local, heights, all_places), count, flat + i);
      });
}

MEMS_STICTION_VECTORIZED void addChanges(const double* before, const double* after,
                                         std::size_t size, ChangeSums& changes) {
  ChangeLanes sums;
  forElements(before, after, size,
              [&](std::size_t, std::size_t, const Packet& old_heights, const Packet& heights) {
                sums.add(old_heights, heights);
                sums.changed += oneWhere(isNumber(old_heights) ^ isNumber(heights));
              });
  sums.addTo(changes);
}

MEMS_STICTION_VECTORIZED void distancesFrom(const LineCurve& curve, const double* places,
                                            const double* line, std::size_t size,
                                            double* distances) {
  const LineCurve local = curve;
  for (std::size_t i = 0; i < size; ++i) {
    distances[i] = std::fabs(lessCurve(local, line[i], places[i]));
  }
}

MEMS_STICTION_VECTORIZED void subtractTo(const double* line, double height, std::size_t size,
                                         double* difference) {
  for (std::size_t i = 0; i < size; ++i) difference[i] = line[i] - height;
}

MEMS_STICTION_VECTORIZED void subtractTo(const double* line, const double* other, std::size_t size,
                                         double* difference) {
  for (std::size_t i = 0; i < size; ++i) difference[i] = line[i] - other[i];
}

MEMS_STICTION_VECTORIZED void makeDistances(double from, double* values, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) values[i] = std::fabs(values[i] - from);
}

MEMS_STICTION_VECTORIZED LimitCount countAbove(double limit, const double* values,
                                               std::size_t size) {
  Packet above, invalid;
  std::size_t i = 0;
  for (; i + Packet::kCount <= size; i += Packet::kCount) {
    const Packet packet = Packet::load(values + i);
    above += oneWhere(packet > limit);
    invalid += select(isNumber(packet), Packet(0.0), Packet(1.0));
  }
  LimitCount count{static_cast<long long>(above.sum()), static_cast<long long>(invalid.sum())};
  for (; i < size; ++i) {
    count.above += values[i] > limit;
    count.invalid += std::isnan(values[i]);
  }
  return count;
}

}  // namespace mems_stiction
