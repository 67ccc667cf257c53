#pragma once

/// What a program is at, in place on the terminal of the standard error, from two seconds on; gone
/// at the end.

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "errors/one_line.hpp"
#include "status_line.hpp"

namespace mems_stiction {

/// Lives as long as the work takes. Nothing else may be written to the terminal meanwhile.
class BusyLine {
 public:
  /// - @p doing as in "scan.tiff: predicting"
  explicit BusyLine(std::string doing) : doing_(std::move(doing)) {
    if (line_.onTerminal()) ticker_ = std::thread([this] { tick(); });
  }
  ~BusyLine() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_done_ = true;
    }
    done_.notify_all();
    if (ticker_.joinable()) ticker_.join();
  }
  BusyLine(const BusyLine&) = delete;
  BusyLine& operator=(const BusyLine&) = delete;

  /// What it is at now; any thread may call.
  void say(std::string doing) {
    const std::lock_guard<std::mutex> lock(mutex_);
    doing_ = std::move(doing);
  }

 private:
  void tick() {
    constexpr std::chrono::seconds kPatience{2};
    const auto begin = std::chrono::steady_clock::now();
    std::unique_lock<std::mutex> lock(mutex_);
    for (auto wait = kPatience; !done_.wait_for(lock, wait, [this] { return is_done_; });
         wait = std::chrono::seconds{1}) {
      const double seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      char time[32];
      std::snprintf(time, sizeof time, ", %.0f s", seconds);
      line_.show(oneLine(doing_) + time);
    }
  }

  std::string doing_;
  StatusLine line_;
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  std::thread ticker_;
};

/// The result of the work, with the line while it takes longer than two seconds.
template <typename Work>
auto whileSaying(const std::string& doing, Work&& work) {
  const BusyLine line(doing);
  return work();
}

/// "the force of the device, 45 %"
inline std::string deviceText(double share) {
  char text[64];
  std::snprintf(text, sizeof text, "the force of the device, %.0f %%", 100.0 * share);
  return text;
}

/// The same for work(on_progress), which finds the force of a device and reports the share that is
/// done.
/// - @p what as in "scan.tiff"
template <typename Work>
auto whileSayingShare(const std::string& what, Work&& work) {
  BusyLine line(what + ": " + deviceText(0.0));
  return work([&](double share) { line.say(what + ": " + deviceText(share)); });
}

}  // namespace mems_stiction
