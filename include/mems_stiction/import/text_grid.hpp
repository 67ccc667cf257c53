#pragma once

/// @file
/// Heights as text: one row of the scan per line, row 0 first, or a list of x, y and z.

#include <string>

#include "mems_stiction/height_map/raw_scan.hpp"
#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// Numbers are separated by commas, semicolons, tabs or spaces, with a decimal point or, where other characters separate,
/// a decimal comma. "nan", infinities, words for none ("N/A", "BAD") and an empty cell between two commas or semicolons
/// are missing. '#' and '%' begin a comment. What a heading states (sizes, "Value units", missing value) is read. Three
/// columns of many lines are a list of x, y and z on a regular grid.
/// - @p options what the file does not say of itself
/// @return one channel that takes settings; values in metres where the unit is stated, else in the unit of the file.
/// @throw FileError without a file name, with line and column where there are such, for text that is no such grid or can
/// be read in two ways: a second grid, a row or column of indices, columns beside x, y and z, marks that may be decimal or
/// group thousands, sizes and units that are stated twice, numbers that were cut off.
FileChannel parseTextGrid(const std::string& bytes, const TextOptions& options = {});

}  // namespace mems_stiction
