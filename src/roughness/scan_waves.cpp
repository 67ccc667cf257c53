#include "roughness/scan_waves.hpp"

#include <algorithm>
#include <complex>
#include <vector>

#include "preprocess/level.hpp"
#include "roughness/half_spectrum.hpp"
#include "roughness/power_spectrum.hpp"

namespace mems_stiction {
namespace {

using Complex = std::complex<double>;

/// Of the table of waveTransfer(): pixels along a side, how far beyond a wave the window reaches,
/// and in which steps.
constexpr int kPixels = 64;
constexpr int kReach = 6;
constexpr double kSourceStep = 0.25;

/// Sums over the pixels of a side, of exp(2 pi i u x), for a number of waves u, each also with a
/// factor by pixel.
Complex waveSum(double waves, const std::vector<double>& factors) {
  Complex sum = 0.0;
  for (int pixel = 0; pixel < kPixels; ++pixel) {
    const double place = (pixel + 0.5) / kPixels - 0.5;
    sum += std::polar(factors[static_cast<std::size_t>(pixel)], 2.0 * kPi * waves * place);
  }
  return sum;
}

/// Shares of sources that are equally long together.
void addLengths(WaveTransfer& transfer) {
  const auto count = static_cast<int>(transfer.sources.size());
  std::vector<int> squares;  // of the lengths, in steps
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < count; ++x) {
      const int from_y = y - count / 2;
      const int from_x = x - count / 2;
      squares.push_back(from_y * from_y + from_x * from_x);
    }
  }
  std::vector<int> found = squares;
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  for (const int square : found)
    transfer.lengths.push_back(kSourceStep * std::sqrt(static_cast<double>(square)));
  transfer.round_shares =
      cv::Mat::zeros(transfer.shares.rows, static_cast<int>(found.size()), CV_64FC1);
  std::vector<std::ptrdiff_t> places;
  places.reserve(squares.size());
  for (const int square : squares) {
    places.push_back(std::lower_bound(found.begin(), found.end(), square) - found.begin());
  }
  for (int row = 0; row < transfer.shares.rows; ++row) {
    const double* from = transfer.shares.ptr<double>(row);
    double* to = transfer.round_shares.ptr<double>(row);
    for (std::size_t i = 0; i < places.size(); ++i) to[places[i]] += from[i];
  }
}

