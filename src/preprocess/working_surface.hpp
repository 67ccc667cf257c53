#pragma once

/// @file
/// A surface while it is cleaned: steps change its heights where they lie, and write beside them
/// into memory that stays from scan to scan.

#include <cstddef>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"
#include "numeric/median.hpp"
#include "preprocess/height_lines.hpp"
#include "preprocess/window_median.hpp"

namespace mems_stiction {

/// What steps write down beside the heights.
struct CleaningMemory {
  MedianFinder medians;
  WindowMedian windows;
  std::vector<double> places;     ///< of the columns, in the unit of the step
  std::vector<double> distances;  ///< of all pixels from what they are compared with [m]
  std::vector<double> sample;     ///< of the heights [m]
  std::vector<LineCurve> curves;  ///< what comes off each line
};

/// Room for so many values, whatever they are. Memory never shrinks, so that no step clears what
/// another one needs.
double* roomFor(std::size_t count, std::vector<double>& memory);

/// Heights in work, with the memory of the steps.
struct WorkingSurface {
  WorkingSurface() = default;
  explicit WorkingSurface(const HeightMap& surface) { take(surface); }

  /// Copies the heights of a scan. Memory that somebody else shares, such as a surface that was
  /// handed out, is left alone; otherwise it is used again. There is room for two, so that a
  /// surface may be shared until the next one is there.
  void take(const HeightMap& surface);
  /// Shares the heights.
  HeightMap surface() const { return {heights, pitch_x, pitch_y}; }

  cv::Mat heights;       ///< rows x cols CV_64FC1 [m], invalid pixels NaN
  double pitch_x = 0.0;  ///< [m]
  double pitch_y = 0.0;  ///< [m]
  cv::Mat spare;         ///< memory of the surface before
  CleaningMemory memory;
};

/// Takes the LineCurve curve_of(row) off each row, over the places in the surface's memory.
template <typename CurveOf>
HeightChange subtractCurves(WorkingSurface& surface, const CurveOf& curve_of) {
  const std::vector<double>& places = surface.memory.places;
  ChangeSums changes;
  for (int row = 0; row < surface.heights.rows; ++row) {
    subtractCurve(curve_of(row), places.data(), places.size(), surface.heights.ptr<double>(row),
                  changes);
  }
  return {changes.rms(), changes.changed,
          static_cast<long long>(surface.heights.total()) - changes.count};
}

/// 0, 1, 2 ... for every column.
const std::vector<double>& columnNumbers(int cols, CleaningMemory& memory);

/// Number, centroid and mean height of the valid pixels.
struct SurfaceMeans {
  double count = 0.0;
  double row = 0.0;
  double col = 0.0;
  double height = 0.0;  ///< [m]
};

/// Sums run about the first valid height: the mean of equal heights is that height, to the bit.
/// @throw SurfaceError if no pixel is valid, whose message ends in @p purpose.
SurfaceMeans meansOf(const cv::Mat& heights, CleaningMemory& memory, const char* purpose = "");

}  // namespace mems_stiction
