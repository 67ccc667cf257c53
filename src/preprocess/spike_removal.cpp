#include "preprocess/spike_removal.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "numeric/value_range.hpp"
#include "preprocess/polynomial_level.hpp"

namespace mems_stiction {
namespace {

/// Rounding of the heights and of what is computed from them [m].
double roundingOf(const ValueRange& range) {
  return 1e-9 * (range.highest - range.lowest) +
         1e-15 * std::max(std::fabs(range.highest), std::fabs(range.lowest));
}

/// Height less the median of its window, on the surface less its robust polynomial; NaN where
/// invalid.
/// @return rounding of the heights [m]
double findResiduals(WorkingSurface& surface, int half) {
  const cv::Mat& heights = surface.heights;
  CleaningMemory& memory = surface.memory;
  const PolynomialSurface fit =
      fitPolynomialBySamples(heights, surface.pitch_x, surface.pitch_y, 2, memory);
  findPlaces(fit, 0.0, surface.pitch_x, heights.cols, memory.places);
  memory.windows.setFrame(heights.rows, heights.cols, half);
  ValueRange range;
  for (int row = 0; row < heights.rows; ++row) {
    const double* line = heights.ptr<double>(row);
    addToRange(line, memory.places.size(), range);
    flattenLine(curveAt(fit, row * surface.pitch_y), memory.places.data(), line,
                memory.places.size(), memory.windows.row(row));
  }
  memory.windows.findResiduals(roomFor(heights.total(), memory.distances));
  return roundingOf(range);
}

/// The median distance; that of the distances beyond rounding where most are not.
double typicalDistance(const double* distances, std::size_t count, double rounding,
                       MedianFinder& medians) {
  const double deviation = medians.median(distances, count);
  if (deviation > rounding) return deviation;
  std::vector<double> beyond;
  std::copy_if(distances, distances + count, std::back_inserter(beyond),
               [=](double distance) { return distance > rounding; });
  // Fewer than one pixel in 50 differs from a surface that is smooth to rounding: those are the
  // spikes.
  return beyond.size() > count / 50 ? medianOf(beyond) : rounding;
}

}  // namespace

void SpikeOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.flag(prefix + "/enabled", enabled,
               "make pixels that jump out of their surroundings invalid");
  visitor.number(prefix + "/threshold", threshold, "", Range::positive(),
                 "how far a spike lies from the median of its window, in robust standard "
                 "deviations of that distance");
  visitor.integer(prefix + "/window", window, Range::within(3, 31),
                  "side of the window, in pixels");
}

HeightChange removeSpikes(WorkingSurface& surface, const SpikeOptions& options) {
  cv::Mat& heights = surface.heights;
  MedianFinder& medians = surface.memory.medians;
  const double rounding = findResiduals(surface, options.window / 2);
  double* distances = surface.memory.distances.data();
  const std::size_t count = heights.total();
  makeDistances(medians.median(distances, count), distances, count);
  const double typical = typicalDistance(distances, count, rounding, medians);
  const double limit = std::max(options.threshold * 1.4826 * typical, rounding);

  HeightChange change;
  const auto cols = static_cast<std::size_t>(heights.cols);
  for (int row = 0; row < heights.rows; ++row) {
    const double* distance = distances + static_cast<std::size_t>(row) * cols;
    const LimitCount spikes = countAbove(limit, distance, cols);
    change.changed_pixels += spikes.above;
    change.invalid_pixels += spikes.above + spikes.invalid;
    if (spikes.above == 0) continue;
    double* line = heights.ptr<double>(row);
    for (std::size_t col = 0; col < cols; ++col) {
      if (distance[col] > limit) line[col] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return change;
}

}  // namespace mems_stiction