WaveTransfer makeTransfer() {
  const std::vector<double> weights = windowWeights(kPixels, SpectrumWindow::kHann);
  std::vector<double> window(kPixels);
  std::vector<double> constant(kPixels, 1.0 / std::sqrt(static_cast<double>(kPixels)));
  std::vector<double> slope(kPixels);
  double slope_square = 0.0;
  double window_square = 0.0;
  for (int pixel = 0; pixel < kPixels; ++pixel) {
    const auto place = static_cast<std::size_t>(pixel);
    window[place] = weights[place] / kPixels;
    window_square += weights[place] * weights[place] / kPixels;
    slope[place] = (pixel + 0.5) / kPixels - 0.5;
    slope_square += slope[place] * slope[place];
  }
  for (double& value : slope) value /= std::sqrt(slope_square);
  std::vector<double> windowed_constant(kPixels);
  std::vector<double> windowed_slope(kPixels);
  for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
    windowed_constant[pixel] = window[pixel] * constant[pixel];
    windowed_slope[pixel] = window[pixel] * slope[pixel];
  }

  WaveTransfer transfer;
  for (double u = -(kLongWaves + kReach); u <= kLongWaves + kReach + 0.5 * kSourceStep;
       u += kSourceStep) {
    transfer.sources.push_back(u);
  }
  const std::size_t sources = transfer.sources.size();
  // what a wave u of the surface has of the constant and of the slope that levelling takes off
  std::vector<Complex> constant_of(sources);
  std::vector<Complex> slope_of(sources);
  for (std::size_t u = 0; u < sources; ++u) {
    constant_of[u] = waveSum(transfer.sources[u], constant);
    slope_of[u] = waveSum(transfer.sources[u], slope);
  }
  constexpr std::size_t kWaves = 2 * kLongWaves + 1;
  std::vector<std::vector<Complex>> passed(kWaves, std::vector<Complex>(sources));
  std::vector<Complex> from_constant(kWaves);
  std::vector<Complex> from_slope(kWaves);
  for (std::size_t place = 0; place < kWaves; ++place) {
    const double m = static_cast<double>(place) - kLongWaves;
    from_constant[place] = waveSum(-m, windowed_constant);
    from_slope[place] = waveSum(-m, windowed_slope);
    for (std::size_t u = 0; u < sources; ++u)
      passed[place][u] = waveSum(transfer.sources[u] - m, window);
  }
  for (int y = -kLongWaves; y <= kLongWaves; ++y) {
    for (int x = 0; x <= kLongWaves; ++x) {
      const FrameWave wave{static_cast<double>(x), static_cast<double>(y)};
      if (wave.count() == 0.0 || wave.count() > kLongWaves) continue;
      transfer.waves.push_back(wave);
      transfer.weights.push_back(x == 0 ? 1.0 : 2.0);
    }
  }
  const double norm = kSourceStep * kSourceStep / (window_square * window_square);
  transfer.shares.create(static_cast<int>(transfer.waves.size()),
                         static_cast<int>(sources * sources), CV_64FC1);
  for (int row = 0; row < transfer.shares.rows; ++row) {
    const FrameWave& wave = transfer.waves[static_cast<std::size_t>(row)];
    const auto at_x = static_cast<std::size_t>(wave.x + kLongWaves);
    const auto at_y = static_cast<std::size_t>(wave.y + kLongWaves);
    double* line = transfer.shares.ptr<double>(row);
    for (std::size_t uy = 0; uy < sources; ++uy) {
      for (std::size_t ux = 0; ux < sources; ++ux) {
        const Complex arrives =
            passed[at_y][uy] * passed[at_x][ux] -
            constant_of[uy] * constant_of[ux] * from_constant[at_y] * from_constant[at_x] -
            slope_of[uy] * constant_of[ux] * from_slope[at_y] * from_constant[at_x] -
            constant_of[uy] * slope_of[ux] * from_constant[at_y] * from_slope[at_x];
        *line++ = norm * std::norm(arrives);
      }
    }
  }
  addLengths(transfer);
  return transfer;
}

}  // namespace

const WaveTransfer& waveTransfer() {
  static const WaveTransfer transfer = makeTransfer();
  return transfer;
}

ScanWaves::ScanWaves(const HeightMap& surface) : ScanWaves(filledSurface(surface)) {}

ScanWaves::ScanWaves(const FilledSurface& filled)
    : rows_(filled.surface.rows()),
      cols_(filled.surface.cols()),
      side_x_(filled.surface.cols() * filled.surface.pitchX()),
      side_y_(filled.surface.rows() * filled.surface.pitchY()) {
  cv::Mat heights;
  levelled(filled.surface).heights().convertTo(heights, CV_64F);
  const std::vector<double> weights_x = windowWeights(cols_, SpectrumWindow::kHann);
  const std::vector<double> weights_y = windowWeights(rows_, SpectrumWindow::kHann);
  double squares = 0.0;
  double largest = 0.0;
  for (int row = 0; row < rows_; ++row) {
    double* line = heights.ptr<double>(row);
    for (int col = 0; col < cols_; ++col) {
      const double weight =
          weights_y[static_cast<std::size_t>(row)] * weights_x[static_cast<std::size_t>(col)];
      squares += weight * weight;
      line[col] *= weight;
      largest = std::max(largest, std::abs(line[col]));
    }
  }
  if (largest > 0.0) heights /= largest;
  const cv::Mat transform = halfSpectrum(heights, heights.size());
  const double per_count =
      1.0 / static_cast<double>(heights.total());  // in single precision large powers stay in range
  unit_ = largest * largest * filled.surface.cellArea() / squares / per_count;
  const KnownShare known(filled.distances, weights_x, weights_y);
  const bool knows_all = known.isWhole();
  powers_.create(transform.size(), CV_32FC1);
  for (int x = 0; x < transform.rows; ++x) {
    const cv::Vec2d* line = transform.ptr<cv::Vec2d>(x);
    float* powers = powers_.ptr<float>(x);
    for (int y = 0; y < transform.cols; ++y) {
      double power = per_count * line[y].dot(line[y]);
      if (!knows_all)
        power /= known.of(std::hypot(waveNumber(x, cols_, 1.0), waveNumber(y, rows_, 1.0)));
      powers[y] = static_cast<float>(power);
    }
  }
}

}  // namespace mems_stiction
