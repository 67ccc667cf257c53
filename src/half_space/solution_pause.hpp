#pragma once

/// @file
/// How does a solution wait while something more urgent is computed, without being starved?
///
/// Whoever does urgent work requests the pause meanwhile; solutions ask between their products and
/// sleep until it is let go. A wait lasts at most a second, and at most nine times as long as the
/// work since the last one. So a solution keeps a tenth of the time even where urgent work never
/// ends. It wakes up when it is cancelled.
///
///     SolutionPause pause;
///     control.give_way = pause.waiter(cancel);              // the solving thread
///     const SolutionPause::Request request(pause);                // any other thread

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>

namespace mems_stiction {

/// Between those who work urgently and the solutions that give way to them; for any number of
/// threads. It must outlive its requests and waiters.
class SolutionPause {
 public:
  /// Longest wait at once, over the work since the last one.
  static constexpr int kMostPatience = 9;
  static constexpr std::chrono::seconds kLongestWait{1};
  /// A waiter looks at its cancel at least this often.
  static constexpr std::chrono::milliseconds kCancelPeriod{50};

  /// Solutions wait while it lives.
  class Request {
   public:
    explicit Request(SolutionPause& pause);
    ~Request();
    Request(const Request&) = delete;
    Request& operator=(const Request&) = delete;

   private:
    SolutionPause& pause_;
  };

  /// What a solution calls between its products, for HalfSpaceControl::give_way; each solution
  /// needs its own.
  /// @param cancel must outlive the waiter
  std::function<void()> waiter(const std::atomic<bool>& cancel);

 private:
  using Clock = std::chrono::steady_clock;
  /// @return whether there was anything to wait for
  bool wait(Clock::duration longest, const std::atomic<bool>& cancel);

  std::mutex mutex_;
  std::condition_variable released_;
  int requests_ = 0;
};

}  // namespace mems_stiction
