#pragma once

/// @file
/// Which state of which files a row is of, so that a row is not kept for a file that was measured
/// anew under its name.

#include <string>

#include "files/input_file.hpp"
#include "mems_stiction/settings/figure.hpp"

namespace mems_stiction {

/// What a scan's figures follow from beside the settings' values; checksums are empty where there
/// is no such file.
struct ScanState {
  FileState file;                      ///< the scan, or the bag that it is in
  std::string sidecar_checksum;        ///< of the settings beside a scan
  std::string settings_file_checksum;  ///< settingsFilesChecksum() of named_files.hpp
};

/// Reads the whole file. To be called before the scan is read: what changes in between shows the
/// next time.
/// - @p has_sidecar false for bags
ScanState scanState(const std::string& path, bool has_sidecar,
                    const std::string& settings_file_checksum);

/// Calls visit(Figure, value) for each field, by the names of the columns.
template <typename Source, typename Visitor>
void visitScanStateFields(Source& state, Visitor&& visit) {
  visit({"file_size", "B"}, state.file.size);
  visit({"file_time"}, state.file.time);
  visit({"file_checksum"}, state.file.checksum);
  visit({"sidecar_checksum"}, state.sidecar_checksum);
  visit({"settings_file_checksum"}, state.settings_file_checksum);
}

}  // namespace mems_stiction
