#pragma once

/// @file
/// Which files a node reads, and what it says of those that it cannot.
///
/// Parameters come from anybody in the network, and what the node says reaches everybody. So it
/// reads files that parameters name only below folders that its environment states, and never says
/// what stands in them.

#include <filesystem>
#include <string>
#include <vector>

#include "mems_stiction/configuration/configuration.hpp"
#include "ros/live_predictor.hpp"

namespace mems_stiction {

/// Folders with a colon between them; not set: the user's home. The folder for temporary files is
/// everybody's. It is no parameter, which whoever is to be kept out could set.
inline constexpr char kScanFoldersVariable[] = "MEMS_STICTION_SCAN_FOLDERS";

/// Where links lead, without those that do not exist.
std::vector<std::filesystem::path> scanFolders();

/// Why a path may neither be read nor written, as it lies elsewhere; empty if it may. A link counts
/// as what it leads to.
std::string whyOutside(const std::string& path, const std::vector<std::filesystem::path>& folders);

/// The same of a file with which others may be read: a link beside it of a like name, or another
/// folder in its header.
std::string whyElsewhere(const std::string& path,
                         const std::vector<std::filesystem::path>& folders);

/// One line per setting that names a file elsewhere, or one with which a file elsewhere may be
/// read: a link beside it of a like name, or another folder in its header. A link counts as what it
/// leads to.
std::vector<std::string> filesElsewhere(const Configuration& configuration,
                                        const std::vector<std::filesystem::path>& folders);

/// Reads the files of the configuration.
/// @throw OptionsError naming settings and files, with nothing that stands in these.
LivePredictor predictorFromFolders(const Configuration& configuration, bool accumulate_deformation);

}  // namespace mems_stiction
