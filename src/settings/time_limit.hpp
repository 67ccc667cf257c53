#pragma once

/// @file
/// How does a prediction end that takes longer than whoever waits for it can wait?
///
/// Whoever waits says how long; what takes long asks between its steps whether the time is over.
/// Both do so on the same thread, and nothing between them needs to know.
///
///     const TimeLimit limit(60.0, "limits/max_time");  // until the end of the block
///     // anywhere below, once in a millisecond or so
///     for (...) TimeLimit::check();

#include <chrono>
#include <functional>

#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {

/// A scan was given up since its time was over.
class TimeLimitError : public SurfaceError {
 public:
  using SurfaceError::SurfaceError;
};

/// The time that this thread may work, as long as the object lives. An inner limit never lengthens
/// an outer one.
class TimeLimit {
 public:
  /// - @p seconds in all; infinity = no limit
  /// - @p setting what the user may change, for the message; must outlive the object
  /// - @p spent of them before now [s]
  TimeLimit(double seconds, const char* setting, double spent = 0.0);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;

  /// Does what this thread does beside (BesideWork), too.
  /// @throw TimeLimitError if the innermost limit of this thread is over. Takes some 30 ns.
  static void check();

 private:
  using Clock = std::chrono::steady_clock;

  TimeLimit* outer_;
  Clock::time_point end_;
  double seconds_;
  const char* setting_;
};

/// What this thread does beside, wherever something long asks for its time: it gives way to others,
/// or throws since it is to end.
///
///     // until the end of the block
///     const BesideWork beside([&] { if (stopping) throw Stopped(); });
class BesideWork {
 public:
  explicit BesideWork(std::function<void()> work);
  ~BesideWork();
  BesideWork(const BesideWork&) = delete;
  BesideWork& operator=(const BesideWork&) = delete;

 private:
  friend class TimeLimit;

  BesideWork* outer_;
  std::function<void()> work_;
};

}  // namespace mems_stiction
