#include "half_space_run.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/base/output_file.hpp"
#include "mems_stiction/half_space/half_space_fields.hpp"
#include "status_line.hpp"

namespace mems_stiction {
namespace {

/// How long a solution takes before it says how far it is, and between two such lines [s].
constexpr double kPatience = 2.0;
constexpr double kPeriod = 0.1;

std::atomic<bool> is_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes to it");

/// While it lives, Ctrl-C stops the solution and, when that has stopped, the program; a second one does so at once.
class Interruption {
 public:
  Interruption() {
    struct sigaction action {};
    action.sa_handler = [](int) { is_interrupted = true; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, &before_);
    if (before_.sa_handler == SIG_IGN) sigaction(SIGINT, &before_, nullptr);
    // The program's own thread for interruptions gets them only while this one does not take them.
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, SIGINT);
    pthread_sigmask(SIG_UNBLOCK, &one, &mask_before_);
  }
  ~Interruption() {
    sigaction(SIGINT, &before_, nullptr);
    if (is_interrupted) std::raise(SIGINT);
    pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
  }
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

 private:
  struct sigaction before_ {};
  sigset_t mask_before_{};
};

/// "half-space: retraction, 12 heights, 0.35 nm, 0.041 uN"
class Progress {
 public:
  void show(const ForcePoint& point) {
    const auto now = Clock::now();
    ++heights_;
    const bool is_higher = point.height > height_;
    height_ = point.height;
    if (seconds(now - begin_) < kPatience || seconds(now - shown_) < kPeriod) return;
    shown_ = now;
    char text[128];
    std::snprintf(text, sizeof text, "half-space: %s, %d heights, %.3g nm, %.3g uN",
                  is_higher ? "retraction" : "approach", heights_, 1e9 * point.height, 1e6 * point.force);
    line_.show(text);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

  StatusLine line_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point shown_{};
  double height_ = 0.0;
  int heights_ = 0;
};

}  // namespace

HalfSpaceSolution solveWithProgress(const HalfSpaceSolver& solver, const HalfSpaceProblem& problem) {
  const Interruption interruption;  // outlives the line on the terminal, which is gone when the program ends
  Progress progress;
  HalfSpaceControl control;
  control.cancel = &is_interrupted;
  control.on_state = [&progress](const ForcePoint& point) { progress.show(point); };
  return solver.solve(problem, control);
}

void writeCurve(const std::string& path, const HalfSpaceSolution& solution) {
  std::string text = "height,force,direction\n";
  for (const CurvePoint& point : curveOf(solution)) {
    text += numberText(point.height) + "," + numberText(point.force) + "," + word(point.direction) + "\n";
  }
  writeFile(path, text);
}

}  // namespace mems_stiction
