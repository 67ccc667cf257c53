#pragma once

/// @file
/// Which pixels of a scan as it came were not measured, though they hold numbers: numbers that stand for none, and lines that
/// the instrument did not reach.
///
/// A scan that was stopped is filled up with one number. Noise and quantisation make neighbouring pixels differ, so a
/// line of one value is no measurement where the lines beside it are rough. It is one where it belongs to a flat part: then
/// its value goes on beside it (steps, gratings, a cap on a plane), or the lines beside it are of one value too.

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// Pixels of a line that must be of one value before it counts as not measured.
constexpr int kFewestStoppedPixels = 8;

/// rows x cols CV_8UC1: 255 in rows and columns that the instrument did not reach: all their measured pixels, at
/// least kFewestStoppedPixels, are of one value, which the nearest rough lines hold in less than a quarter of their pixels. The filled
/// end of a line that the instrument stopped in goes with them.
/// Empty if there are none.
cv::Mat stoppedLines(const cv::Mat& heights);

/// Rows and columns without a measured pixel.
struct MissingLines {
  int rows = 0;
  int cols = 0;
};

MissingLines missingLines(const HeightMap& surface);

/// The surface with pixels invalid that were not measured, those of withoutSentinels() and of stoppedLines(); the same, its
/// pixels shared, if there are none. Every scan goes through here, from whatever file, message or array.
HeightMap measuredPart(const HeightMap& surface);

}  // namespace mems_stiction
