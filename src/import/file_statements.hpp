#pragma once

/// @file
/// Who measured a scan, when and with what: under the names that the formats have for it.

#include <map>
#include <string>

#include "mems_stiction/height_map/scan_identity.hpp"

namespace mems_stiction {

/// Names of a file's header with their values, in the file's words.
using FileStatements = std::map<std::string, std::string>;

/// Acquisition time, instrument and operator. Names are compared without regard to case, blanks and
/// the section that they stand in ("General Info::", "General Info/"); values that say that nothing
/// is known ("not available") are none. Values are made UTF-8 of one line, of at most 200 bytes.
ScanIdentity identityFrom(const FileStatements& statements);

/// The same three of `identity`, and of `other` what that does not state.
ScanIdentity completed(ScanIdentity identity, const ScanIdentity& other);

}  // namespace mems_stiction
