#include "mems_stiction/roughness/unresolved_waves.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// Beyond 1/2 and 1 no spectrum is continued; at 1 the sums are 0 times infinity.
constexpr double kLeastHurst = 0.5;
constexpr double kMostHurst = 0.99;
/// Share of the squares that counts, and what it has of the mean square of normal numbers.
constexpr double kCounted = 0.9;
constexpr double kMeanOfCounted = 0.62341;
/// Lines along each axis, and places on each, that are looked at.
constexpr int kLines = 64;
constexpr int kPlaces = 256;
constexpr std::size_t kFewestSquares = 16;
/// Of a wave.
constexpr int kFewestPixels = 2;

/// Mean square of the fourth differences along an axis, of the heights less those of the upper
/// surface.
/// - @p upper empty for a plane
/// - @p along_x along rows
/// - @p lag of neighbouring places [pixels]
double meanSquare(const HeightMap& lower, const HeightMap& upper, bool along_x, int lag,
                  std::vector<double>& squares) {
  const int length = along_x ? lower.cols() : lower.rows();
  const int lines = along_x ? lower.rows() : lower.cols();
  const int first = 2 * lag;
  const int count = length - 4 * lag;
  squares.clear();
  if (count < 1) return std::numeric_limits<double>::quiet_NaN();
  const int step = (count + kPlaces - 1) / kPlaces;
  const int line_step = (lines + kLines - 1) / kLines;
  for (int line = line_step / 2; line < lines; line += line_step) {
    const auto at = [&](int place) {
      const int row = along_x ? line : place;
      const int col = along_x ? place : line;
      return upper.empty() ? lower.height(row, col)
                           : lower.height(row, col) - upper.height(row, col);
    };
    for (int place = first; place < first + count; place += step) {
      const double difference = at(place - 2 * lag) + at(place + 2 * lag) -
                                4.0 * (at(place - lag) + at(place + lag)) + 6.0 * at(place);
      if (std::isfinite(difference)) squares.push_back(difference * difference);
    }
  }
  if (squares.size() < kFewestSquares) return std::numeric_limits<double>::quiet_NaN();
  const auto end =
      squares.begin() + static_cast<std::ptrdiff_t>(kCounted * static_cast<double>(squares.size()));
  std::nth_element(squares.begin(), end, squares.end());
  double sum = 0.0;
  for (auto square = squares.begin(); square != end; ++square) sum += *square;
  return sum / static_cast<double>(end - squares.begin()) / kMeanOfCounted;
}

/// D(t) over A t^(2H).
double structureFactor(double hurst) {
  const double sum = 2.0 * (56.0 - 28.0 * std::pow(4.0, hurst) + 8.0 * std::pow(9.0, hurst) -
                            std::pow(16.0, hurst));
  const double integral =
      std::tgamma(1.0 - hurst) / (std::exp2(2.0 * hurst + 1.0) * hurst * std::tgamma(1.0 + hurst));
  return integral * sum / (2.0 * kPi);
}

}  // namespace

UnresolvedWaves unresolvedWaves(const HeightMap& lower, const HeightMap& upper, double least_wave) {
  UnresolvedWaves waves;
  waves.pitch = std::max(lower.pitchX(), lower.pitchY());
  waves.shortest_shown = std::max(2.0 * waves.pitch, least_wave > 0.0 ? least_wave : 0.0);
  if (!upper.empty() && upper.heights().size() != lower.heights().size())
    return waves;  // whoever brings them together says so
  std::vector<double> squares;
  double variance = 0.0;
  double exponent = 0.0;
  for (const bool along_x : {true, false}) {
    const double step = along_x ? lower.pitchX() : lower.pitchY();
    const int most_lag = ((along_x ? lower.cols() : lower.rows()) - 1) / 8;
    if (most_lag < kFewestPixels) return waves;
    // a frame that shows no more than its tip tells by the longest waves that it has
    const int lag = std::min(static_cast<int>(std::lround(waves.shortest_shown / step)), most_lag);
    const double near = meanSquare(lower, upper, along_x, lag, squares);
    const double far = meanSquare(lower, upper, along_x, 2 * lag, squares);
    if (std::isnan(near) || std::isnan(far)) return waves;
    if (near == 0.0 || far == 0.0) {  // nothing but what was left out
      exponent += 0.5 * kMostHurst;
      continue;
    }
    const double hurst = std::clamp(0.5 * std::log2(far / near), kLeastHurst, kMostHurst);
    const double between = std::sqrt(2.0) * lag * step;
    const double amplitude =
        std::sqrt(near * far) / (structureFactor(hurst) * std::pow(between, 2.0 * hurst));
    const double least_wave_number = 2.0 * kPi / waves.shortest_shown;
    variance += 0.5 * amplitude * std::pow(least_wave_number, -2.0 * hurst) / (4.0 * kPi * hurst);
    exponent += 0.5 * hurst;
  }
  waves.rms_height = std::sqrt(variance);
  waves.hurst = exponent;
  return waves;
}

}  // namespace mems_stiction
