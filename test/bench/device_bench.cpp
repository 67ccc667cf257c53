/// How long does a surface of the size of a device take? A few rows of tiles of one seed, beside
/// the Fourier transform of a frame in the same run on the same core; both by pixel, so that the
/// ratio depends neither on the machine nor on the size. And from scans to the force of one surface
/// of 10^8 pixels, and to the whole answer for devices of several areas, with time and memory, in
/// processes of their own. scripts/bench makes the table of ratios from its JSON.

#include <benchmark/benchmark.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <optional>
#include <string>

#include <opencv2/core.hpp>

#include "device/device_area.hpp"
#include "device/device_surface.hpp"
#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "numeric/constants.hpp"
#include "surface/tiled_surface.hpp"

namespace mems_stiction {
namespace bench {
namespace {

constexpr double kPitch = 10e-9;
constexpr std::int64_t kSide = 100000;  // 1 mm
/// With which a process ends that came to nothing.
constexpr int kNoForce = 3;
constexpr int kError = 4;

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
  for (auto _ : state)
    benchmark::DoNotOptimize(TiledSurface(spectrum, kSide, kSide, kPitch, kPitch, 1).variance());
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

double secondsOf(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Why a process came to nothing; empty where it did its work.
std::string failureOf(int status) {
  if (WIFSIGNALED(status))
    return "the process was ended by signal " + std::to_string(WTERMSIG(status));
  const int code = WEXITSTATUS(status);
  if (code == kNoForce) return "there was no force, or the surfaces bond all over";
  return code == 0 ? "" : "the process ended with an error, which it has said";
}

/// In a process of its own, so that it has its own peak of memory.
void measureAlone(benchmark::State& state, const std::function<void()>& work) {
  for (auto _ : state) {
    const pid_t child = fork();
    if (child == 0) {
      cv::setNumThreads(1);
      try {
        work();
      } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        std::_Exit(kError);
      }
      std::_Exit(0);
    }
    int status = 0;
    rusage used{};
    if (child < 0 || wait4(child, &status, 0, &used) != child) {
      state.SkipWithError("no process could be made or waited for");
      return;
    }
    if (const std::string failure = failureOf(status); !failure.empty()) {
      state.SkipWithError(failure.c_str());
      return;
    }
    state.counters["seconds"] = secondsOf(used.ru_utime) + secondsOf(used.ru_stime);
    state.counters["gigabytes"] = static_cast<double>(used.ru_maxrss) * 1024e-9;
  }
}

DeviceSurfaces scansOfOneSurface(std::uint64_t count, int side, double pitch) {
  DeviceSurfaces surfaces;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    cv::Mat heights(side, side, CV_32FC1);
    TiledSurface(selfAffine(), side, side, pitch, pitch, seed).heights(0, 0, heights);
    surfaces.scans.push_back({"scan " + std::to_string(seed), HeightMap(heights, pitch, pitch)});
  }
  return surfaces;
}

/// What a user waits for: the force of a device with its interval.
/// - @p area [m^2]; 0: a hundredth more than the scans' own, so that it is made and not cut from
/// them
void answer(benchmark::State& state, std::uint64_t scans, int side, double area) {
  const DeviceSurfaces surfaces = scansOfOneSurface(scans, side, kPitch);
  const double asked = area > 0.0 ? area : 1.01 * side * kPitch * side * kPitch;
  measureAlone(state, [&] {
    const DeviceForce found = deviceForce(surfaces, {asked, 1}, Options(), {}, {});
    if (!(found.pull_off_force > 0.0) || found.is_conforming) std::_Exit(kNoForce);
  });
}

/// Four scans, their law, a surface of 10^8 pixels by it, its highest cells, its force.
void findForce(benchmark::State& state, double pitch) {
  constexpr int kScan = 512;
  constexpr double kPixels = 1e8;
  const DeviceSurfaces surfaces = scansOfOneSurface(4, kScan, pitch);
  measureAlone(state, [&] {
    const DevicePieces pieces = piecesOf({kPixels * pitch * pitch, 1}, pitch, kPixels);
    DeviceAreaSolver solver(Options(), kScan * kScan * pitch * pitch, pieces);
    const DeviceLaws laws = lawsOf(surfaces, {}, TailForm::kExponential);
    DeviceSurface surface(laws, pieces, 1);
    const Realisation found = solver.realise(surface);
    if (!(found.pull_off_force > 0.0) || !solver.warnings().empty()) std::_Exit(kNoForce);
  });
}

void transformWhole(benchmark::State& state) {
  constexpr int kWhole = 10000;
  measureAlone(state, [] {
    cv::Mat heights(kWhole, kWhole, CV_32FC1, cv::Scalar(1.0));
    cv::dft(heights, heights);
    benchmark::DoNotOptimize(heights.data);
  });
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
  benchmark::RegisterBenchmark("kernels/self_affine", makeKernels, round)
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("kernels/stretched", makeKernels, stretched)
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("whole/transform", transformWhole)->Iterations(1)->Repetitions(1);
  benchmark::RegisterBenchmark("whole/1 mm at 100 nm", findForce, 100e-9)
      ->Iterations(1)
      ->Repetitions(1);
  benchmark::RegisterBenchmark("whole/100 um at 10 nm", findForce, 10e-9)
      ->Iterations(1)
      ->Repetitions(1);
  benchmark::RegisterBenchmark("answer/own area, 192 x 192", answer, 1, 192, 0.0)->Iterations(1);
  benchmark::RegisterBenchmark("answer/1e-10 m^2, 4 scans of 512 x 512", answer, 4, 512, 1e-10)
      ->Iterations(1);
  benchmark::RegisterBenchmark("answer/1e-9 m^2, 4 scans of 512 x 512", answer, 4, 512, 1e-9)
      ->Iterations(1);
  benchmark::RegisterBenchmark("answer/1e-8 m^2, 4 scans of 512 x 512", answer, 4, 512, 1e-8)
      ->Iterations(1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
