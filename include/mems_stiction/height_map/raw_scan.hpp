#pragma once

/// @file
/// From pixels as an instrument or a message delivers them to heights in metres.
///
///     ScanOptions options;
///     options.pitch_x = options.pitch_y = 10e-9;  // [m]
///     options.height_scale = 1e-9;                // pixels are nanometres
///     const HeightMap scan = heightMapFromPixels(pixels, options);

#include <limits>

#include <opencv2/core.hpp>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// The sign before the decimals of numbers in text.
enum class DecimalMark { kAuto, kPoint, kComma };

/// Which way y grows in a list of x, y and z; "down" is along rows.
enum class YAxis { kAuto, kDown, kUp };

/// What a text file does not say of itself.
struct TextOptions {
  DecimalMark decimal_mark = DecimalMark::kAuto;  ///< auto: what the numbers of the file allow
  YAxis y_axis = YAxis::kAuto;  ///< auto: what heading or order of a list say, else down
};

/// How pixels become heights: height = pixel x height_scale + height_offset.
struct ScanOptions {
  double pitch_x = 0.0;  ///< distance of neighbouring columns [m], >= 0; 0 = not stated, the scan
                         ///< must bring its own
  double pitch_y = 0.0;  ///< distance of neighbouring rows [m], >= 0; 0 = not stated
  double height_scale = 1.0;   ///< [m per unit of the pixel], not 0
  double height_offset = 0.0;  ///< [m]
  double invalid_value = std::numeric_limits<double>::quiet_NaN();  ///< pixels of this raw value
                                                                    ///< are invalid; NaN = none

  TextOptions text;

  void describe(OptionVisitor& visitor);
};

/// - @p pixels rows x cols of CV_32FC1, CV_64FC1, CV_16UC1, CV_16SC1, CV_8UC1, or CV_32FC2 (height,
/// quality: the
///        second channel is ignored but for NaN). CV_32FC1 or CV_64FC1 with scale 1, offset 0 and
///        no invalid value are taken as HeightMap does, without a copy if somebody owns them.
/// - @p owner what the pixels lie in, if the matrix does not own them
/// @throw SurfaceError for any other type (the message lists these), an empty image or a pitch that
/// is not > 0.
HeightMap heightMapFromPixels(const cv::Mat& pixels, const ScanOptions& options,
                              const PixelOwner& owner = nullptr);

}  // namespace mems_stiction
