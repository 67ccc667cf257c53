#pragma once

/// Scan files are read side by side while others are predicted.

#include <deque>
#include <exception>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/scan_state.hpp"
#include "mems_stiction/import/scan_file.hpp"

namespace mems_stiction {

/// A file as it was when it was read.
struct ScanAhead {
  ScanState state;  ///< empty where none is asked for
  ScanFile scan;
  std::exception_ptr failure;  ///< what openScanFile() has thrown; else null
};

/// The files of a batch in their order, each read once; as many at a time as there are processors,
/// or takers. Any number of threads may take them.
class ScansAhead {
 public:
  /// - @p settings_file_checksum goes into the state of each scan; none: states are left out, for
  /// which each file is read once more
  /// - @p takers threads that will take files
  ScansAhead(const ScanOptions& scan, const ScanFileOptions& options,
             std::optional<std::string> settings_file_checksum, unsigned takers);

  /// The files that will be taken, in this order.
  void expect(std::vector<std::string> paths);

  /// Files that are read, or wait to be taken, at a time.
  std::size_t atATime() const { return at_a_time_; }

  /// One of the expected files, or any other.
  ScanAhead take(const std::string& path);

 private:
  void startMore();
  ScanAhead read(const std::string& path) const;

  ScanOptions scan_;
  ScanFileOptions options_;
  std::optional<std::string> settings_file_checksum_;
  std::size_t at_a_time_;
  std::mutex mutex_;
  std::vector<std::string> paths_;
  std::size_t started_ = 0;
  std::deque<std::pair<std::string, std::future<ScanAhead>>> reading_;
};

}  // namespace mems_stiction
