#pragma once

/// @file
/// Which channel of a file is the height, and its values as a surface.

#include <string>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// Position in `channels` of the one to take: lengths in metres along x, y and z, and a title that says height. A
/// closed-loop sensor ("ZSensor", "Z-AxisSensor", "Height (measured)") goes before "Height" and "Topography", these
/// before unknown titles; then forward before backward, then the lower id. Titles of other signals ("AmplitudeError",
/// "Deflection") are never chosen without being named. Of several pages without a title none is chosen.
/// - @p wanted title or number; empty = as above
/// @throw FileError without a file name: which channels there are, and why none can be taken.
std::size_t chooseHeightChannel(const std::vector<FileChannel>& channels, const std::string& wanted = {});

/// "0: ZSensor"
std::string channelName(const FileChannel& channel);

/// The channel as a surface, pitch = size / pixels.
/// @throw FileError without a file name if the lengths or the pixels are not those of a surface.
HeightMap surfaceOfChannel(const FileChannel& channel);

}  // namespace mems_stiction
