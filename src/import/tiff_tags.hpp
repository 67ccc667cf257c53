#pragma once

/// @file
/// What tags and texts of a TIFF file say beside the pixels: calibration, and whose tags make
/// heights of them.

#include <string>

#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// Some instruments write TIFF files whose pages are pictures or bare counts, with what makes them
/// heights in tags or texts of their own: Park Systems, JPK and Olympus LEXT.
/// @return true if the first directory of the TIFF file has Park's tag 50432 with its magic number
/// 0x0E031301, JPK's tags
///         32768 and 32769 (versions of file and program), or LEXT's description; false also for
///         one that is damaged
bool hasInstrumentTags(const std::string& bytes);

/// Pages by the list of them alone, whatever is on them; `most` if there are as many or more.
/// libtiff takes a list that is damaged for one that ends.
/// @throw FileError without a file name where the list leaves the file
int pageCount(const std::string& bytes, int most);

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
