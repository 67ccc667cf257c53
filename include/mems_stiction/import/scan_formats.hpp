#pragma once

/// @file
/// Which reader a scan file needs: by its first bytes where the format has a signature, else by its name.

#include <string>
#include <vector>

#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// All channels of the file.
/// @throw FileError, with or without the file's name
std::vector<FileChannel> readChannels(const std::string& path, const ImportOptions& options);

}  // namespace mems_stiction
