#include "device/longer_waves.hpp"

#include <cmath>
#include <cstddef>

#include "numeric/constants.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

constexpr double kBandsPerOctave = 4.0;
/// Directions of a band.
constexpr int kWavesOfBand = 4;

MEMS_STICTION_VECTORIZED void addWave(const float* cosines, const float* sines, float of_cosine,
                                      float of_sine, std::size_t size, float* line) {
  for (std::size_t i = 0; i < size; ++i) line[i] += of_cosine * cosines[i] + of_sine * sines[i];
}

}  // namespace

LongerWaves::LongerWaves(const MergedSpectrum& spectrum, double from, double to,
                         const std::function<double(double)>& pass)
    : stretch_(spectrum.stretch) {
  if (!(from < to)) return;
  const int count = static_cast<int>(std::ceil(kBandsPerOctave * std::log2(to / from)));
  for (int i = 0; i < count; ++i) {
    const double first = from * std::pow(to / from, static_cast<double>(i) / count);
    const double last = from * std::pow(to / from, static_cast<double>(i + 1) / count);
    const double middle = std::sqrt(first * last);
    bands_.push_back(
        {middle, spectrum.rootMean(0, first, last) * std::sqrt(pass(middle) / kWavesOfBand)});
  }
  waves_.resize(kWavesOfBand * bands_.size());
}

void LongerWaves::draw(std::mt19937_64& engine) {
  std::uniform_real_distribution<double> angle(0.0, 2.0 * kPi);
  std::normal_distribution<double> normal;
  const double root = std::sqrt(stretch_.ratio);
  const double cosine = std::cos(stretch_.direction);
  const double sine = std::sin(stretch_.direction);
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    const Band& band = bands_[i / kWavesOfBand];
    const double direction = angle(engine);
    const double along = band.wave_number * std::cos(direction) / root;
    const double across = band.wave_number * std::sin(direction) * root;
    Wave& wave = waves_[i];
    wave.q_x = cosine * along - sine * across;
    wave.q_y = sine * along + cosine * across;
    wave.even = band.deviation * normal(engine);
    wave.odd = band.deviation * normal(engine);
  }
}

void LongerWaves::addTo(cv::Mat& tile, double first_x, double first_y, double pitch_x,
                        double pitch_y) {
  const auto size = static_cast<std::size_t>(tile.cols);
  cosines_.resize(size);
  sines_.resize(size);
  for (const Wave& wave : waves_) {
    for (std::size_t j = 0; j < size; ++j) {
      const double phase = wave.q_x * (first_x + static_cast<double>(j) * pitch_x);
      cosines_[j] = static_cast<float>(std::cos(phase));
      sines_[j] = static_cast<float>(std::sin(phase));
    }
    for (int i = 0; i < tile.rows; ++i) {
      const double phase = wave.q_y * (first_y + i * pitch_y);
      const double cosine = std::cos(phase);
      const double sine = std::sin(phase);
      addWave(cosines_.data(), sines_.data(),
              static_cast<float>(wave.even * cosine + wave.odd * sine),
              static_cast<float>(wave.odd * cosine - wave.even * sine), size, tile.ptr<float>(i));
    }
  }
}

}  // namespace mems_stiction
