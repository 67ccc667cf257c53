#pragma once

/// @file
/// A scan from any file that we can read, and a height map to TIFF.
///
/// | content                                       | read by     | calibration                     |
/// |-----------------------------------------------|-------------|---------------------------------|
/// | TIFF (float32, float64, integers), PNG, EXR   | OpenCV      | ScanOptions and the sidecar     |
/// | text grid (.txt, .asc, .csv)                  | text_grid   | ScanOptions and the sidecar     |
/// | .gwy                                          | gwy_file    | the file's own                  |
/// | instrument makers' files, Park's TIFF too     | gwyddion    | the file's own                  |
///
/// The sidecar is a YAML file beside the scan, "scan.tiff.yaml" or "scan.yaml" for "scan.tiff", with keys of
/// ScanOptions, with or without "scan/" before them. What it states goes before ScanOptions; a pitch in ScanFileOptions
/// before both.

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/height_map/gwyddion_import.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/height_map/raw_scan.hpp"

namespace mems_stiction {

/// What goes before what a file says about itself.
struct ScanFileOptions {
  double pitch_x = 0.0;  ///< instead of every other statement of the pitch [m]; 0 = none
  double pitch_y = 0.0;  ///< the same for rows [m]
  ImportOptions import;  ///< for files that gwyddion reads; `channel` also for .gwy
};

/// A file as heights in metres, and where they came from.
struct ScanFile {
  HeightMap surface;    ///< [m]
  std::string channel;  ///< the channel that was chosen, "0: ZSensor"; empty where a file has one only
};

/// @throw FileError in one line with the file and the cause: missing, empty, cut off, not a height map, without pitch.
/// @throw OptionsError if a sidecar has an unknown key or a value out of range; each line names the sidecar.
ScanFile openScanFile(const std::string& path, const ScanOptions& scan = {}, const ScanFileOptions& options = {});

/// One channel of a scan file.
struct ScanChannel {
  std::string name;  ///< "0: ZSensor"; empty for files that have one channel without a name
  int rows = 0, cols = 0;
  double pitch_x = 0.0, pitch_y = 0.0;  ///< [unit_xy]; 0 = not stated
  std::string unit_xy;                  ///< "m", or another; empty = none
  std::string unit_z;
  bool is_chosen = false;  ///< openScanFile() takes this one
};

/// Every channel of the file, also those that are not heights. Images and text grids have one.
/// @throw FileError in one line with the file and the cause; OptionsError for a bad sidecar.
std::vector<ScanChannel> listScanChannels(const std::string& path, const ScanOptions& scan = {},
                                          const ScanFileOptions& options = {});

/// The surface alone. @throw as openScanFile().
HeightMap readScanFile(const std::string& path, const ScanOptions& scan = {}, const ScanFileOptions& options = {});

/// Writes heights [m] as a TIFF of one float channel: float32, or float64 where float32 would cost more than a
/// thousandth of the rms height.
/// - @p heights rows x cols, CV_32FC1 or CV_64FC1
/// @throw FileError naming the file if it cannot be written.
void writeHeightTiff(const std::string& path, const cv::Mat& heights);

/// Writes a surface as a TIFF that reads back to the last bit (float32 where that holds every height exactly, else
/// float64), and beside it PATH.yaml with its pitch and scale.
/// - @p note one line on where the surface comes from, kept as a comment
/// @throw FileError naming the file if it cannot be written.
void writeScan(const std::string& path, const HeightMap& surface, const std::string& note);

}  // namespace mems_stiction
