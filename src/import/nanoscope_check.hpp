#pragma once

/// @file
/// Do the statements of a NanoScope header agree with each other and with the file? NanoScope is the format of Digital
/// Instruments, Veeco and Bruker.

#include <optional>
#include <string>
#include <vector>

#include "mems_stiction/height_map/scan_identity.hpp"

namespace mems_stiction {

/// Nothing for other files.
/// @throw FileError without a file name if an image is not as long as its samples and lines, two overlap, the last does not
/// end with the file, or pixels are not square where the header says that they are
void checkNanoscope(const std::string& bytes);

/// Who measured it, when and with what; nothing for other files.
ScanIdentity nanoscopeIdentity(const std::string& bytes);

/// What the piezo can move in z [m]: no height of the scan spans more. None if the header does not state it.
std::optional<double> nanoscopeReach(const std::string& bytes);

/// What the user should know, a line each: images of another size than that of the scan.
std::vector<std::string> nanoscopeNotes(const std::string& bytes);

}  // namespace mems_stiction
