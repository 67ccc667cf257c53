#include "scans_ahead.hpp"

#include <algorithm>
#include <thread>

namespace mems_stiction {

void ScansAhead::expect(std::vector<std::string> paths) {
  paths_ = std::move(paths);
  started_ = 0;
  startMore();
}

ScanAhead ScansAhead::read(const std::string& path) const {
  ScanAhead ahead;
  ahead.state = scanState(path, true, settings_file_checksum_);
  try {
    ahead.scan = openScanFile(path, scan_, options_);
  } catch (...) {
    ahead.failure = std::current_exception();
  }
  return ahead;
}

ScanAhead ScansAhead::take(const std::string& path) {
  if (reading_.empty() || reading_.front().first != path) return read(path);
  std::future<ScanAhead> next = std::move(reading_.front().second);
  reading_.pop_front();
  next.wait();
  startMore();
  return next.get();
}

void ScansAhead::startMore() {
  const std::size_t at_a_time = std::max(1u, std::thread::hardware_concurrency()) + 1;
  for (; started_ < paths_.size() && reading_.size() < at_a_time; ++started_) {
    const std::string& path = paths_[started_];
    reading_.emplace_back(path, std::async(std::launch::async, [this, &path] { return read(path); }));
  }
}

}  // namespace mems_stiction
