#include "scans_ahead.hpp"

#include <algorithm>
#include <thread>

namespace mems_stiction {

void ScansAhead::expect(std::vector<std::string> paths) {
  paths_ = std::move(paths);
  started_ = 0;
  startMore();
}

ScanFile ScansAhead::take(const std::string& path) {
  if (reading_.empty() || reading_.front().first != path) return openScanFile(path, scan_, options_);
  std::future<ScanFile> next = std::move(reading_.front().second);
  reading_.pop_front();
  next.wait();
  startMore();
  return next.get();
}

void ScansAhead::startMore() {
  const std::size_t at_a_time = std::max(1u, std::thread::hardware_concurrency()) + 1;
  for (; started_ < paths_.size() && reading_.size() < at_a_time; ++started_) {
    const std::string& path = paths_[started_];
    reading_.emplace_back(
        path, std::async(std::launch::async, [this, &path] { return openScanFile(path, scan_, options_); }));
  }
}

}  // namespace mems_stiction
