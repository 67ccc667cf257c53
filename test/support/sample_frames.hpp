#pragma once

/// Small frames on which sweep, loads and whole predictions are compared with the plain way: smooth
/// and white-noise roughness, equal gaps, invalid pixels, flat and rough counter-surfaces, odd
/// sides, dx != dy. Deterministic.

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "approach/gap_field.hpp"
#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {
namespace samples {

struct Frame : SurfacePair {
  Frame(std::string name_in, HeightMap lower_in, HeightMap upper_in = {})
      : SurfacePair(std::move(lower_in), std::move(upper_in)), name(std::move(name_in)) {}

  std::string name;

  GapField gapField() const;

  /// GTest names the frame in its messages.
  friend void PrintTo(const Frame& frame, std::ostream* out) { *out << frame.name; }
};

/// Gaussian heights with a Gaussian autocorrelation of length `correlation` in x and y [m].
HeightMap gaussian(int rows, int cols, double pitch_x, double pitch_y, double rms_height,
                   double correlation, int seed);

/// Independent heights, evenly spread over [0, range).
HeightMap whiteNoise(int rows, int cols, double pitch_x, double pitch_y, double range, int seed);

/// Heights rounded to whole multiples of `quantum`, so that many gaps are equal.
HeightMap quantized(const HeightMap& surface, double quantum);

/// 0 and `height` in turn.
HeightMap checkerboard(int rows, int cols, double pitch_x, double pitch_y, double height);

/// Makes every pixel invalid with the given probability: NaN, and +inf and -inf now and then.
HeightMap withHoles(const HeightMap& surface, double share, int seed);

/// All of the above, and frames of one row, one column and one pixel.
std::vector<Frame> allFrames();

}  // namespace samples
}  // namespace mems_stiction
