#pragma once

/// @file
/// Which pixels of a scan as it came were not measured, though numbers stand there: numbers that
/// stand for none, and lines that the instrument did not reach.
///
/// A scan that was stopped is filled up with one number. Noise and quantisation make neighbouring
/// pixels differ, so a line of one value is no measurement where the lines beside it are rough. It
/// is one where it belongs to a flat part: then its value goes on beside it (steps, gratings, a cap
/// on a plane), or the lines beside it are of one value too.

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// Largest number that is a height [m]. Programs and drivers write 1e38, FLT_MAX, DBL_MAX and the
/// like for "no height".
constexpr double kLargestHeight = 1e20;

/// rows x cols CV_8UC1: 255 where a finite number lies beyond kLargestHeight, 0 elsewhere.
cv::Mat sentinelMask(const cv::Mat& heights);

/// The surface with those pixels invalid; the same, its pixels shared, if there are none.
HeightMap withoutSentinels(const HeightMap& surface);

/// Pixels of a line that must be of one value before it counts as not measured.
constexpr int kFewestStoppedPixels = 8;

/// Rows and columns without a measured pixel.
struct MissingLines {
  int rows = 0;
  int cols = 0;
};

MissingLines missingLines(const HeightMap& surface);

/// The surface with pixels invalid that were not measured, those of withoutSentinels() and of
/// stopped lines; the same, its pixels shared, if there are none. Every scan goes through here,
/// from whatever file, message or array.
HeightMap measuredPart(const HeightMap& surface);

}  // namespace mems_stiction
