#pragma once

/// @file
/// Height maps to TIFF.

#include <string>

#include <opencv2/core.hpp>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/height_map/scan_identity.hpp"

namespace mems_stiction {

/// Writes heights [m] as a TIFF of one float channel: float32, or float64 where float32 would cost
/// more than a thousandth of the rms height.
/// - @p heights rows x cols, CV_32FC1 or CV_64FC1
/// @throw FileError naming the file if it cannot be written whole; a file of that name stays as it
/// was then.
void writeHeightTiff(const std::string& path, const cv::Mat& heights);

/// Writes a surface as a TIFF that reads back to the last bit (float32 where that shows every
/// height exactly, else float64; NaN for missing pixels), and beside it PATH.yaml with its pitch
/// and scale, and what is stated of the scan.
/// - @p note one line on where the surface comes from, kept as a comment; control characters are
/// escaped
/// - @p identity the checksum is left out: what is read later is the TIFF
/// @throw FileError naming the file if it cannot be written whole
void writeScan(const std::string& path, const HeightMap& surface, const std::string& note,
               const ScanIdentity& identity = {});

/// True if neither the image nor its sidecar exists, or both are as writeScan() left them: by the
/// checksums that the sidecar begins with. Nothing is lost if they are written again.
bool isAsWritten(const std::string& path);

}  // namespace mems_stiction
