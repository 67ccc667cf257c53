#pragma once

/// @file
/// The one thread that owns the core. It takes scans and counter-surfaces in the order of arrival,
/// and before them calls, whose callers wait for the answer. Calls get half of the time while scans
/// wait. Everything that touches the core runs here, so nothing else needs a lock.

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

#include "ros/waiting_line.hpp"

namespace mems_stiction {

/// One thread that works off scans and calls.
class WorkQueue {
 public:
  /// @param capacity scans that may wait; 0 = any number.
  /// @param max_bytes that those scans and counter-surfaces may take together, but for the newest;
  /// 0 = any number.
  explicit WorkQueue(std::size_t capacity, std::size_t max_bytes = 0)
      : jobs_({capacity, max_bytes}) {}
  ~WorkQueue() { stop(); }
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;

  void start();
  /// Finishes the job at hand, forgets the others and joins the thread. Calls that wait get
  /// std::future_error.
  void stop();

  /// Appends a scan that takes so many bytes. When more than `capacity` or `max_bytes` wait, the
  /// oldest ones go (WaitingLine) and their `drop` is called on this thread. Once a large backlog
  /// is worked off, its memory goes back to the system.
  void pushScan(std::function<void()> run, std::function<void()> drop, std::size_t bytes = 0);
  /// The same for a counter-surface, which goes only for a newer one, once no scan stands between
  /// the two.
  void pushCounterSurface(std::function<void()> run, std::function<void()> drop, std::size_t bytes);
  /// Appends a job that is never dropped and keeps its place among the scans. What a job throws
  /// goes to the log.
  void push(std::function<void()> run);

  /// Runs `function` on the worker before the scans that wait, once these have had as much time as
  /// the call before it, and returns its result or throws what it throws.
  /// @throw std::future_error if the queue is stopped before.
  template <typename Function>
  auto call(Function function) -> decltype(function()) {
    auto task = std::make_shared<std::packaged_task<decltype(function())()>>(std::move(function));
    auto result = task->get_future();
    pushUrgent([task] { (*task)(); });
    task.reset();  // the queue has the only owner: a forgotten task breaks its promise
    return result.get();
  }

  std::size_t waitingScans() const;
  std::size_t waitingCalls() const;
  std::size_t waitingBytes() const;

 private:
  struct Job {
    std::function<void()> run;
    std::function<void()> drop;  ///< empty for jobs that are never dropped
  };

  void append(Job job, LineMember member, std::size_t bytes);
  void pushUrgent(std::function<void()> run);
  void giveMemoryBack();
  void loop();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> urgent_;
  WaitingLine<Job> jobs_;
  std::size_t most_bytes_ = 0;  ///< that waited since memory was given back
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace mems_stiction
