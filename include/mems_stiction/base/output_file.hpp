#pragma once

/// @file
/// Files that are either written whole or not at all.

#include <string>

namespace mems_stiction {

enum class OutputSafety {
  kWhole,   ///< never half a file, but perhaps none after a power failure
  kOnDisk,  ///< the disk has it when writeFile() returns
};

/// Writes beside the file, flushes to the disk, and gives it the name when everything is there: an interruption or a
/// full disk leaves what was there before. Pipes and devices are written to directly.
/// @throw FileError naming the file and the cause
void writeFile(const std::string& path, const std::string& bytes, OutputSafety safety = OutputSafety::kOnDisk);

}  // namespace mems_stiction
