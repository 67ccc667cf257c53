#pragma once

/// @file
/// Which channel of a file is the height, and its values as a surface.

#include <string>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// Position in `channels` of the one to take: lengths in metres along x, y and z, and a title that
/// says height. A closed-loop sensor ("ZSensor", "Z-AxisSensor", "Height (measured)") goes before
/// "Height" and "Topography", these before unknown titles; then forward before backward, then the
/// lower id. All of them go before a channel whose heights span more than the scan is wide or the
/// piezo can move. Never chosen without being named: other signals
/// ("AmplitudeError", "Deflection"), arrays of curves, whose pixels are a thousand times as long as
/// wide, and one of several pages without a title.
/// - @p wanted title or number; empty = as above
/// @throw FileError without a file name: which channels there are, and why none can be taken.
std::size_t chooseHeightChannel(const std::vector<FileChannel>& channels,
                                const std::string& wanted = {});

/// What the user should know where a channel of a likelier title, a forward one or one before was
/// not taken, since its heights span too much or none was measured; empty if there is none.
std::string passedOver(const std::vector<FileChannel>& channels, std::size_t chosen);

/// Which of several topographies was taken, and which else there are, where they differ in pixels
/// or size: images of several places or zooms in one file. Else empty.
std::string othersOfOtherSize(const std::vector<FileChannel>& channels, std::size_t chosen);

/// "0: ZSensor"
std::string channelName(const FileChannel& channel);

/// The channel as a surface, pitch = size / pixels.
/// @throw FileError without a file name if the lengths or the pixels are not those of a surface, or
/// the heights span more than the instrument can move.
HeightMap surfaceOfChannel(const FileChannel& channel);

}  // namespace mems_stiction
