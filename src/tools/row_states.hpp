#pragma once

/// The state of the files that a row is of: its last columns, and whether the files are still as
/// they were.

#include <map>
#include <string>
#include <vector>

#include "batch_rows.hpp"
#include "evaluation/scan_state.hpp"
#include "row_texts.hpp"

namespace mems_stiction {

/// file_size, file_time, file_checksum, sidecar_checksum, settings_file_checksum.
RowFields stateFields(const ScanState& state);

/// Of each of them that has one.
std::map<std::string, std::string> stateUnits();

/// What has changed since the row was written, in words; empty if nothing has. A file that is gone
/// has not: its row is all that is left of it.
/// @throw FileError without a file name for a row that does not say what it is of
std::string changeSince(const RowTexts& row, const ScanState& now);

/// Whether the file of the row was there when the row was written, and is no longer.
bool isGone(const RowTexts& row, const ScanState& now);

/// Before the rows of shards are joined: all rows of a file, and of the settings' files, are of one
/// state, and none of a scan that has changed since. Rows without a state are joined as they are.
/// @return a sentence for each file that is gone. @throw FileError naming a shard to run again
std::vector<std::string> requireOneState(const std::vector<std::string>& shards);

}  // namespace mems_stiction
