#pragma once

/// @file
/// Digital Surf's .sur surfaces: read here, since Gwyddion makes heights of points that were not measured.

#include <string>
#include <vector>

#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// Uncompressed and compressed. A surface with colour or intensity images behind it gives the surface; several layers
/// give as many channels. Points of the value "smallest - 2" are missing where the header says that there are any.
/// @throw FileError without a file name: a profile or another object, cut off, a unit that is no length in x or y.
std::vector<FileChannel> parseSur(const std::string& bytes);

}  // namespace mems_stiction
