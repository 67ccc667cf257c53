#pragma once

/// @file
/// The files that settings name: where a relative path leads, and which content figures follow
/// from.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "mems_stiction/configuration/configuration.hpp"

namespace mems_stiction {

/// Whether a setting names a file that is read: its key ends in "file".
bool namesFile(const std::string& key);

/// Key and path of each setting that names a file and is used: counter_surface/file with
/// counter_surface/type file, masks and polygons of regions.
std::vector<std::pair<std::string, std::string>> filesNamedBy(const Configuration& configuration);

/// Makes relative paths whole.
/// - @p keys the settings that one source states
/// - @p folder that its relative paths go by
void placeNamedFiles(const std::vector<std::string>& keys, const std::filesystem::path& folder,
                     Configuration& configuration);

/// Of the content of filesNamedBy() and of their sidecars: configuration.files_checksum, or that of
/// now. Empty if the settings name none.
std::string settingsFilesChecksum(const Configuration& configuration);

/// The same settings with the checksum of the files of now. To be called before the files are read.
Configuration withFilesOfNow(Configuration configuration);

}  // namespace mems_stiction
