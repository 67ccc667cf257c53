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
  MergedSpectrum drawn = spectrum;
  for (SpectrumBand& band : drawn.bands) {
    std::gamma_distribution<double> gamma(0.5 * band.freedom, 2.0 / band.freedom);
    band.density *= std::max(gamma(engine), 1e-3);
  }
  const double cell_area = pitch * pitch;
  cv::Mat heights = filteredNoise(whiteNoise(rows, cols, static_cast<int>(seed & 0x7fffffff)), [&](int row, int col) {
    if (row == 0 && col == 0) return 0.0;
    const double q = drawn.stretch.roundWave(waveNumber(col, cols, pitch), waveNumber(row, rows, pitch));
    return std::sqrt(drawn.densityAt(q) / cell_area);
  });
  return HeightMap(heights, pitch, pitch);
}

}  // namespace mems_stiction
