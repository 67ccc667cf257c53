#pragma once

/// What the rows of a file were made with, kept beside them, so that rows of different settings
/// never mix.

#include <map>
#include <string>
#include <vector>

#include "batch_arguments.hpp"
#include "mems_stiction/configuration/configuration.hpp"

namespace mems_stiction {

/// What must be the same for rows to stand in one file. Shards have the same.
/// @param total rows of all shards @param units of the columns
std::string settingsText(std::size_t total, const std::vector<std::string>& inputs,
                         const BatchArguments& arguments,
                         const std::map<std::string, std::string>& units,
                         const Configuration& configuration);

/// What of it must be the same: files that settings name may lie elsewhere, and rows say which
/// content they are of (row_states.hpp).
std::string comparableSettings(const std::string& settings);

/// Writes the settings beside the rows, or compares them with what is there.
/// @throw FileError if the file of rows has those of other settings
void checkSettings(const std::string& path, const std::string& settings);

/// The configuration that the rows were made with, by settingsText(), which was read from the file
/// beside the rows in `path`.
/// - @p arguments get inputs, topic and ignore_mask
/// @throw FileError naming that file if it does not say, OptionsError
Configuration madeOf(const std::string& path, const std::string& settings,
                     BatchArguments& arguments);

/// The total of settingsText(), which was read from the file beside the rows in `path`.
/// @throw FileError naming that file if it does not say
std::size_t totalOf(const std::string& path, const std::string& settings);

}  // namespace mems_stiction
