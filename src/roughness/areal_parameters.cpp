#include "mems_stiction/roughness/areal_parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "mems_stiction/errors/errors.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

/// Number, mean and extremes of the valid heights. The sum runs over differences from the first
/// valid height, so that a stage offset of millimetres costs no digits.
struct FirstPass {
  long long count = 0;
  double mean = 0.0;
  double min = 0.0;
  double max = 0.0;
};

template <typename Scalar>
FirstPass firstPass(const cv::Mat& heights) {
  FirstPass pass;
  double origin = 0.0;
  double sum = 0.0;
  double min = 0.0;  // numbers of their own stay in registers
  double max = 0.0;
  for (int row = 0; row < heights.rows; ++row) {
    const Scalar* line = heights.ptr<Scalar>(row);
    for (int col = 0; col < heights.cols; ++col) {
      const double height = line[col];
      if (!std::isfinite(height)) continue;
      if (pass.count == 0) origin = min = max = height;
      min = std::min(min, height);
      max = std::max(max, height);
      sum += height - origin;
      ++pass.count;
    }
  }
  if (pass.count == 0) throw SurfaceError("the height map has no valid pixel");
  pass.min = min;
  pass.max = max;
  pass.mean = origin + sum / static_cast<double>(pass.count);
  return pass;
}

/// Pixels of a row that are taken at once.
constexpr int kChunk = 256;

/// |grad z|^2 and sqrt(1 + |grad z|^2) - 1 of some pixels; 0 where a height is missing.
/// - @p rows those pixels in the row above, their own, and the one below
/// @return how many are not missing
template <typename Scalar>
MEMS_STICTION_INLINE int slopesOf(const Scalar* const* rows, int pixels, double per_x, double per_y,
                                  double* squares, double* excesses) {
  const Scalar* const above = rows[0];
  const Scalar* const line = rows[1];
  const Scalar* const below = rows[2];
  int count = 0;
  for (int col = 0; col < pixels; ++col) {
    const double slope_x =
        (static_cast<double>(line[col + 1]) - static_cast<double>(line[col - 1])) * per_x;
    const double slope_y =
        (static_cast<double>(below[col]) - static_cast<double>(above[col])) * per_y;
    const double square = slope_x * slope_x + slope_y * slope_y;
    const double height = line[col];
    // an invalid neighbour reaches the square
    const bool is_valid = square - square == 0.0 && height - height == 0.0;
    // sqrt(1 + q) - 1 without cancellation
    const double excess = square / (1.0 + std::sqrt(1.0 + square));
    squares[col] = is_valid ? square : 0.0;
    excesses[col] = is_valid ? excess : 0.0;
    count += is_valid ? 1 : 0;
  }
  return count;
}

MEMS_STICTION_VECTORIZED int slopes(const float* const* rows, int pixels, double per_x,
                                    double per_y, double* squares, double* excesses) {
  return slopesOf(rows, pixels, per_x, per_y, squares, excesses);
}
MEMS_STICTION_VECTORIZED int slopes(const double* const* rows, int pixels, double per_x,
                                    double per_y, double* squares, double* excesses) {
  return slopesOf(rows, pixels, per_x, per_y, squares, excesses);
}

/// Heights from the mean in units of the range; 0 where one is missing.
template <typename Scalar>
MEMS_STICTION_INLINE void deviationsOf(const Scalar* line, int pixels, double mean, double unit,
                                       double* deviations) {
  for (int col = 0; col < pixels; ++col) {
    const double deviation = (line[col] - mean) / unit;
    deviations[col] = deviation - deviation == 0.0 ? deviation : 0.0;
  }
}

MEMS_STICTION_VECTORIZED void deviations(const float* line, int pixels, double mean, double unit,
                                         double* deviations) {
  deviationsOf(line, pixels, mean, unit, deviations);
}
MEMS_STICTION_VECTORIZED void deviations(const double* line, int pixels, double mean, double unit,
                                         double* deviations) {
  deviationsOf(line, pixels, mean, unit, deviations);
}

