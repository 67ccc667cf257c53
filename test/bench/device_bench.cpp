/// How long does a surface of the size of a device take? A few rows of tiles of one seed, beside the Fourier transform of a frame in
/// the same run on the same core; both by pixel, so that the ratio depends neither on the machine nor on the size.
/// scripts/bench makes the table of ratios from its JSON.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include <opencv2/core.hpp>

#include "numeric/constants.hpp"
#include "surface/tiled_surface.hpp"

namespace mems_stiction {
namespace bench {
namespace {

constexpr double kPitch = 10e-9;
constexpr std::int64_t kSide = 100000;  // 1 mm

/// C ~ q^-3.6 from waves of 20 um to those of two pixels.
SurfaceSpectrum selfAffine() {
  SurfaceSpectrum spectrum;
  spectrum.wave_number = {2.0 * kPi / 20e-6, 2.0 * kPi / (2.0 * kPitch)};
  spectrum.density = {1e-27, 1e-27 * std::pow(1000.0, -3.6)};
  return spectrum;
}

/// One tile after the other, each a new one. Making the kernels is not in it.
void makeTiles(benchmark::State& state, const SurfaceSpectrum& spectrum,
               const std::optional<HeightTranslation>& translation) {
  TiledSurface surface(spectrum, kSide, kSide, kPitch, kPitch, 1, translation);
  cv::Mat tile(surface.tile(), CV_32FC1);
  const std::int64_t cols = kSide / tile.cols;
  std::int64_t number = 0;
  for (auto _ : state) {
    surface.heights(number / cols * tile.rows, number % cols * tile.cols, tile);
    benchmark::DoNotOptimize(tile.data);
    ++number;
  }
  state.counters["pixels"] = static_cast<double>(tile.total());
}

void makeKernels(benchmark::State& state, const SurfaceSpectrum& spectrum) {
  for (auto _ : state) benchmark::DoNotOptimize(TiledSurface(spectrum, kSide, kSide, kPitch, kPitch, 1).variance());
}

void transform(benchmark::State& state) {
  cv::setNumThreads(1);
  cv::Mat heights(1024, 1024, CV_32FC1);
  cv::randn(heights, 0.0, 1.0);
  cv::Mat waves;
  for (auto _ : state) {
    cv::dft(heights, waves);
    benchmark::DoNotOptimize(waves.data);
  }
  state.counters["pixels"] = static_cast<double>(heights.total());
}

}  // namespace
}  // namespace bench
}  // namespace mems_stiction

int main(int argc, char** argv) {
  using namespace mems_stiction;
  using namespace mems_stiction::bench;
  const SurfaceSpectrum round = selfAffine();
  SurfaceSpectrum stretched = round;
  stretched.stretch = 3.0;
  stretched.direction = 0.5;
  const HeightTranslation skewed([](double g) { return 1e-9 * std::exp(0.2 * g); });
  benchmark::RegisterBenchmark("transform", transform)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("tiles/self_affine", makeTiles, round, std::nullopt)
      ->Unit(benchmark::kMillisecond)
      ->MinTime(2.0);
  benchmark::RegisterBenchmark("tiles/translated", makeTiles, round, skewed)
      ->Unit(benchmark::kMillisecond)
      ->MinTime(2.0);
  benchmark::RegisterBenchmark("tiles/stretched", makeTiles, stretched, std::nullopt)
      ->Unit(benchmark::kMillisecond)
      ->MinTime(2.0);
  benchmark::RegisterBenchmark("kernels/self_affine", makeKernels, round)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("kernels/stretched", makeKernels, stretched)->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
