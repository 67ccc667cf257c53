#include "scans_ahead.hpp"

#include <algorithm>
#include <thread>

#include "own_thread.hpp"

namespace mems_stiction {

ScansAhead::ScansAhead(const ScanOptions& scan, const ScanFileOptions& options,
                       std::optional<std::string> settings_file_checksum, unsigned takers)
    : scan_(scan),
      options_(options),
      settings_file_checksum_(std::move(settings_file_checksum)),
      at_a_time_(std::max({1u, std::thread::hardware_concurrency(), takers}) + 1) {}

void ScansAhead::expect(std::vector<std::string> paths) {
  paths_ = std::move(paths);
  started_ = 0;
  startMore();
}

ScanAhead ScansAhead::read(const std::string& path) const {
  ScanAhead ahead;
  if (settings_file_checksum_) ahead.state = scanState(path, true, *settings_file_checksum_);
  try {
    ahead.scan = openScanFile(path, scan_, options_);
  } catch (...) {
    ahead.failure = std::current_exception();
  }
  return ahead;
}

ScanAhead ScansAhead::take(const std::string& path) {
  std::future<ScanAhead> next;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = std::find_if(reading_.begin(), reading_.end(),
                                    [&](const auto& reading) { return reading.first == path; });
    if (found != reading_.end()) {
      next = std::move(found->second);
      reading_.erase(found);
    }
  }
  if (!next.valid()) return read(path);
  next.wait();
  const std::lock_guard<std::mutex> lock(mutex_);
  startMore();
  return next.get();
}

void ScansAhead::startMore() {
  for (; started_ < paths_.size() && reading_.size() < at_a_time_; ++started_) {
    const std::string& path = paths_[started_];
    reading_.emplace_back(path, onOwnThread([this, &path] { return read(path); }));
  }
}

}  // namespace mems_stiction
