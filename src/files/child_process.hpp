#pragma once

/// @file
/// Run another program and wait for it, for at most a stated time.

#include <string>
#include <vector>

namespace mems_stiction {

/// How a child process ended, and what it said.
struct ChildResult {
  bool started = false;    ///< false: the program was not found or could not be started
  bool timed_out = false;  ///< the program and its children were killed after the timeout
  int exit_code = -1;      ///< when it ended by itself, else -1
  int signal = 0;          ///< the signal that ended it, else 0
};

/// No shell: the arguments reach the program as they are. Input is empty; output and error go to
/// `log_path`. The program leads a process group of its own, with limited memory and without core
/// files.
/// - @p arguments the program (looked up in PATH) and its arguments
/// - @p environment the whole environment, "NAME=value"
/// - @p timeout [s]
ChildResult runChild(const std::vector<std::string>& arguments,
                     const std::vector<std::string>& environment, const std::string& log_path,
                     double timeout);

/// This process's environment without the named variables, then the given settings "NAME=value".
std::vector<std::string> environmentWithout(const std::vector<std::string>& names,
                                            const std::vector<std::string>& settings);

}  // namespace mems_stiction
