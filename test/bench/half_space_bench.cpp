/// How fast is the half-space? Times in pairs, one forward and one inverse real transform of the
/// frame in double precision by FFTW in the same run on the same core, so that the figures do not
/// depend on the machine.
///
///     half_space_bench [SEED [FILE.json [FRAME.f64]]]
///
/// prints one row per piece of work, with the limit that it must keep, and writes the rows to the
/// file; the exit status is 1 when one does not keep it. The heights of the frame that is pressed
/// go to the second file, row by row in doubles [m]: scripts/lib/bench_tamaas.py has it solved by
/// another program.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fftw3.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "mems_stiction/half_space/half_space_solver.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// What this process has worked, so that others on the same core do not count [s].
double worked() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Median time of one forward and one inverse real transform [s].
double pairTime(int size) {
  constexpr int kRepetitions = 41;
  const auto half = static_cast<std::size_t>(size / 2 + 1);
  std::vector<double> heights(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 1.0);
  std::vector<double> spectrum(2 * half * static_cast<std::size_t>(size));
  auto* const complex = reinterpret_cast<fftw_complex*>(spectrum.data());
  const fftw_plan forward =
      fftw_plan_dft_r2c_2d(size, size, heights.data(), complex, FFTW_ESTIMATE);
  const fftw_plan inverse =
      fftw_plan_dft_c2r_2d(size, size, complex, heights.data(), FFTW_ESTIMATE);
  std::vector<double> times;
  for (int i = 0; i < kRepetitions; ++i) {
    std::fill(heights.begin(), heights.end(), static_cast<double>(i));
    const double begin = worked();
    fftw_execute(forward);
    fftw_execute(inverse);
    times.push_back(worked() - begin);
  }
  fftw_destroy_plan(forward);
  fftw_destroy_plan(inverse);
  std::nth_element(times.begin(), times.begin() + kRepetitions / 2, times.end());
  return times[kRepetitions / 2];
}

constexpr double kPitch = 5e-9;
/// Frames over which the ratio of two sizes is taken: they have contacts of their own, one to
/// dozens.
constexpr int kFrames = 5;
/// Turns of one thread and two.
constexpr int kTurns = 5;
/// The same of a frame that is pressed.
constexpr int kPressedTurns = 3;
/// Of tamaas' time for the state at rest, at most: the whole path, and rest alone.
constexpr double kWholeOfTamaas = 1.0;
constexpr double kRestOfTamaas = 1.0 / 3.0;

HalfSpaceProblem silicon(int size, double correlation_length, double rms_height, int seed,
                         double pitch = kPitch) {
  GaussianSurfaceOptions surface;
  surface.rows = surface.cols = size;
  surface.pitch_x = surface.pitch_y = pitch;
  surface.correlation_length_x = surface.correlation_length_y = correlation_length;
  surface.rms_height = rms_height;
  surface.seed = seed;
  HalfSpaceProblem problem;
  problem.surfaces.lower = gaussianSurface(surface);
  return problem;
}

/// The same surface on every second pixel of both directions.
HalfSpaceProblem onHalfThePixels(HalfSpaceProblem problem) {
  const HeightMap& fine = problem.surfaces.lower;
  cv::Mat1d heights(fine.rows() / 2, fine.cols() / 2);
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) heights(row, col) = fine.height(2 * row, 2 * col);
  }
  problem.surfaces.lower = HeightMap(heights, 2.0 * fine.pitchX(), 2.0 * fine.pitchY());
  return problem;
}

bool sameBits(const SolvedHalfSpace& a, const SolvedHalfSpace& b) {
  return a.pull_off_force == b.pull_off_force && cv::norm(a.gap, b.gap, cv::NORM_INF) == 0.0;
}

struct Run {
  double seconds;         ///< passed
  double worked_seconds;  ///< of all threads
  double pairs;           ///< worked
  SolvedHalfSpace solution;
};

Run run(const HalfSpaceProblem& problem, const HalfSpaceOptions& options) {
  const double pair_before = pairTime(problem.surfaces.lower.rows());
  const double begin = now();
  const double begin_worked = worked();
  SolvedHalfSpace solution = HalfSpaceSolver(options).solve(problem);
  const double seconds = now() - begin;
  const double worked_seconds = worked() - begin_worked;
  const double pair = 0.5 * (pair_before + pairTime(problem.surfaces.lower.rows()));
  std::printf(
      "  %d x %d: %.2f s, %d states, %d Newton steps, %d products, %d jumps; a pair takes %.2f "
      "ms\n",
      problem.surfaces.lower.rows(), problem.surfaces.lower.cols(), worked_seconds,
      solution.state_count, solution.newton_steps, solution.products, solution.jumps, 1e3 * pair);
  return {seconds, worked_seconds, worked_seconds / pair, std::move(solution)};
}

