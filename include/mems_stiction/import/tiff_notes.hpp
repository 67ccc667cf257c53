#pragma once

/// @file
/// Calibration that programs write into the texts of a TIFF page.

#include <string>

#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// The tags of a page that may state a scale.
struct TiffNotes {
  std::string description;                        ///< ImageDescription: ImageJ's lines or OME's XML
  std::string gdal_missing;                       ///< GDAL_NODATA
  std::string gdal_metadata;                      ///< XML with SCALE and OFFSET of the values
  double resolution_x = 0.0, resolution_y = 0.0;  ///< pixels per resolution unit; 0 = not stated
  double resolution_unit = 0.0;                   ///< [m]; 0 = none
};

/// Puts scale, unit and missing value into the channel.
/// - @p pages how many pages the file has: ImageJ can hide further ones behind the first
/// @throw FileError without a file name if the texts state what cannot be honoured.
void applyTiffNotes(const TiffNotes& notes, int pages, FileChannel& channel);

}  // namespace mems_stiction