/// Sums over the valid pixels, in the order of the frame.
struct SecondPass {
  double absolutes = 0.0;
  double squares = 0.0;
  double cubes = 0.0;
  double fourths = 0.0;
  long long slope_count = 0;
  double slope_squares = 0.0;  ///< sum of |grad z|^2
  double excess_area = 0.0;    ///< sum of sqrt(1 + |grad z|^2) - 1
};

void addPixels(const double* deviations, const double* squares, const double* excesses, int pixels,
               SecondPass& sums) {
  SecondPass local = sums;
  for (int i = 0; i < pixels; ++i) {
    const double square = deviations[i] * deviations[i];
    local.absolutes += std::fabs(deviations[i]);
    local.squares += square;
    local.cubes += square * deviations[i];
    local.fourths += square * square;
    local.slope_squares += squares[i];
    local.excess_area += excesses[i];
  }
  sums = local;
}

/// Powers of the deviation in units of the height range: cubes and fourths of nanometres stay far
/// from underflow.
template <typename Scalar>
SecondPass secondPass(const HeightMap& surface, double mean, double unit) {
  const cv::Mat& heights = surface.heights();
  const double per_x = 0.5 / surface.pitchX();
  const double per_y = 0.5 / surface.pitchY();
  std::array<double, kChunk> of_heights{};
  std::array<double, kChunk> of_squares{};
  std::array<double, kChunk> of_excesses{};
  SecondPass sums;
  for (int row = 0; row < heights.rows; ++row) {
    const bool has_slopes = row > 0 && row + 1 < heights.rows;
    if (!has_slopes) {
      of_squares.fill(0.0);
      of_excesses.fill(0.0);
    }
    for (int first = 0; first < heights.cols; first += kChunk) {
      const int pixels = std::min(kChunk, heights.cols - first);
      deviations(heights.ptr<Scalar>(row) + first, pixels, mean, unit, of_heights.data());
      const int begin = std::max(first, 1);
      const int count = std::min(first + pixels, heights.cols - 1) - begin;
      if (has_slopes) {
        const auto last = static_cast<std::size_t>(pixels - 1);
        of_squares[0] = of_excesses[0] = of_squares[last] = of_excesses[last] = 0.0;
        const Scalar* const rows[] = {heights.ptr<Scalar>(row - 1) + begin,
                                      heights.ptr<Scalar>(row) + begin,
                                      heights.ptr<Scalar>(row + 1) + begin};
        sums.slope_count += slopes(rows, count, per_x, per_y, of_squares.data() + (begin - first),
                                   of_excesses.data() + (begin - first));
      }
      addPixels(of_heights.data(), of_squares.data(), of_excesses.data(), pixels, sums);
    }
  }
  return sums;
}

template <typename Scalar>
ArealParameters parametersOf(const HeightMap& surface) {
  const cv::Mat& heights = surface.heights();
  const FirstPass pass = firstPass<Scalar>(heights);

  const double range = pass.max - pass.min;
  const double unit = range > 0.0 ? range : 1.0;
  const SecondPass sums = secondPass<Scalar>(surface, pass.mean, unit);

  ArealParameters parameters;
  const double count = static_cast<double>(pass.count);
  parameters.sp = pass.max - pass.mean;
  parameters.sv = pass.mean - pass.min;
  parameters.sz = range;
  if (range > 0.0) {
    const double variance = sums.squares / count;
    parameters.sa = unit * sums.absolutes / count;
    parameters.sq = unit * std::sqrt(variance);
    parameters.ssk = sums.cubes / count / (variance * std::sqrt(variance));
    parameters.sku = sums.fourths / count / (variance * variance);
  } else {
    parameters.sp = parameters.sv = 0.0;  // the mean of equal numbers can round off
  }

  if (sums.slope_count > 0) {
    const auto slope_count = static_cast<double>(sums.slope_count);
    parameters.sdq = std::sqrt(sums.slope_squares / slope_count);
    parameters.sdr = sums.excess_area / slope_count;
  }
  return parameters;
}

}  // namespace

ArealParameters arealParameters(const HeightMap& surface) {
  if (surface.empty()) throw SurfaceError("the height map is empty");
  return surface.heights().depth() == CV_32F ? parametersOf<float>(surface)
                                             : parametersOf<double>(surface);
}

}  // namespace mems_stiction
