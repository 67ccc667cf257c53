#include "ros/call_queue.hpp"

#include <chrono>
#include <system_error>
#include <utility>

#include <boost/make_shared.hpp>

namespace mems_stiction {
namespace {

/// That a thread waits before it leaves, when another one waits too.
const ros::WallDuration kIdle(2.0);
/// Until a callback that is not ready may be.
constexpr std::chrono::milliseconds kNotReady{1};

}  // namespace

/// A callback that tells when it runs.
class CallQueue::Counted : public ros::CallbackInterface {
 public:
  Counted(CallQueue& queue, ros::CallbackInterfacePtr callback)
      : queue_(queue), callback_(std::move(callback)) {}

  CallResult call() override {
    struct Running {
      CallQueue& queue;
      explicit Running(CallQueue& called) : queue(called) { queue.begin(); }
      ~Running() { queue.end(); }
    };
    const Running running(queue_);
    return callback_->call();
  }
  bool ready() override { return callback_->ready(); }

 private:
  CallQueue& queue_;
  ros::CallbackInterfacePtr callback_;
};

void CallQueue::start() {
  const std::lock_guard<std::mutex> lock(mutex_);
  running_ = true;
  addThread();
}

void CallQueue::stop() {
  std::map<std::thread::id, std::thread> threads;
  std::vector<std::thread> left;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    running_ = false;
    threads.swap(threads_);
    left.swap(left_);
  }
  disable();
  clear();
  for (auto& [id, thread] : threads) thread.join();
  for (std::thread& thread : left) thread.join();
}

void CallQueue::addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) {
  GuardedQueue::addCallback(boost::make_shared<Counted>(*this, callback), owner);
}

void CallQueue::begin() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (--idle_ == 0 && running_) addThread();
}

void CallQueue::end() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++idle_;
}

/// With the mutex held.
void CallQueue::addThread() {
  for (std::thread& thread : left_) thread.join();
  left_.clear();
  try {
    std::thread thread([this] { loop(); });
    const std::thread::id id = thread.get_id();
    threads_.emplace(id, std::move(thread));
    ++idle_;
  } catch (const std::system_error&) {
    if (threads_.empty()) throw;
    // No more threads are to be had: who waits is called once one of them is done.
  }
}

void CallQueue::loop() {
  for (;;) {
    switch (callOne(kIdle)) {
      case Disabled:
        return;
      case Empty:
        if (leaves()) return;
        break;
      case TryAgain:
        std::this_thread::sleep_for(kNotReady);
        break;
      case Called:
        break;
    }
  }
}

/// Whether this thread is one too many.
bool CallQueue::leaves() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!running_ || idle_ <= 1) return false;
  --idle_;
  const auto self = threads_.find(std::this_thread::get_id());
  left_.push_back(std::move(self->second));
  threads_.erase(self);
  return true;
}

}  // namespace mems_stiction
