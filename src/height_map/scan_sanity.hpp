#pragma once

/// @file
/// Does a scan look like what it claims to be? A wrong unit is the commonest mistake, and it gives
/// no error: only a prediction that is wrong by powers of ten.

#include <string>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// A contact of 12 pixels and what surrounds it: smaller frames say nothing about roughness.
inline constexpr int kFewestPixelsOfASide = 8;

/// One line for each of these, naming the value, what is usual and the likely slip of units,
/// without commas; empty for a plausible scan:
/// - a pitch outside 1 pm .. 1 mm, or pixels more than 100 times as long as wide
/// - rows or columns without a measured pixel
/// - fewer than 8 x 8 pixels, or one height alone: no roughness can be seen
/// - a range of heights above the scan's width, else an rms slope above 10, or below what the noise
/// of any instrument
///   gives at this pitch (1e-4 at 1 um, falling with its root), or below pitch/1 cm, where
///   asperities would have radii of centimetres: the slope is that between neighbours, about the
///   mean slope
/// - float32 heights (in a double map too, if every height is exactly a float32) whose spacing
/// exceeds a tenth of their
///   rms height: a stage offset has swallowed the roughness.
std::vector<std::string> scanWarnings(const HeightMap& scan);

/// The same lines, by how wrong a scan looks.
struct ScanRemarks {
  std::vector<std::string> implausible;  ///< no instrument gives it: the pitch, a range above the
                                         ///< width, a slope above 10
  std::vector<std::string> unusual;

  std::vector<std::string> all() const;
};

/// - @p is_probe a sphere or tip, which may be higher than its frame is wide
ScanRemarks scanRemarks(const HeightMap& scan, bool is_probe = false);

/// Every finite height is a float32: the data has passed through one, or may do so without a loss.
bool isSinglePrecision(const cv::Mat& heights);

}  // namespace mems_stiction
