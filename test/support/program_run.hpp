#pragma once

/// A real program, as users and scripts call it: its output, its exit status, the lines that it
/// complains with.

#include <sys/wait.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "support/scratch_folder.hpp"

namespace mems_stiction {

struct Outcome {
  int status = -1;
  std::string output;
  std::vector<std::string> errors;  ///< lines
};

/// By the shell; what it says passes through files of the folder.
inline Outcome runProgram(const ScratchFolder& folder, const std::string& command) {
  const std::string redirected = command + " >" + folder.file("out") + " 2>" + folder.file("err");
  const int status = std::system(redirected.c_str());
  Outcome outcome;
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.output = ScratchFolder::read(folder.file("out"));
  std::istringstream errors(ScratchFolder::read(folder.file("err")));
  for (std::string line; std::getline(errors, line);) outcome.errors.push_back(line);
  return outcome;
}

}  // namespace mems_stiction
