#pragma once

/// @file
/// TIFF files of heights, by libtiff: each full-size page is a channel. OpenCV knows neither pages nor tags, and scales
/// pixels of fewer than 8 or 16 bits.

#include <string>
#include <vector>

#include "mems_stiction/import/file_channel.hpp"

namespace mems_stiction {

/// Pages that are thumbnails or overviews by their tag, or masks, are left out. Integers of 1 to 32 bits are counts as
/// they stand; float16, float32, float64. GDAL's missing value becomes NaN. The scale of ImageJ, OME, or else the
/// resolution, is the pitch.
/// @return channels that take settings; a page of several values per pixel (a picture) has a matrix of as many channels.
/// @throw FileError without a file name: damaged, of a kind that is no scan, too many pixels.
std::vector<FileChannel> parseTiff(const std::string& bytes);

}  // namespace mems_stiction
