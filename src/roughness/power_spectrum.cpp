#include "roughness/power_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/constants.hpp"
#include "numeric/value_range.hpp"
#include "preprocess/working_surface.hpp"
#include "roughness/filled_surface.hpp"
#include "roughness/half_spectrum.hpp"

namespace mems_stiction {
namespace {

/// Heights about their weighted mean times the window, in units of `unit`.
struct Weighted {
  cv::Mat heights;
  KnownShare known;
  double unit = 1.0;             ///< [m]
  double squared_weights = 0.0;  ///< sum over the frame
};

Weighted weightedHeights(const FilledSurface& filled, SpectrumWindow window) {
  const HeightMap& surface = filled.surface;
  WorkingSurface work(surface);
  cv::Mat& heights = work.heights;
  const double mean = meansOf(heights, work.memory).height;
  const std::vector<double> window_x = windowWeights(surface.cols(), window);
  const std::vector<double> window_y = windowWeights(surface.rows(), window);
  Weighted weighted{{}, KnownShare(filled.distances, window_x, window_y)};
  ValueRange range;
  double sum = 0.0;
  double products = 0.0;
  for (int row = 0; row < heights.rows; ++row) {
    const double* line = heights.ptr<double>(row);
    const double weight = window_y[static_cast<std::size_t>(row)];
    addToRange(line, window_x.size(), range);
    const LineSums sums = sumsOf(line, window_x.data(), window_x.size(), mean);
    sum += weight * sums.p;
    products += weight * sums.ph;
    weighted.squared_weights += weight * weight * sums.pp;
  }
  const bool is_flat = range.highest == range.lowest;  // the mean of equal numbers can round off
  weighted.unit = is_flat ? 1.0 : range.highest - range.lowest;
  const double weighted_mean = mean + products / sum;
  for (int row = 0; row < heights.rows; ++row) {
    double* line = heights.ptr<double>(row);
    const double weight = is_flat ? 0.0 : window_y[static_cast<std::size_t>(row)] / weighted.unit;
    for (std::size_t col = 0; col < window_x.size(); ++col) {
      line[col] = (line[col] - weighted_mean) * (weight * window_x[col]);
    }
  }
  weighted.heights = heights;
  return weighted;
}

}  // namespace

std::vector<double> windowWeights(int count, SpectrumWindow window) {
  std::vector<double> weights(static_cast<std::size_t>(count), 1.0);
  if (window == SpectrumWindow::kNone) return weights;
  for (int index = 0; index < count; ++index) {
    const double sine = std::sin(kPi * (index + 0.5) / count);
    weights[static_cast<std::size_t>(index)] = sine * sine;
  }
  return weights;
}

PowerSpectrum powerSpectrum(const HeightMap& measured, SpectrumWindow window) {
  const FilledSurface filled = filledSurface(measured);
  const HeightMap& surface = filled.surface;
  const int rows = surface.rows();
  const int cols = surface.cols();
  if (rows < 2 || cols < 2) {
    throw SurfaceError("a spectrum needs at least 2 x 2 pixels, got " + std::to_string(cols) +
                       " x " + std::to_string(rows));
  }
  const Weighted weighted = weightedHeights(filled, window);
  const cv::Mat transform = halfSpectrum(weighted.heights, weighted.heights.size());

  // C = |F dx dy|^2/(dx dy sum of w^2); integral d^2q/(2 pi)^2 = sum over wave vectors/(N dx dy)
  const double density =
      weighted.unit * weighted.unit * surface.cellArea() / weighted.squared_weights;
  const double per_mode =
      1.0 / (static_cast<double>(surface.heights().total()) * surface.cellArea());
  const double width = 2.0 * kPi / std::max(cols * surface.pitchX(), rows * surface.pitchY());
  const double nyquist = kPi / std::max(surface.pitchX(), surface.pitchY());
  std::vector<SpectrumRing> rings(static_cast<std::size_t>(nyquist / width + 1.5));

  // Powers of q in units of the ring width: fourth powers of 1e10 stay in range.
  double zeroth = 0.0;
  double second = 0.0;
  double fourth = 0.0;
  const bool knows_all = weighted.known.isWhole();
  for (int col = 0; col < transform.rows; ++col) {
    const cv::Vec2d* line = transform.ptr<cv::Vec2d>(col);
    const double q_x = waveNumber(col, cols, surface.pitchX()) / width;
    const int twins = col > 0 && 2 * col < cols ? 2 : 1;  // this one and its mirror image
    for (int row = 0; row < rows; ++row) {
      if (row == 0 && col == 0) continue;
      const double q_y = waveNumber(row, rows, surface.pitchY()) / width;
      const double square = q_x * q_x + q_y * q_y;
      const double q = std::sqrt(square);
      double power = twins * density * line[row].dot(line[row]);
      if (!knows_all) {
        power /=
            weighted.known.of(std::hypot(waveNumber(col, cols, 1.0), waveNumber(row, rows, 1.0)));
      }
      zeroth += power;
      second += power * square;
      fourth += power * square * square;
      const auto ring = static_cast<std::size_t>(std::lround(q));
      if (q > nyquist / width * (1.0 + 1e-12) || ring >= rings.size()) continue;
      rings[ring].wave_number += twins * q * width;
      rings[ring].density += power;
      rings[ring].count += twins;
    }
  }

  PowerSpectrum spectrum;
  SpectralMoments& moments = spectrum.moments;
  moments.m0 = zeroth * per_mode;
  moments.m2 = 0.5 * second * per_mode * width * width;
  moments.m4 = 0.375 * fourth * per_mode * std::pow(width, 4);
  if (second > 0.0) moments.alpha = 1.5 * (zeroth / second) * (fourth / second);
  for (SpectrumRing& ring : rings) {
    if (ring.count == 0) continue;
    ring.wave_number /= ring.count;
    ring.density /= ring.count;
    spectrum.rings.push_back(ring);
  }
  return spectrum;
}

HurstFit fitHurstExponent(const PowerSpectrum& spectrum, double shortest_wavelength,
                          double longest_wavelength) {
  if (!Range::positive().contains(shortest_wavelength) ||
      !Range::positive().contains(longest_wavelength) ||
      shortest_wavelength >= longest_wavelength) {
    throw OptionsError({"wavelengths: " + numberText(shortest_wavelength) + " to " +
                        numberText(longest_wavelength) +
                        " m is not allowed, must be 0 < shortest < longest"});
  }
  double weight_sum = 0.0;
  double mean_x = 0.0;
  double mean_y = 0.0;
  std::vector<const SpectrumRing*> inside;
  for (const SpectrumRing& ring : spectrum.rings) {
    const double wavelength = 2.0 * kPi / ring.wave_number;
    if (wavelength < shortest_wavelength || wavelength > longest_wavelength ||
        !(ring.density > 0.0))
      continue;
    inside.push_back(&ring);
    weight_sum += ring.count;
    mean_x += ring.count * std::log(ring.wave_number);
    mean_y += ring.count * std::log(ring.density);
  }
  if (inside.size() < 3) {
    std::string range = "the spectrum is empty";
    if (!spectrum.rings.empty()) {
      range = "the spectrum has wavelengths of " +
              numberText(2.0 * kPi / spectrum.rings.back().wave_number) + " to " +
              numberText(2.0 * kPi / spectrum.rings.front().wave_number) + " m";
    }
    throw SurfaceError("a Hurst exponent needs at least 3 rings between " +
                       numberText(shortest_wavelength) + " and " + numberText(longest_wavelength) +
                       " m, found " + std::to_string(inside.size()) + "; " + range);
  }
  mean_x /= weight_sum;
  mean_y /= weight_sum;
  double variance = 0.0;
  double covariance = 0.0;
  for (const SpectrumRing* ring : inside) {
    const double x = std::log(ring->wave_number) - mean_x;
    variance += ring->count * x * x;
    covariance += ring->count * x * (std::log(ring->density) - mean_y);
  }
  const double slope = covariance / variance;
  HurstFit fit;
  fit.rings = static_cast<int>(inside.size());
  fit.hurst_exponent = -0.5 * slope - 1.0;
  return fit;
}

}  // namespace mems_stiction
