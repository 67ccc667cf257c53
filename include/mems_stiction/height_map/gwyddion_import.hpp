#pragma once

/// @file
/// Instrument makers' files, read by the program gwyddion as a child process: a damaged file that crashes the reader
/// ends that process and nothing else. gwyddion is optional; the project neither links nor ships it.

#include <string>
#include <vector>

#include "mems_stiction/height_map/gwy_file.hpp"
#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// Which channel to take, and how to call Gwyddion.
struct ImportOptions {
  std::string program = "gwyddion";  ///< looked up in PATH
  double timeout = 60.0;             ///< for one file [s]; usual files take 0.02 to 0.2 s
  std::string channel;               ///< title or number of the channel to take; empty = the likeliest height channel
};

/// A channel as heights, and where it came from.
struct ImportedScan {
  HeightMap surface;    ///< CV_64FC1 [m]; missing data is NaN
  std::string channel;  ///< which one it is: "0: ZSensor"
};

/// Every image channel of the file, whatever its unit.
/// @throw FileError in one line with the file and the cause: not installed, crashed, failed, timed out, unreadable.
std::vector<GwyChannel> channelsByGwyddion(const std::string& path, const ImportOptions& options = {});

/// Position in `channels` of the one to take: lengths in metres along x, y and z, and a title that says height. A
/// closed-loop sensor ("ZSensor", "Z Height") goes before "Height" and "Topography", these before unknown titles, and
/// titles of other signals ("AmplitudeError", "Deflection") are never chosen without being named; then the lower id.
/// - @p wanted title or number; empty = as above
/// @throw FileError without a file name: which channels there are, and why none can be taken.
std::size_t chooseHeightChannel(const std::vector<GwyChannel>& channels, const std::string& wanted = {});

/// The channel as a surface, pitch = size / pixels.
/// @throw FileError without a file name if the lengths or the pixels are not those of a surface.
HeightMap surfaceOfChannel(const GwyChannel& channel);

/// channelsByGwyddion(), chooseHeightChannel() and surfaceOfChannel().
/// @throw FileError in one line with the file and the cause.
ImportedScan importByGwyddion(const std::string& path, const ImportOptions& options = {});

/// The same choice from channels that are already read, for .gwy files.
/// @throw FileError in one line with the file and the cause.
ImportedScan importChannel(const std::string& path, const std::vector<GwyChannel>& channels, const std::string& wanted);

}  // namespace mems_stiction
