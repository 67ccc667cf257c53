#include "mems_stiction/ros/work_queue.hpp"

#include <algorithm>
#include <chrono>

namespace mems_stiction {

void WorkQueue::start() {
  thread_ = std::thread([this] { loop(); });
}

void WorkQueue::stop() {
  std::deque<std::function<void()>> forgotten_calls;
  std::deque<Job> forgotten_jobs;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    forgotten_calls.swap(urgent_);
    forgotten_jobs.swap(jobs_);
    waiting_scans_ = 0;
  }
  changed_.notify_all();
  forgotten_calls.clear();  // whoever waits for one of them gets his error now
  if (thread_.joinable()) thread_.join();
}

void WorkQueue::pushScan(std::function<void()> run, std::function<void()> drop) {
  std::deque<Job> dropped;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopping_) return;
    jobs_.push_back({std::move(run), std::move(drop)});
    ++waiting_scans_;
    for (auto job = jobs_.begin(); capacity_ > 0 && waiting_scans_ > capacity_;) {
      if (!job->drop) {
        ++job;
        continue;
      }
      dropped.push_back(std::move(*job));
      job = jobs_.erase(job);
      --waiting_scans_;
    }
  }
  changed_.notify_one();
  for (const Job& job : dropped) job.drop();
}

void WorkQueue::push(std::function<void()> run) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopping_) return;
    jobs_.push_back({std::move(run), nullptr});
  }
  changed_.notify_one();
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
  return waiting_scans_;
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
        if (jobs_.front().drop) --waiting_scans_;
        run = std::move(jobs_.front().run);
        jobs_.pop_front();
      }
    }
    const Clock::time_point start = Clock::now();
    run();
    const Clock::duration taken = Clock::now() - start;
    calls_owe = is_call ? taken : std::max(calls_owe - taken, Clock::duration::zero());
  }
}

}  // namespace mems_stiction
