#pragma once

/// @file
/// Is a zip archive (x3p, plux and others) whole? Readers of vendor files do not compare checksums.

#include <string>
#include <vector>

namespace mems_stiction {

/// Unpacks every entry and compares size and CRC-32 with those the archive states.
/// @return the entries' names
/// @throw FileError without a file name, naming the entry, if one differs or unpacks to more than kMaxFileBytes.
std::vector<std::string> checkZip(const std::string& bytes);

}  // namespace mems_stiction
