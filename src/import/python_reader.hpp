#pragma once

/// @file
/// Files that a library of Python reads, in a python3 of its own: a damaged file that crashes the
/// library ends that process and nothing else.

#include <string>
#include <vector>

#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

constexpr int kPythonHasNoLibrary = 3;  ///< exit status of a script
constexpr int kPythonReadsNoChannel = 4;
constexpr int kPythonRefuses = 5;  ///< whatever else reads such files

/// What a script of Python has read.
struct PythonReading {
  std::vector<FileChannel> channels;
  bool is_library_missing = false;  ///< there is no python3, or none that has the library
  std::string remark;  ///< what the script said where it reads no channel, its lines in one
};

/// Runs a script with two arguments, the file and a folder. There it writes each channel as N.npy,
/// and the list `channels`: a line "title, width [m], height [m], unit of the heights, note"
/// between tabs for each. It ends with kPythonHasNoLibrary, or with kPythonReadsNoChannel or
/// kPythonRefuses after a text `remark`. The python3 of the PATH is asked first, then the system's,
/// which may have the library.
/// - @p library its name, for messages
/// - @p timeout [s]
/// @throw FileError without a file name: crashed, timed out, no list, refused.
PythonReading channelsByPython(const std::string& script, const std::string& library,
                               const std::string& path, double timeout);

}  // namespace mems_stiction
