#pragma once

/// @file
/// A queue that calls back on as many threads as it takes: a service that waits, for the core or
/// for a transform, takes no thread from the others.

#include <cstddef>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "ros/guarded_queue.hpp"

namespace mems_stiction {

/// Whoever takes a callback sees to it that another thread is there for the next one.
class CallQueue : public GuardedQueue {
 public:
  ~CallQueue() override { stop(); }

  void start();
  /// Waits for the callbacks that run; forgets the others.
  void stop();
  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner = 0) override;

 private:
  class Counted;

  void begin();
  void end();
  void addThread();
  void loop();
  bool leaves();

  std::mutex mutex_;
  bool running_ = false;
  std::size_t idle_ = 0;  ///< threads that wait for a callback
  std::map<std::thread::id, std::thread> threads_;
  std::vector<std::thread> left_;  ///< they return at once
};

}  // namespace mems_stiction
