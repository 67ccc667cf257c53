#pragma once

/// @file
/// What must not outlive this process when it is interrupted: programs that it has started, files
/// that are not whole, a line on the terminal.

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>

namespace mems_stiction {

/// For the start of main(), before any thread: from now on INT, TERM and HUP end the children that
/// are registered, with their process groups, remove the scratch paths, and then end the process as
/// they would have. A signal that is ignored (nohup) stays ignored. A file that grows beyond the
/// limit of the shell is an error of its writer (EFBIG), and no signal.
void cleanUpWhenInterrupted();

/// Writes the text in place of the line that stands on the terminal of the standard error; an empty
/// one wipes it, and so does an interruption.
void writeInPlace(const std::string& text);

/// A file or folder that goes when the process is interrupted, as long as the object lives.
class ScratchPath {
 public:
  /// - @p make makes it and returns its path, while no interruption is handled
  explicit ScratchPath(const std::function<std::string()>& make);
  ~ScratchPath();
  ScratchPath(const ScratchPath&) = delete;
  ScratchPath& operator=(const ScratchPath&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A folder for files that nobody else may see, and that must not stay: a new one below the
/// system's temporary one. It goes with the object, and with an interruption.
class PrivateFolder {
 public:
  /// @throw FileError if it cannot be made
  PrivateFolder();
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  std::filesystem::path path() const { return scratch_.path(); }

 private:
  ScratchPath scratch_;
};

/// A child process that is ended with its group when the process is interrupted, as long as the
/// object lives.
class RunningChild {
 public:
  /// - @p start starts it as the leader of a group and returns its id, or -1
  explicit RunningChild(const std::function<pid_t()>& start);
  ~RunningChild();
  RunningChild(const RunningChild&) = delete;
  RunningChild& operator=(const RunningChild&) = delete;

  pid_t id() const { return id_; }

 private:
  pid_t id_ = -1;
};

}  // namespace mems_stiction
