#pragma once

/// @file
/// WSxM images (.stp, .top, .tom): read here, since Gwyddion reads past the end of files that are cut off and takes a
/// Latin-1 micro sign for nothing.

#include <string>

#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// True for an image of heights or another signal; false for WSxM's curves, movies and text exports.
bool isWsxmImage(const std::string& start);

/// Integers span the stated z amplitude; floating-point numbers are in its unit. The image stands upside down and
/// mirrored in the file.
/// @throw FileError without a file name: cut off, without size or unit.
FileChannel parseWsxm(const std::string& bytes);

}  // namespace mems_stiction