Run run(const HalfSpaceProblem& problem, int threads) {
  HalfSpaceOptions options;
  options.threads = threads;
  return run(problem, options);
}

/// One thread and two in turns, the fastest of each: whoever else runs on this machine takes from
/// both.
class TwoThreads {
 public:
  TwoThreads(const HalfSpaceProblem& problem, HalfSpaceOptions options, const Run& one, int turns)
      : seconds_of_one_(one.seconds) {
    for (int turn = 0; turn < turns; ++turn) {
      options.threads = 2;
      const Run two = run(problem, options);
      options.threads = 1;
      seconds_of_two_ = std::min(seconds_of_two_, two.seconds);
      seconds_of_one_ = std::min(seconds_of_one_, run(problem, options).seconds);
      has_same_bits_ = has_same_bits_ && sameBits(one.solution, two.solution);
    }
  }
  double gain() const { return seconds_of_one_ / seconds_of_two_; }
  bool hasSameBits() const { return has_same_bits_; }

 private:
  double seconds_of_one_;
  double seconds_of_two_ = std::numeric_limits<double>::infinity();
  bool has_same_bits_ = true;
};

/// What frames of two sizes took in sum.
struct Sizes {
  double small = 0.0;  ///< [s]
  double large = 0.0;  ///< [s]
  int small_steps = 0;
  int large_steps = 0;
  void add(const Run& smaller, const Run& larger) {
    small += smaller.worked_seconds;
    large += larger.worked_seconds;
    small_steps += smaller.solution.newton_steps;
    large_steps += larger.solution.newton_steps;
    std::printf("    %.2f times\n", larger.worked_seconds / smaller.worked_seconds);
  }
  double ratio() const { return large / small; }
  double stepRatio() const { return static_cast<double>(large_steps) / small_steps; }
};

/// Prints a row and adds it to `rows`. @return whether it keeps its limit
bool addRow(const std::string& work, double figure, const std::string& unit, double limit,
            bool is_upper_limit, nlohmann::json& rows) {
  rows.push_back({{"work", work},
                  {"figure", figure},
                  {"unit", unit},
                  {"limit", limit},
                  {"at_least", !is_upper_limit}});
  const bool holds = is_upper_limit ? figure <= limit : figure >= limit;
  std::printf("%-62s %8.2f %-6s %s %6.1f  %s\n", work.c_str(), figure, unit.c_str(),
              is_upper_limit ? "<=" : ">=", limit, holds ? "ok" : "MISSED");
  return holds;
}

/// The same for a figure that nothing limits.
void addFigure(const std::string& work, double figure, const std::string& unit,
               nlohmann::json& rows) {
  rows.push_back({{"work", work}, {"figure", figure}, {"unit", unit}, {"limit", nullptr}});
  std::printf("%-62s %8.2f %-6s\n", work.c_str(), figure, unit.c_str());
}

/// A megapixel of which much touches.
HalfSpaceProblem pressedFrame(int seed) { return silicon(1024, 120e-9, 5e-9, seed, 10e-9); }

/// Work on the pressed frame. Nothing flows at these pressures, but what cannot flow is a steeper
/// wall on the way.
struct PressedWork {
  const char* name;
  double pressure;  ///< [Pa]
  bool attraction;
  bool flow;
  HalfSpacePath path;
};

constexpr PressedWork kPressedWork[] = {
    {"1024 x 1024 under 10 MPa, whole path", 10e6, true, true, HalfSpacePath::kWhole},
    {"1024 x 1024 under 100 MPa, whole path", 100e6, true, true, HalfSpacePath::kWhole},
    {"1024 x 1024 under 10 MPa, rest alone", 10e6, true, true, HalfSpacePath::kRest},
    {"1024 x 1024 under 100 MPa, rest alone", 100e6, true, true, HalfSpacePath::kRest},
    {"1024 x 1024 under 10 MPa, without attraction, whole path", 10e6, false, true,
     HalfSpacePath::kWhole},
    {"1024 x 1024 under 100 MPa, without attraction, whole path", 100e6, false, true,
     HalfSpacePath::kWhole},
    {"1024 x 1024 under 10 MPa, elastic, whole path", 10e6, true, false, HalfSpacePath::kWhole},
    {"1024 x 1024 under 100 MPa, elastic, whole path", 100e6, true, false, HalfSpacePath::kWhole},
    {"1024 x 1024 under 10 MPa, elastic, rest alone", 10e6, true, false, HalfSpacePath::kRest},
    {"1024 x 1024 under 100 MPa, elastic, rest alone", 100e6, true, false, HalfSpacePath::kRest},
};

