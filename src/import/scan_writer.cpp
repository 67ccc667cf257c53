#include "import/scan_writer.hpp"

#include <yaml-cpp/yaml.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <type_traits>
#include <vector>

#include "errors/one_line.hpp"
#include "files/output_file.hpp"
#include "height_map/scan_sanity.hpp"
#include "height_map/validity.hpp"
#include "import/file_bytes.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/figure.hpp"
#include "settings/option_yaml.hpp"

namespace mems_stiction {
namespace {

/// Distance of float32 numbers near the largest height [m].
double singleSpacing(const HeightStatistics& statistics) {
  const auto largest =
      static_cast<float>(std::max(std::abs(statistics.min), std::abs(statistics.max)));
  return static_cast<double>(std::nextafter(largest, std::numeric_limits<float>::infinity())) -
         largest;
}

/// A little-endian TIFF of one strip of floating-point numbers (TIFF 6.0, section 2), uncompressed:
/// every reader takes it, and nothing is lost.
std::string tiffOf(const cv::Mat& pixels) {
  const cv::Mat whole = pixels.isContinuous() ? pixels : pixels.clone();
  const std::size_t size = whole.total() * whole.elemSize();
  if (size > std::numeric_limits<std::uint32_t>::max() - 1024)
    throw FileError("too many pixels for a TIFF");
  constexpr std::uint32_t kShort = 3;
  constexpr std::uint32_t kLong = 4;
  struct Entry {
    std::uint32_t tag, type, value;
  };
  const auto rows = static_cast<std::uint32_t>(whole.rows);
  const auto bits = static_cast<std::uint32_t>(8 * whole.elemSize());
  const std::vector<Entry> entries = {{256, kLong, static_cast<std::uint32_t>(whole.cols)},
                                      {257, kLong, rows},
                                      {258, kShort, bits},
                                      {259, kShort, 1},  // no compression
                                      {262, kShort, 1},  // black is zero
                                      {273, kLong, 8},   // where the pixels begin
                                      {277, kShort, 1},
                                      {278, kLong, rows},
                                      {279, kLong, static_cast<std::uint32_t>(size)},
                                      {339, kShort, 3}};  // floating-point numbers
  std::string bytes("II*\0", 4);
  const auto append = [&bytes](std::uint32_t number, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xFF);
  };
  append(static_cast<std::uint32_t>(8 + size), 4);
  bytes.append(reinterpret_cast<const char*>(whole.data), size);
  append(static_cast<std::uint32_t>(entries.size()), 2);
  for (const Entry& entry : entries) {
    append(entry.tag, 2);
    append(entry.type, 2);
    append(1, 4);
    append(entry.value, 4);
  }
  append(0, 4);  // no further page
  return bytes;
}

/// What is stated of the scan, as keys of the sidecar.
std::string identityLines(const ScanIdentity& identity) {
  std::string lines;
  visitScanIdentityFields(identity, [&lines](const Figure& figure, const auto& value) {
    const std::string name = figure.name;
    if (!isStated(value) || name == "checksum") return;
    if constexpr (std::is_same_v<decltype(value), const std::string&>) {
      YAML::Emitter text;
      text << YAML::DoubleQuoted << oneLine(value);
      lines += name + ": " + text.c_str() + "\n";
    } else {
      lines += name + ": " + yamlNumber(value) + "\n";
    }
  });
  return lines;
}

std::string checksum(const std::string& bytes) {
  char text[16];
  std::snprintf(
      text, sizeof text, "%08lx",
      crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  return text;
}

/// First line of a sidecar: checksums of the image and of the lines that follow.
std::string seal(const std::string& tiff, const std::string& lines) {
  return "# Written with the image beside it; checksums " + checksum(tiff) + " and " +
         checksum(lines) + "\n";
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
  writeFile(path, tiffOf(pixels));
}

void writeScan(const std::string& path, const HeightMap& surface, const std::string& note,
               const ScanIdentity& identity) {
  const cv::Mat heights = ownedHeights(surface);
  cv::Mat pixels = heights;
  if (isSinglePrecision(heights)) heights.convertTo(pixels, CV_32F);
  const std::string bytes = tiffOf(pixels);
  const std::string lines =
      "# " + oneLine(note) +
      "\n# Heights in metres: height = pixel x height_scale + height_offset.\n" +
      "pitch_x: " + yamlNumber(surface.pitchX()) + "\npitch_y: " + yamlNumber(surface.pitchY()) +
      "\nheight_scale: 1.0\nheight_offset: 0.0\n" + identityLines(identity);
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
