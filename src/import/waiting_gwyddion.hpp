#pragma once

/// @file
/// gwyddion takes ten times as long to start as to read a small file. For many files it is started once per reading
/// thread, and a copy of that process reads each file: a damaged one ends its copy only.

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "files/child_process.hpp"

namespace mems_stiction {

/// One started gwyddion.
class WaitingGwyddion;

/// Name that a waiting gwyddion has for every file, in its messages too.
constexpr const char* kWaitingFileName = "scan";

/// The arguments with which gwyddion makes a container of a file.
std::vector<std::string> gwyddionArguments(const std::string& program, const std::string& target,
                                           const std::string& file);

/// Its environment: no display, and `home` for its settings. It reads modules from there and writes settings to it.
/// - @p settings further ones, "NAME=value"
std::vector<std::string> gwyddionEnvironment(const std::string& home, std::vector<std::string> settings = {});

/// The started ones of a program; any number of threads may use it.
class WaitingGwyddions {
 public:
  explicit WaitingGwyddions(std::string program);
  /// Ends them.
  ~WaitingGwyddions();
  WaitingGwyddions(const WaitingGwyddions&) = delete;
  WaitingGwyddions& operator=(const WaitingGwyddions&) = delete;

  /// A copy reads the file and writes "scan.gwy" into the folder, and what it says into "log".
  /// - @p timeout [s]
  /// @return none if the program cannot be used in this way: then start it for the file
  std::optional<ChildResult> read(const std::string& folder, const std::string& path, double timeout);

 private:
  /// One that is idle, or a new one.
  std::unique_ptr<WaitingGwyddion> take();

  std::string program_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<WaitingGwyddion>> idle_;
  bool is_possible_ = true;
};

}  // namespace mems_stiction
