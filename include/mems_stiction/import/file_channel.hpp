#pragma once

/// @file
/// One channel of a scan file, as the file states it: what every reader returns.
///
///     ScanFileOptions options;  // scan_file.hpp
///     options.import.channel = "ZSensor";
///     const HeightMap scan = readScanFile("scan.spm", {}, options);

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/height_map/raw_scan.hpp"
#include "mems_stiction/height_map/scan_identity.hpp"

namespace mems_stiction {

/// Values on a grid with what the file says of them. Lengths are converted to metres where the file
/// states their unit.
struct FileChannel {
  int id = 0;          ///< number of the channel in its file
  std::string title;   ///< UTF-8; empty if the file gives none
  cv::Mat values;      ///< rows x cols [unit_z], row 0 is the top; NaN = missing; CV_64FC1, or what
                       ///< ScanOptions scale
  double width = 0.0;  ///< of the whole image along x [unit_xy]; 0 = not stated
  double height = 0.0;  ///< of the whole image along y [unit_xy]; 0 = not stated
  std::string unit_xy;  ///< "m", or another; empty = not stated: a width > 0 is then in the unit of
                        ///< the values
  std::string unit_z;
  /// What the file says of the unit of its heights and is not understood: without a height_scale
  /// they are refused.
  std::string unit_doubt;
  /// The format has no fixed units (images, text, arrays): what the file does not state,
  /// ScanOptions and sidecar do.
  bool takes_settings = false;
  /// The pitch is from a field that programs fill without being asked (dots per inch): ScanOptions
  /// go before it.
  bool is_pitch_a_guess = false;
  double reach =
      0.0;  ///< what the instrument can move in z [unit_z]: no heights span more; 0 = not stated
  ScanIdentity identity;  ///< who measured it, when and with what, as far as the file says it
  std::vector<std::string> notes;  ///< what the user should know of how it was read, a line each
};

/// Which channel to take, and how to read it.
struct ImportOptions {
  std::string
      gwyddion_reader;    ///< reads makers' files; empty = read_by_gwyddion beside this library
  double timeout = 60.0;  ///< for one file [s]; usual files take 0.05 to 0.2 s
  std::string
      channel;  ///< title or number of the channel to take; empty = the likeliest height channel
  bool ignore_mask = false;  ///< pixels under the mask of a .gwy file are heights as the others
  TextOptions text;          ///< openScanFile() sets it from settings and sidecar
};

}  // namespace mems_stiction
