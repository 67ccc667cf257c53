#pragma once

/// @file
/// How a caller watches and stops a long run.

#include <atomic>
#include <functional>

namespace mems_stiction {

/// How a long run tells of its progress and is stopped.
struct RunControl {
  /// Called after each unit of work with how many of how many are done; may be empty. It must not
  /// throw.
  std::function<void(int done, int total)> progress;
  /// Looked at between units of work: true ends the run, which returns what it has; may be null.
  const std::atomic<bool>* cancel = nullptr;

  void report(int done, int total) const {
    if (progress) progress(done, total);
  }
  bool isCancelled() const { return cancel != nullptr && cancel->load(); }
};

}  // namespace mems_stiction
