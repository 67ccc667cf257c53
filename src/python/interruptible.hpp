#pragma once

/// @file
/// Work that takes long, for a caller who may press Ctrl-C.

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>

#include "without_lock.hpp"

namespace mems_stiction {
namespace python {

/// Ends work that reports its progress, when it is asked to.
class Cancellation {
 public:
  /// What it ends with; nobody sees it, since the interruption goes on in its place.
  struct Cancelled {};

  explicit Cancellation(const std::atomic<bool>& cancel) : cancel_(cancel) {}

  void operator()(double /*share*/) const {
    if (cancel_) throw Cancelled();  // NOLINT(hicpp-exception-baseclass): no error
  }

 private:
  const std::atomic<bool>& cancel_;
};

/// Runs work(cancel) on a thread of its own, without the interpreter's lock. The calling thread
/// asks now and then whether a signal has come; a handler that raises (KeyboardInterrupt) sets
/// `cancel`, and its exception goes on when the work has ended.
/// @return what the work returns
template <typename Work>
auto interruptible(const Work& work) {
  constexpr std::chrono::milliseconds kPatience(20);
  std::atomic<bool> cancel{false};
  auto result = std::async(std::launch::async, [&work, &cancel] { return work(cancel); });
  const auto isReadyWithin = [&result](std::chrono::milliseconds time) {
    const WithoutLock unlocked;
    return result.wait_for(time) == std::future_status::ready;
  };
  while (!isReadyWithin(kPatience)) {
    if (PyErr_CheckSignals() == 0) continue;
    cancel = true;
    pybind11::error_already_set interruption;
    {
      const WithoutLock waiting;
      result.wait();
    }
    throw interruption;  // NOLINT(cert-err60-cpp): pybind11's own
  }
  return result.get();
}

}  // namespace python
}  // namespace mems_stiction
