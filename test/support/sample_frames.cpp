#include "support/sample_frames.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "support/analytic_surfaces.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace samples {
namespace {

/// In [0, 1); the standard fixes the generator's output, but not the distributions'.
double evenly(std::mt19937& generator) { return generator() / 4294967296.0; }

}  // namespace

GapField Frame::gapField() const {
  GapField field;
  if (upper.empty()) {
    field.compute(lower);
  } else {
    field.compute({lower, upper});
  }
  return field;
}

HeightMap gaussian(int rows, int cols, double pitch_x, double pitch_y, double rms_height,
                   double correlation, int seed) {
  GaussianSurfaceOptions options;
  options.rows = rows;
  options.cols = cols;
  options.pitch_x = pitch_x;
  options.pitch_y = pitch_y;
  options.rms_height = rms_height;
  options.correlation_length_x = options.correlation_length_y = correlation;
  options.seed = seed;
  return gaussianSurface(options);
}

HeightMap whiteNoise(int rows, int cols, double pitch_x, double pitch_y, double range, int seed) {
  std::mt19937 generator(static_cast<unsigned>(seed));
  cv::Mat1d heights(rows, cols);
  for (double& height : heights) height = range * evenly(generator);
  return {heights, pitch_x, pitch_y};
}

HeightMap quantized(const HeightMap& surface, double quantum) {
  cv::Mat1d heights = surface.asDouble().heights().clone();
  for (double& height : heights) height = std::round(height / quantum) * quantum;
  return {heights, surface.pitchX(), surface.pitchY()};
}

HeightMap checkerboard(int rows, int cols, double pitch_x, double pitch_y, double height) {
  cv::Mat1d heights(rows, cols);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) heights(row, col) = (row + col) % 2 == 0 ? height : 0.0;
  }
  return {heights, pitch_x, pitch_y};
}

HeightMap withHoles(const HeightMap& surface, double share, int seed) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::mt19937 generator(static_cast<unsigned>(seed));
  cv::Mat1d heights = surface.asDouble().heights().clone();
  for (double& height : heights) {
    const double chance = evenly(generator) / share;
    if (chance < 1.0) height = chance < 0.8 ? kNan : (chance < 0.9 ? kInfinity : -kInfinity);
  }
  return {heights, surface.pitchX(), surface.pitchY()};
}

std::vector<Frame> allFrames() {
  const double nm = 1e-9;
  const HeightMap smooth = gaussian(64, 64, 10 * nm, 10 * nm, 3 * nm, 50 * nm, 1);
  const HeightMap odd = gaussian(61, 61, 10 * nm, 15 * nm, 5 * nm, 60 * nm, 2);
  const HeightMap wide = gaussian(40, 77, 12 * nm, 7 * nm, 2 * nm, 40 * nm, 3);
  const HeightMap wide_upper = gaussian(40, 77, 12 * nm, 7 * nm, 4 * nm, 70 * nm, 4);
  return {
      {"smooth_square", smooth, {}},
      {"smooth_odd", odd, {}},
      {"smooth_wide_on_rough", wide, wide_upper},
      {"white_noise", whiteNoise(47, 53, 9 * nm, 9 * nm, 10 * nm, 5), {}},
      {"equal_gaps", quantized(smooth, 1.0 * nm), {}},
      {"equal_gaps_on_rough", quantized(wide, 1.0 * nm), quantized(wide_upper, 1.0 * nm)},
      {"plane", analytic::flat(20, 30, 10 * nm, 10 * nm, 5 * nm), {}},
      {"tilted_plane", analytic::tiltedPlane(31, 20, 10 * nm, 8 * nm, 0.02, -0.03), {}},
      {"checkerboard", checkerboard(24, 25, 10 * nm, 10 * nm, 2 * nm), {}},
      {"holes", withHoles(odd, 0.1, 6), {}},
      {"holes_in_both", withHoles(wide, 0.05, 7), withHoles(wide_upper, 0.05, 8)},
      {"many_holes", withHoles(smooth, 0.6, 9), {}},
      {"one_row", whiteNoise(1, 40, 10 * nm, 10 * nm, 5 * nm, 10), {}},
      {"one_column", whiteNoise(40, 1, 10 * nm, 20 * nm, 5 * nm, 11), {}},
      {"one_pixel", analytic::flat(1, 1, 10 * nm, 10 * nm, 1 * nm), {}},
  };
}

}  // namespace samples
}  // namespace mems_stiction
