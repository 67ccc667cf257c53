#include "ros/work_queue.hpp"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <vector>

#include "errors/error_text.hpp"
#include "errors/one_line.hpp"
#include "ros/own_log.hpp"

namespace mems_stiction {
namespace {

/// The allocator keeps what was freed for later; worth asking back after so many bytes.
constexpr std::size_t kLargeBacklog = 64 << 20;

/// What a job throws must not end the process, nor the jobs behind it. Calls hand what they throw
/// to their callers.
void runGuarded(const std::function<void()>& run) {
  try {
    run();
  } catch (const std::exception& error) {
    logSoon(ros::console::levels::Error,
            "a job of the worker is given up: " + oneLine(reasonOf(error)));
  }
}

}  // namespace

void WorkQueue::start() {
  thread_ = std::thread([this] { loop(); });
}

void WorkQueue::stop() {
  std::deque<std::function<void()>> forgotten_calls;
  WaitingLine<Job> forgotten_jobs({});
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    forgotten_calls.swap(urgent_);
    std::swap(forgotten_jobs, jobs_);
  }
  changed_.notify_all();
  forgotten_calls.clear();  // whoever waits for one of them gets his error now
  if (thread_.joinable()) thread_.join();
}

void WorkQueue::append(Job job, LineMember member, std::size_t bytes) {
  std::vector<Job> dropped;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopping_) return;
    dropped = jobs_.push(std::move(job), member, bytes);
    most_bytes_ = std::max(most_bytes_, jobs_.bytes());
  }
  changed_.notify_one();
  for (const Job& gone : dropped) gone.drop();
}

void WorkQueue::pushScan(std::function<void()> run, std::function<void()> drop, std::size_t bytes) {
  append({std::move(run), std::move(drop)}, LineMember::kScan, bytes);
}

void WorkQueue::pushCounterSurface(std::function<void()> run, std::function<void()> drop,
                                   std::size_t bytes) {
  append({std::move(run), std::move(drop)}, LineMember::kCounterSurface, bytes);
}

void WorkQueue::push(std::function<void()> run) {
  append({std::move(run), nullptr}, LineMember::kOther, 0);
}

void WorkQueue::pushUrgent(std::function<void()> run) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopping_) return;
    urgent_.push_back(std::move(run));
  }
  changed_.notify_one();
}

std::size_t WorkQueue::waitingScans() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return jobs_.scans();
}

std::size_t WorkQueue::waitingCalls() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return urgent_.size();
}

std::size_t WorkQueue::waitingBytes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return jobs_.bytes();
}

void WorkQueue::giveMemoryBack() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (most_bytes_ < kLargeBacklog || jobs_.bytes() > 0) return;
    most_bytes_ = 0;
  }
  malloc_trim(0);
}

void WorkQueue::loop() {
  using Clock = std::chrono::steady_clock;
  Clock::duration calls_owe{0};  // the time that calls have taken from scans that waited
  for (;;) {
    std::function<void()> run;
    bool is_call = false;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return stopping_ || !urgent_.empty() || !jobs_.empty(); });
      if (stopping_) return;
      if (jobs_.empty()) calls_owe = Clock::duration::zero();
      is_call = !urgent_.empty() && calls_owe <= Clock::duration::zero();
      if (is_call) {
        run = std::move(urgent_.front());
        urgent_.pop_front();
      } else {
        run = jobs_.pop().run;
      }
    }
    const Clock::time_point start = Clock::now();
    runGuarded(run);
    run = nullptr;  // and with it the scan
    giveMemoryBack();
    const Clock::duration taken = Clock::now() - start;
    calls_owe = is_call ? taken : std::max(calls_owe - taken, Clock::duration::zero());
  }
}

}  // namespace mems_stiction
