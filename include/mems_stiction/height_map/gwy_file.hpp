#pragma once

/// @file
/// Channels of a Gwyddion .gwy file.
///
/// The container is a tree of named, type-tagged, little-endian components (https://gwyddion.net/documentation/
/// user-guide-en/gwyfile-format.html). Channel N is "/N/data" (a GwyDataField) with "/N/data/title" and, where data is
/// missing, "/N/mask". Every length is checked against what is left of the file before it is used.

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace mems_stiction {

/// One channel of a .gwy container.
struct GwyChannel {
  int id = 0;           ///< N of "/N/data"
  std::string title;    ///< UTF-8; empty if the file gives none
  cv::Mat values;       ///< rows x cols CV_64FC1 [unit_z], row 0 is the top; masked pixels (mask > 0.5) are NaN
  double width = 0.0;   ///< of the whole image along x [unit_xy]
  double height = 0.0;  ///< of the whole image along y [unit_xy]
  std::string unit_xy;  ///< "m", or another; empty = none
  std::string unit_z;
};

/// @param bytes the whole file
/// @return the image channels by ascending id; empty if there are none.
/// @throw FileError with the cause (no file name: it is the caller's) if the bytes are not a .gwy container.
std::vector<GwyChannel> parseGwy(const std::string& bytes);

/// @throw FileError naming the file if it cannot be read or is not a .gwy container.
std::vector<GwyChannel> readGwyFile(const std::string& path);

}  // namespace mems_stiction
