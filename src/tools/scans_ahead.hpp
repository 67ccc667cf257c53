#pragma once

/// Scan files are read side by side while others are predicted.

#include <deque>
#include <future>
#include <string>
#include <vector>

#include "mems_stiction/import/scan_file.hpp"

namespace mems_stiction {

/// The files of a batch in their order, each read once; as many at a time as there are processors.
class ScansAhead {
 public:
  ScansAhead(const ScanOptions& scan, const ScanFileOptions& options) : scan_(scan), options_(options) {}

  /// The files that will be taken, in this order.
  void expect(std::vector<std::string> paths);

  /// The next of the expected files, or any other. @throw as openScanFile()
  ScanFile take(const std::string& path);

 private:
  void startMore();

  ScanOptions scan_;
  ScanFileOptions options_;
  std::vector<std::string> paths_;
  std::size_t started_ = 0;
  std::deque<std::pair<std::string, std::future<ScanFile>>> reading_;
};

}  // namespace mems_stiction
