#pragma once

/// @file
/// A queue whose callbacks cannot end the process: what one throws is said, and the next one is
/// called.
///
/// Nothing of this package throws there. Libraries do that act on what peers send, such as stamps
/// whose sums are beyond 32 bits (tf2, actionlib); the threads that call would end the process, or
/// the manager of nodelets and all that it runs.

#include <atomic>
#include <chrono>
#include <exception>
#include <string>
#include <utility>

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <boost/make_shared.hpp>

#include "ros/own_log.hpp"

namespace mems_stiction {

/// Calls each callback, and says what it throws.
class GuardedQueue : public ros::CallbackQueue {
 public:
  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner = 0) override {
    ros::CallbackQueue::addCallback(boost::make_shared<Guarded>(callback), owner);
  }

 private:
  class Guarded : public ros::CallbackInterface {
   public:
    explicit Guarded(ros::CallbackInterfacePtr callback) : callback_(std::move(callback)) {}

    CallResult call() override {
      try {
        return callback_->call();
      } catch (const std::exception& error) {
        say(error.what());
        return Invalid;
      }
    }
    bool ready() override { return callback_->ready(); }

   private:
    /// Not more often than once in so long a time.
    static void say(const std::string& what) {
      constexpr std::chrono::seconds kPause{5};
      static std::atomic<std::chrono::steady_clock::time_point> next{
          std::chrono::steady_clock::time_point::min()};
      const auto now = std::chrono::steady_clock::now();
      if (now < next.load()) return;
      next = now + kPause;
      logSoon(ros::console::levels::Error, "a message or call of a peer is passed over: " + what);
    }

    ros::CallbackInterfacePtr callback_;
  };
};

/// The handle, whose callbacks this queue calls.
inline ros::NodeHandle withQueue(ros::NodeHandle handle, ros::CallbackQueue& queue) {
  handle.setCallbackQueue(&queue);
  return handle;
}

}  // namespace mems_stiction
