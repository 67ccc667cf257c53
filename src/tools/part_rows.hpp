#pragma once

/// The verdicts on parts, from a file of rows that stiction_batch has written: whatever wrote the
/// rows, in one run or in several, gives the same.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "batch_rows.hpp"
#include "part_devices.hpp"

namespace mems_stiction {

/// Pools the rows of a file by part_id and serial_id, and writes a row for each part. Rows that
/// state neither belong to none; a scan that was not predicted does not say of which part it was.
/// @param path .csv or .jsonl, as rowFormatOf() takes it
/// @param device gives what all scans of a part say of its device together, by their rows
/// @return how many parts there are. @throw FileError, OptionsError
std::size_t writeParts(const std::string& rows_path, const std::string& path,
                       const std::function<PartDevice(const std::vector<RowOfPart>&)>& device);

/// Scans of such a file that were predicted and state neither part_id nor serial_id. @throw
/// FileError
std::size_t scansWithoutPart(const std::string& rows_path);

}  // namespace mems_stiction
