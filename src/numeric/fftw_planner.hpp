#pragma once

/// @file
/// FFTW's planner is not to be called by two threads at once.

#include <mutex>

namespace mems_stiction {

/// Held by whoever makes or destroys a plan.
inline std::mutex& plannerMutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace mems_stiction
