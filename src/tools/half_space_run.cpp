#include "half_space_run.hpp"

#include <atomic>
#include <csignal>
#include <string>

#include "busy_line.hpp"
#include "errors/plain_format.hpp"
#include "import/scan_writer.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

std::atomic<bool> is_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes to it");

/// While it lives, Ctrl-C stops the solution and, when that has stopped, the program; a second one
/// does so at once.
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

void writeMap(const std::string& path, const cv::Mat& map, const SolvedHalfSpace& solution) {
  if (path.empty()) return;
  if (map.empty()) throw FileError(path + ": not written: half-space: " + solution.message);
  writeHeightTiff(path, map);
}

}  // namespace

std::string HalfSpaceText::next(const ForcePoint& point) {
  ++heights_;
  const bool is_higher = point.height > height_;
  height_ = point.height;
  return plainFormat("half-space: %s, %d heights, %.3g nm, %.3g uN",
                     is_higher && heights_ > 1 ? "retraction" : "approach", heights_,
                     1e9 * point.height, 1e6 * point.force);
}

SolvedHalfSpace withHalfSpaceProgress(
    const std::function<SolvedHalfSpace(const HalfSpaceControl&)>& solve) {
  const Interruption
      interruption;  // outlives the line on the terminal, which is gone when the program ends
  BusyLine line("half-space: the first height");
  HalfSpaceText text;
  HalfSpaceControl control;
  control.cancel = &is_interrupted;
  control.on_state = [&](const ForcePoint& point) { line.say(text.next(point)); };
  return solve(control);
}

std::vector<std::pair<std::string, std::string>> HalfSpaceMapFiles::wanted() const {
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& [option, path] :
       {std::make_pair("--half-space-pressure", pressure), std::make_pair("--half-space-gap", gap),
        std::make_pair("--half-space-deformed", deformed)}) {
    if (!path.empty()) files.emplace_back(option, path);
  }
  return files;
}

void writeMaps(const HalfSpaceMapFiles& files, const SolvedHalfSpace& solution) {
  writeMap(files.pressure, solution.pressure, solution);
  writeMap(files.gap, solution.gap, solution);
  writeMap(files.deformed, solution.deformed_lower.heights(), solution);
}

}  // namespace mems_stiction
