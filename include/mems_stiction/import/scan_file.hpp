#pragma once

/// @file
/// A scan from any file that we can read. doc/scans.md lists the formats.
///
/// Pitch and unit are those that the format or the file states. Images, arrays and text often state
/// nothing: then ScanOptions do. A sidecar goes before both, and a pitch in ScanFileOptions before
/// all. What a maker's file states is only replaced by that pitch; notes name what was not applied.
/// The sidecar is a YAML file beside the scan, "scan.tiff.yaml" for "scan.tiff", with keys of
/// ScanOptions and ScanIdentity, with or without "scan/". "scan.yaml" serves, too, if it states
/// such keys and no others.
///
///     const ScanFile file = openScanFile("scan.spm");
///     for (const std::string& note : file.notes) report(note);
///     use(file.surface);

#include <string>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/height_map/raw_scan.hpp"
#include "mems_stiction/height_map/scan_identity.hpp"
#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// What goes before what a file says about itself.
struct ScanFileOptions {
  double pitch_x = 0.0;      ///< instead of every other statement of the pitch [m]; 0 = none
  double pitch_y = 0.0;      ///< the same for rows [m]
  ImportOptions import;      ///< which channel, and for files that gwyddion reads
  std::string pitch_option;  ///< what the user states the pitch with, "--pitch"; empty = nothing
};

/// A file as heights in metres, and where they came from.
struct ScanFile {
  HeightMap surface;  ///< [m]
  std::string
      channel;  ///< the channel that was chosen, "0: ZSensor"; empty where a file has one only
  std::vector<std::string> notes;  ///< what the user should know of how it was read, a line each
  ScanIdentity
      identity;  ///< as sidecar and file state it; scan_name is the file's name if they state none
};

/// @throw FileError in one line with the file and the cause: missing, empty, cut off, not a height
/// map, without pitch.
/// @throw OptionsError if a sidecar has an unknown key or a value out of range; each line names the
/// sidecar.
ScanFile openScanFile(const std::string& path, const ScanOptions& scan = {},
                      const ScanFileOptions& options = {});

/// One channel of a scan file.
struct ScanChannel {
  std::string name;  ///< "0: ZSensor"; empty for files that have one channel without a name
  int rows = 0, cols = 0;
  double pitch_x = 0.0, pitch_y = 0.0;  ///< [unit_xy]; 0 = not stated
  std::string unit_xy;                  ///< "m", or another; empty = none
  std::string unit_z;
  bool is_unit_assumed = false;  ///< nobody states the unit of the heights: they count as metres
  bool is_chosen = false;        ///< openScanFile() takes this one
};

/// Every channel of the file, also those that are not heights. Images and text grids have one.
/// @throw FileError in one line with the file and the cause; OptionsError for a bad sidecar.
std::vector<ScanChannel> listScanChannels(const std::string& path, const ScanOptions& scan = {},
                                          const ScanFileOptions& options = {});

/// The file of settings that is read with this scan; empty if there is none. If "scan.tiff.yaml" is
/// a folder, a pipe or a link that leads nowhere, it is returned, and openScanFile() refuses it.
std::string sidecarOf(const std::string& path);

/// The paths without the sidecars of others among them, as "SCANS/*" lists both: those are read
/// with their scans.
std::vector<std::string> withoutSidecars(const std::vector<std::string>& paths);

/// The surface alone. @throw as openScanFile().
HeightMap readScanFile(const std::string& path, const ScanOptions& scan = {},
                       const ScanFileOptions& options = {});

}  // namespace mems_stiction
