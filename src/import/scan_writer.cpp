#include "mems_stiction/import/scan_writer.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/one_line.hpp"
#include "mems_stiction/base/option_yaml.hpp"
#include "mems_stiction/base/output_file.hpp"
#include "mems_stiction/height_map/validity.hpp"
#include "mems_stiction/import/file_bytes.hpp"

namespace mems_stiction {
namespace {

/// Distance of float32 numbers near the largest height [m].
double singleSpacing(const HeightStatistics& statistics) {
  const auto largest = static_cast<float>(std::max(std::abs(statistics.min), std::abs(statistics.max)));
  return static_cast<double>(std::nextafter(largest, std::numeric_limits<float>::infinity())) - largest;
}

/// @throw FileError without a file name
std::string tiffOf(const cv::Mat& pixels) {
  std::vector<unsigned char> bytes;
  try {
    // Uncompressed: every reader takes it, and nothing is lost.
    if (cv::imencode(".tiff", pixels, bytes, {cv::IMWRITE_TIFF_COMPRESSION, 1})) {
      return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
  } catch (const cv::Exception& error) {
    throw FileError("cannot be written: " + error.err);
  }
  throw FileError("cannot be written as TIFF");
}

void writePixels(const std::string& path, const cv::Mat& pixels) {
  std::string bytes;
  try {
    bytes = tiffOf(pixels);
  } catch (const FileError& error) {
    throw FileError(path + ": " + error.what());
  }
  writeFile(path, bytes);
}

std::string checksum(const std::string& bytes) {
  char text[16];
  std::snprintf(text, sizeof text, "%08lx",
                crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  return text;
}

/// First line of a sidecar: checksums of the image and of the lines that follow.
std::string seal(const std::string& tiff, const std::string& lines) {
  return "# Written with the image beside it; checksums " + checksum(tiff) + " and " + checksum(lines) + "\n";
}

/// True if the float32 pixels hold every height, or its absence.
bool isSame(const cv::Mat& heights, const cv::Mat& narrow) {
  for (int row = 0; row < heights.rows; ++row) {
    const double* wide_line = heights.ptr<double>(row);
    const float* narrow_line = narrow.ptr<float>(row);
    for (int col = 0; col < heights.cols; ++col) {
      if (wide_line[col] != static_cast<double>(narrow_line[col]) && !std::isnan(wide_line[col])) return false;
    }
  }
  return true;
}

}  // namespace

void writeHeightTiff(const std::string& path, const cv::Mat& heights) {
  cv::Mat pixels = heights;
  if (heights.depth() == CV_64F) {
    bool narrow = true;
    try {
      const HeightStatistics statistics = heightStatistics(HeightMap(heights, 1.0, 1.0));
      narrow = singleSpacing(statistics) <= 1e-3 * statistics.rms_height;
    } catch (const SurfaceError&) {
      // No valid pixel: NaN fits both.
    }
    if (narrow) heights.convertTo(pixels, CV_32F);
  }
  writePixels(path, pixels);
}

void writeScan(const std::string& path, const HeightMap& surface, const std::string& note) {
  const cv::Mat heights = ownedHeights(surface);
  cv::Mat pixels;
  heights.convertTo(pixels, CV_32F);
  if (!isSame(heights, pixels)) pixels = heights;
  std::string bytes;
  try {
    bytes = tiffOf(pixels);
  } catch (const FileError& error) {
    throw FileError(path + ": " + error.what());
  }
  const std::string lines = "# " + oneLine(note) +
                            "\n# Heights in metres: height = pixel x height_scale + height_offset.\n" +
                            "pitch_x: " + yamlNumber(surface.pitchX()) + "\npitch_y: " + yamlNumber(surface.pitchY()) +
                            "\nheight_scale: 1.0\nheight_offset: 0.0\n";
  writeFile(path, bytes);
  writeFile(path + ".yaml", seal(bytes, lines) + lines);
}

bool isAsWritten(const std::string& path) {
  const std::string sidecar = path + ".yaml";
  std::error_code error;
  const bool has_image = std::filesystem::exists(std::filesystem::symlink_status(path, error));
  const bool has_sidecar = std::filesystem::exists(std::filesystem::symlink_status(sidecar, error));
  if (!has_image && !has_sidecar) return true;
  try {
    const std::string text = readFileBytes(sidecar);
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    return text.substr(0, end) == seal(readFileBytes(path), text.substr(end));
  } catch (const FileError&) {
    return false;
  }
}

}  // namespace mems_stiction
