#include "mems_stiction/height_map/raw_scan.hpp"

#include <cmath>
#include <cstdint>

#include "height_map/pitch.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr double kInvalid = std::numeric_limits<double>::quiet_NaN();

/// Row by row; `Channels` is 1, or 2 for (height, quality). The pixel's own type takes part in the
/// comparison with invalid_value, so that -9999.9 also meets its float32 neighbour.
template <typename Scalar, int Channels>
cv::Mat scaled(const cv::Mat& pixels, const ScanOptions& options) {
  cv::Mat heights(pixels.size(), CV_64FC1);
  const double scale = options.height_scale;
  const double offset = options.height_offset;
  const double invalid_value = options.invalid_value;
  const bool has_invalid_value = !std::isnan(invalid_value);
  // Out of the type's range, the cast would be undefined, and no pixel can match anyway.
  const bool castable =
      has_invalid_value &&
      invalid_value >= static_cast<double>(std::numeric_limits<Scalar>::lowest()) &&
      invalid_value <= static_cast<double>(std::numeric_limits<Scalar>::max());
  const double nearest_value = castable && !std::numeric_limits<Scalar>::is_integer
                                   ? static_cast<double>(static_cast<Scalar>(invalid_value))
                                   : invalid_value;
  for (int row = 0; row < pixels.rows; ++row) {
    const Scalar* source = pixels.ptr<Scalar>(row);
    double* target = heights.ptr<double>(row);
    for (int col = 0; col < pixels.cols; ++col) {
      const double pixel = source[Channels * col];
      double height = pixel * scale + offset;
      if (has_invalid_value && (pixel == invalid_value || pixel == nearest_value))
        height = kInvalid;
      if (Channels == 2 && std::isnan(static_cast<double>(source[Channels * col + Channels - 1])))
        height = kInvalid;
      target[col] = height;
    }
  }
  return heights;
}

}  // namespace

void ScanOptions::describe(OptionVisitor& visitor) {
  visitor.number("scan/pitch_x", pitch_x, "m", Range::within(0.0, kLargestPitch),
                 "distance of neighbouring columns; 0 = the scan brings its own");
  visitor.number("scan/pitch_y", pitch_y, "m", Range::within(0.0, kLargestPitch),
                 "distance of neighbouring rows; 0 = the scan brings its own");
  visitor.number("scan/height_scale", height_scale, "m per unit of the pixel", Range::any(),
                 "height = pixel x height_scale + height_offset; not 0");
  visitor.number("scan/height_offset", height_offset, "m", Range::any(),
                 "height = pixel x height_scale + height_offset");
  visitor.number("scan/invalid_value", invalid_value, "", Range::anyOrNone(),
                 "pixels of this raw value are invalid; nan = none");
  visitor.enumeration<DecimalMark>("scan/decimal_mark", text.decimal_mark,
                                   {{"auto", DecimalMark::kAuto},
                                    {"point", DecimalMark::kPoint},
                                    {"comma", DecimalMark::kComma}},
                                   "of numbers in text files; auto = what the file's numbers "
                                   "allow, and refused where both are possible");
  visitor.enumeration<YAxis>(
      "scan/y_axis", text.y_axis,
      {{"auto", YAxis::kAuto}, {"down", YAxis::kDown}, {"up", YAxis::kUp}},
      "which way y grows in lists of x, y and z; auto = by heading or order, else down");
}

HeightMap heightMapFromPixels(const cv::Mat& pixels, const ScanOptions& options,
                              const PixelOwner& owner) {
  if (pixels.empty()) throw SurfaceError("the image has no pixels");
  if (!isPitch(options.pitch_x) || !isPitch(options.pitch_y)) {
    throw SurfaceError(pitchComplaint(options.pitch_x, options.pitch_y) +
                       ": state scan/pitch_x and scan/pitch_y");
  }
  const bool as_it_is = options.height_scale == 1.0 && options.height_offset == 0.0 &&
                        std::isnan(options.invalid_value);
  cv::Mat heights;
  switch (pixels.type()) {
    case CV_32FC1:
      heights = as_it_is ? pixels : scaled<float, 1>(pixels, options);
      break;
    case CV_64FC1:
      heights = as_it_is ? pixels : scaled<double, 1>(pixels, options);
      break;
    case CV_32FC2:
      heights = scaled<float, 2>(pixels, options);
      break;
    case CV_16UC1:
      heights = scaled<std::uint16_t, 1>(pixels, options);
      break;
    case CV_16SC1:
      heights = scaled<std::int16_t, 1>(pixels, options);
      break;
    case CV_8UC1:
      heights = scaled<std::uint8_t, 1>(pixels, options);
      break;
    default:
      throw SurfaceError(
          "pixels of OpenCV type " + cv::typeToString(pixels.type()) +
          " are not heights; accepted: 32FC1, 64FC1, 32FC2 (height, quality), 16UC1, 16SC1, 8UC1");
  }
  return {heights, options.pitch_x, options.pitch_y, owner};
}

}  // namespace mems_stiction
