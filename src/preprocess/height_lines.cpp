#include "mems_stiction/preprocess/height_lines.hpp"

#include <cmath>
#include <limits>

#include "mems_stiction/base/lanes.hpp"
#include "mems_stiction/base/vectorized.hpp"

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

/// Visits the values of up to two lines in lanes; those behind the end are NaN.
template <typename Visit>
MEMS_STICTION_INLINE void forLanes(const double* first, const double* second, std::size_t size, const Visit& visit) {
  Lanes a, b;
  std::size_t i = 0;
  for (; i + kLanes <= size; i += kLanes) {
    load(first + i, a);
    load(second + i, b);
    visit(i, kLanes, a, b);
  }
  if (i == size) return;
  a = b = Lanes{} + std::numeric_limits<double>::quiet_NaN();
  for (std::size_t lane = 0; i + lane < size; ++lane) {
    a[lane] = first[i + lane];
    b[lane] = second[i + lane];
  }
  visit(i, size - i, a, b);
}

MEMS_STICTION_INLINE void store(const Lanes& lanes, std::size_t count, double* values) {
  if (count == kLanes) {
    std::memcpy(values, &lanes, sizeof lanes);
  } else {
    for (std::size_t lane = 0; lane < count; ++lane) values[lane] = lanes[lane];
  }
}

MEMS_STICTION_INLINE void lessCurve(const LineCurve& curve, const Lanes& heights, const Lanes& places, Lanes& flat) {
  flat = (heights - curve.origin) - (curve.a + places * (curve.b + curve.c * places));
}

MEMS_STICTION_INLINE long long countOf(const LaneMask& counts) { return counts[0] + counts[1] + counts[2] + counts[3]; }

/// Changes of the valid pixels among up to four.
struct ChangeLanes {
  Lanes squares{};
  LaneMask count{};
  LaneMask changed{};

  void addTo(ChangeSums& sums) const {
    sums.squares += sumOf(squares);
    sums.count += countOf(count);
    sums.changed += countOf(changed);
  }
};

MEMS_STICTION_INLINE void addChange(const Lanes& before, const Lanes& after, ChangeLanes& sums) {
  const Lanes change = after - before;
  sums.squares += change == change ? change * change : Lanes{};
  sums.count -= change == change;
  sums.changed -= (change < 0.0) | (change > 0.0);
}

}  // namespace

MEMS_STICTION_VECTORIZED void widenLine(const float* source, std::size_t size, double* line) {
  widen(source, size, line);
}

MEMS_STICTION_VECTORIZED void widenLine(const double* source, std::size_t size, double* line) {
  widen(source, size, line);
}

MEMS_STICTION_VECTORIZED PlaceSums sumsOf(const double* line, const double* places, std::size_t size, double origin) {
  Lanes count{}, p{}, pp{}, h{}, ph{};
  forLanes(line, places, size, [&](std::size_t, std::size_t, const Lanes& heights, const Lanes& all_places) {
    const Lanes height = heights == heights ? heights - origin : Lanes{};
    const Lanes place = heights == heights ? all_places : Lanes{};
    count += heights == heights ? Lanes{} + 1.0 : Lanes{};
    p += place;
    pp += place * place;
    h += height;
    ph += place * height;
  });
  return {sumOf(count), sumOf(p), sumOf(pp), sumOf(h), sumOf(ph)};
}

MEMS_STICTION_VECTORIZED void subtractCurve(const LineCurve& curve, const double* places, std::size_t size,
                                            double* line, ChangeSums& changes) {
  const LineCurve local = curve;
  ChangeLanes sums;
  forLanes(line, places, size, [&](std::size_t i, std::size_t count, const Lanes& heights, const Lanes& all_places) {
    Lanes flat;
    lessCurve(local, heights, all_places, flat);
    addChange(heights, flat, sums);
    store(flat, count, line + i);
  });
  sums.addTo(changes);
}

MEMS_STICTION_VECTORIZED void flattenLine(const LineCurve& curve, const double* places, const double* line,
                                          std::size_t size, double* flat) {
  const LineCurve local = curve;
  forLanes(line, places, size, [&](std::size_t i, std::size_t count, const Lanes& heights, const Lanes& all_places) {
    Lanes lanes;
    lessCurve(local, heights, all_places, lanes);
    store(lanes, count, flat + i);
  });
}

MEMS_STICTION_VECTORIZED void addChanges(const double* before, const double* after, std::size_t size,
                                         ChangeSums& changes) {
  ChangeLanes sums;
  LaneMask appeared{};
  forLanes(before, after, size, [&](std::size_t, std::size_t, const Lanes& old_heights, const Lanes& heights) {
    addChange(old_heights, heights, sums);
    appeared -= (old_heights == old_heights) ^ (heights == heights);
  });
  sums.changed += appeared;
  sums.addTo(changes);
}

MEMS_STICTION_VECTORIZED void distancesFrom(const LineCurve& curve, const double* places, const double* line,
                                            std::size_t size, double* distances) {
  const LineCurve local = curve;
  for (std::size_t i = 0; i < size; ++i) {
    distances[i] = std::fabs((line[i] - local.origin) - (local.a + places[i] * (local.b + local.c * places[i])));
  }
}

MEMS_STICTION_VECTORIZED void subtractTo(const double* line, double height, std::size_t size, double* difference) {
  for (std::size_t i = 0; i < size; ++i) difference[i] = line[i] - height;
}

MEMS_STICTION_VECTORIZED void subtractTo(const double* line, const double* other, std::size_t size,
                                         double* difference) {
  for (std::size_t i = 0; i < size; ++i) difference[i] = line[i] - other[i];
}

MEMS_STICTION_VECTORIZED void makeDistances(double from, double* values, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) values[i] = std::fabs(values[i] - from);
}

MEMS_STICTION_VECTORIZED LimitCount countAbove(double limit, const double* values, std::size_t size) {
  LaneMask above{};
  LaneMask invalid{};
  Lanes lanes;
  std::size_t i = 0;
  for (; i + kLanes <= size; i += kLanes) {
    load(values + i, lanes);
    above -= lanes > limit;
    invalid -= lanes != lanes;
  }
  LimitCount count{countOf(above), countOf(invalid)};
  for (; i < size; ++i) {
    count.above += values[i] > limit;
    count.invalid += std::isnan(values[i]);
  }
  return count;
}

}  // namespace mems_stiction
