#pragma once

/// @file
/// Instrument makers' files, read by the program gwyddion as a child process: a damaged file that crashes the reader
/// ends that process and nothing else. gwyddion is optional; the project neither links nor ships it.

#include <string>
#include <vector>

#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// Every image channel of the file, whatever its unit.
/// - @p bytes the file's content, by which a conversion is cached and found again if ImportOptions say so
/// @throw FileError in one line with the file and the cause: not installed, crashed, failed, timed out, unreadable.
std::vector<FileChannel> channelsByGwyddion(const std::string& path, const std::string& bytes,
                                            const ImportOptions& options);

}  // namespace mems_stiction
