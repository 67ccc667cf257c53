#include "device/made_surface.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "roughness/half_spectrum.hpp"
#include "surface/random_field.hpp"

namespace mems_stiction {

HeightMap madeSurface(const MergedSpectrum& spectrum, int rows, int cols, double pitch, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<double> logs_q;
  std::vector<double> logs_c;
  for (const SpectrumBand& band : spectrum.bands) {
    std::gamma_distribution<double> gamma(band.freedom, 1.0 / band.freedom);
    logs_q.push_back(std::log(band.wave_number));
    logs_c.push_back(std::log(band.density * std::max(gamma(engine), 1e-3)));
  }
  const auto density = [&](double q) {
    const double x = std::log(q);
    if (x <= logs_q.front()) return std::exp(logs_c.front());
    if (x >= logs_q.back()) return 0.0;
    const auto next = static_cast<std::size_t>(std::upper_bound(logs_q.begin(), logs_q.end(), x) - logs_q.begin());
    const double share = (x - logs_q[next - 1]) / (logs_q[next] - logs_q[next - 1]);
    return std::exp(logs_c[next - 1] + share * (logs_c[next] - logs_c[next - 1]));
  };
  const double cell_area = pitch * pitch;
  cv::Mat heights = filteredNoise(whiteNoise(rows, cols, static_cast<int>(seed & 0x7fffffff)), [&](int row, int col) {
    if (row == 0 && col == 0) return 0.0;
    const double q = std::hypot(waveNumber(col, cols, pitch), waveNumber(row, rows, pitch));
    return std::sqrt(density(q) / cell_area);
  });
  return HeightMap(heights, pitch, pitch);
}

}  // namespace mems_stiction
