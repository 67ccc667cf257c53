#pragma once

/// @file
/// PNG and OpenEXR images of heights, by libpng and OpenEXR. OpenCV scales counts of few bits, reads other channels than
/// those there are, and loads a hundred libraries before main() begins.

#include <string>

#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// Integers are counts as they stand, also of fewer than 8 bits.
/// @return a channel that takes settings; several values per pixel (a picture) give a matrix of as many channels.
/// @throw FileError without a file name: damaged, too many pixels.
FileChannel parsePng(const std::string& bytes);

/// The file's single channel, whatever its name.
/// @throw FileError without a file name: several channels, damaged, too many pixels.
FileChannel parseExr(const std::string& bytes);

}  // namespace mems_stiction
