#pragma once

/// @file
/// Do the statements of a NanoScope header agree with each other and with the file? NanoScope is
/// the format of Digital Instruments, Veeco and Bruker.

#include <string>
#include <vector>

#include "mems_stiction/height_map/scan_identity.hpp"

namespace mems_stiction {

/// What a NanoScope header states beside the images.
struct NanoscopeStatements {
  ScanIdentity identity;  ///< who measured it, when and with what
  double reach = 0.0;  ///< what the piezo can move in z [m]: no height spans more; 0 = not stated
  std::vector<std::string> notes;  ///< what the user should know, a line each: images of another
                                   ///< size than that of the scan
};

/// Nothing for other files.
/// @throw FileError without a file name if an image is not as long as its samples and lines, two
/// overlap, the last does not end with the file, or pixels are not square where the header says
/// that they are
NanoscopeStatements checkedNanoscope(const std::string& bytes);

}  // namespace mems_stiction
