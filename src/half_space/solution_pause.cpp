#include "half_space/solution_pause.hpp"

#include <algorithm>

namespace mems_stiction {

SolutionPause::Request::Request(SolutionPause& pause) : pause_(pause) {
  const std::lock_guard<std::mutex> lock(pause_.mutex_);
  ++pause_.requests_;
}

SolutionPause::Request::~Request() {
  // told under the lock: a waiter that has seen the end may destroy the pause
  const std::lock_guard<std::mutex> lock(pause_.mutex_);
  if (--pause_.requests_ == 0) pause_.released_.notify_all();
}

std::function<void()> SolutionPause::waiter(const std::atomic<bool>& cancel) {
  return [this, &cancel, resumed = Clock::now()]() mutable {
    const Clock::duration patience = kMostPatience * (Clock::now() - resumed);
    if (wait(std::min<Clock::duration>(patience, kLongestWait), cancel)) resumed = Clock::now();
  };
}

bool SolutionPause::wait(Clock::duration longest, const std::atomic<bool>& cancel) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (requests_ == 0) return false;
  const Clock::time_point until = Clock::now() + longest;
  while (requests_ > 0 && !cancel && Clock::now() < until) {
    released_.wait_until(lock, std::min(until, Clock::now() + kCancelPeriod));
  }
  return true;
}

}  // namespace mems_stiction