/// Adds a row for each piece of work, with what bench_tamaas.py compares. @return whether two
/// threads keep their limit
bool measurePressed(int seed, nlohmann::json& rows) {
  bool holds = true;
  HalfSpaceProblem problem = pressedFrame(seed);
  const HeightMap& frame = problem.surfaces.lower;
  const double area = frame.pitchX() * frame.cols() * frame.pitchY() * frame.rows();
  HalfSpaceOptions options;
  for (const PressedWork& work : kPressedWork) {
    problem.load.setMechanicalLoad(work.pressure * area);
    options.attraction = work.attraction;
    options.flow = work.flow;
    options.path = work.path;
    const Run done = run(problem, options);
    addFigure(work.name, done.pairs, "pairs", rows);
    rows.back().update(
        {{"seconds", done.worked_seconds},
         {"pressure", work.pressure},
         {"contact_fraction", done.solution.contact_fraction},
         {"limit_of_tamaas", work.path == HalfSpacePath::kRest ? kRestOfTamaas : kWholeOfTamaas}});
    if (&work == kPressedWork) {
      const double gain = TwoThreads(problem, options, done, kPressedTurns).gain();
      holds = addRow("the same with two threads", gain, "times", 1.5, false, rows);
    }
  }
  return holds;
}

/// @return whether the file took it
bool write(const std::string& file, const char* bytes, std::size_t count) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(bytes, static_cast<std::streamsize>(count));
  stream.close();
  if (!stream) std::fprintf(stderr, "half_space_bench: cannot write '%s'\n", file.c_str());
  return static_cast<bool>(stream);
}

bool writeHeights(const HeightMap& map, const std::string& file) {
  std::vector<double> heights;
  for (int row = 0; row < map.rows(); ++row) {
    for (int col = 0; col < map.cols(); ++col) heights.push_back(map.height(row, col));
  }
  return write(file, reinterpret_cast<const char*>(heights.data()),
               heights.size() * sizeof(double));
}

int measure(int seed, const std::string& file, const std::string& heights_file) {
  nlohmann::json rows = nlohmann::json::array();
  bool holds = true;
  const auto atMost = [&](const char* work, double figure, const char* unit, double limit) {
    holds &= addRow(work, figure, unit, limit, true, rows);
  };
  const auto atLeast = [&](const char* work, double figure, const char* unit, double limit) {
    holds &= addRow(work, figure, unit, limit, false, rows);
  };
  const HalfSpaceProblem rough = silicon(512, 100e-9, 3e-9, seed);
  const Run one = run(rough, 1);
  atMost("512 x 512, l 100 nm, sigma 3 nm, whole path", one.pairs, "pairs", 500.0);
  const TwoThreads rough_by_two(rough, HalfSpaceOptions(), one, kTurns);
  atLeast("the same with two threads", rough_by_two.gain(), "times", 1.5);
  atLeast("the same bits with two threads", rough_by_two.hasSameBits() ? 1.0 : 0.0, "", 1.0);
  Sizes same_surface;
  Sizes same_pitch;
  for (int frame = seed; frame < seed + kFrames; ++frame) {
    const HalfSpaceProblem fine = silicon(1024, 100e-9, 3e-9, frame, 0.5 * kPitch);
    same_surface.add(run(onHalfThePixels(fine), 1), run(fine, 1));
    same_pitch.add(run(silicon(512, 100e-9, 3e-9, frame), 1),
                   run(silicon(1024, 100e-9, 3e-9, frame), 1));
  }
  atMost("1024 x 1024 over 512 x 512, the same surfaces, five frames", same_surface.ratio(),
         "times", 5.0);
  // other surfaces, with contacts of their own
  addFigure("1024 x 1024 over 512 x 512, four times the area, five frames", same_pitch.ratio(),
            "times", rows);
  addFigure("  Newton steps of the same", same_pitch.stepRatio(), "times", rows);
  const Run smooth = run(silicon(512, 300e-9, 1e-9, seed), 1);
  atMost("512 x 512, l 300 nm, sigma 1 nm, near bonding", smooth.pairs, "pairs", 6000.0);
  holds &= measurePressed(seed, rows);
  const std::string text = rows.dump(2) + "\n";
  if (!file.empty() && !write(file, text.data(), text.size())) return 2;
  if (!heights_file.empty() && !writeHeights(pressedFrame(seed).surfaces.lower, heights_file))
    return 2;
  return holds ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace mems_stiction

int main(int argc, char** argv) {
  return mems_stiction::measure(argc > 1 ? std::atoi(argv[1]) : 1, argc > 2 ? argv[2] : "",
                                argc > 3 ? argv[3] : "");
}
