#pragma once

/// @file
/// Files that are either written whole or not at all.

#include <string>

namespace mems_stiction {

enum class OutputSafety {
  kWhole,   ///< never half a file, but perhaps none after a power failure
  kOnDisk,  ///< the disk has it when writeFile() returns
};

/// Hands all of the bytes to the system. @return false, with errno set, if it does not take them
bool writeAll(int descriptor, const std::string& bytes);

/// A pipe by a name of its own, which would wait for somebody who reads it, or a socket; not what
/// isOpenStream().
bool isLonelyPipe(const std::string& path);
/// What is wrong with it.
constexpr const char* kLonelyPipe = "is a pipe or a socket, must be a file";

/// Writes beside the file, flushes to the disk, and gives it the name when everything is there: an
/// interruption or a full disk leaves what was there before. Devices, and pipes that the shell has
/// opened, are written to directly.
/// @throw FileError naming the file and the cause, among them kLonelyPipe
void writeFile(const std::string& path, const std::string& bytes,
               OutputSafety safety = OutputSafety::kOnDisk);

}  // namespace mems_stiction
