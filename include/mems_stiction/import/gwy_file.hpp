#pragma once

/// @file
/// Channels of a Gwyddion .gwy file.
///
/// The container is a tree of named, type-tagged, little-endian components (https://gwyddion.net/documentation/
/// user-guide-en/gwyfile-format.html). Channel N is "/N/data" (a GwyDataField) with "/N/data/title" and, where data is
/// missing, "/N/mask". Every length is checked against what is left of the file before it is used.

#include <string>
#include <vector>

#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// Values are CV_64FC1. Pixels under a mask (mask > 0.5) are NaN, and a note of the channel counts them.
/// - @p bytes the whole file
/// - @p ignore_mask pixels under masks keep their values
/// @return the image channels by ascending id; empty if there are none.
/// @throw FileError with the cause (no file name: it is the caller's) if the bytes are not a .gwy container.
std::vector<FileChannel> parseGwy(const std::string& bytes, bool ignore_mask = false);

}  // namespace mems_stiction
