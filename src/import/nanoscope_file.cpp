#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "import/file_bytes.hpp"
#include "import/format_readers.hpp"
#include "import/nanoscope_header.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

using namespace nanoscope;

constexpr const char* kScale = "@2:Z scale";

/// What stands between two signs; empty if they are not there.
std::string between(const std::string& text, char open, char close) {
  const std::size_t begin = text.find(open);
  const std::size_t end = begin == std::string::npos ? begin : text.find(close, begin);
  return end == std::string::npos ? "" : text.substr(begin + 1, end - begin - 1);
}

/// The value of a key that one list has, or several alike; empty where they differ.
std::string onlyValue(const std::vector<List>& lists, const std::string& key) {
  std::string value;
  for (const List& list : lists) {
    if (!list.lines.has(key)) continue;
    if (!value.empty() && value != list.lines.value(key)) return "";
    value = list.lines.value(key);
  }
  return value;
}

/// The unit behind the last blank. Degrees are a sign of Latin-1.
std::string hardUnit(const std::string& text) {
  const std::size_t blank = text.rfind(' ');
  const std::string unit = blank == std::string::npos ? "" : text.substr(blank + 1);
  return unit == "\xB0" || unit == "\xBA" ? "deg" : unit;
}

/// Factor of a whole range of numbers, and its unit.
struct Scale {
  double range = 0.0;
  std::string unit;
};

/// "V [Sens. Zsens] (0.0067 V/LSB) 330.0000 V" with "@Sens. Zsens: V 34.55678 nm/V", or without a
/// length: in the hard unit.
/// @return none where that is said in another way
std::optional<Scale> scaleOf(const List& image, const std::vector<List>& lists) {
  const std::string text = image.lines.value(kScale);
  const std::string soft = between(text, '[', ']');
  const std::string hard = between(text, '(', ')');
  const double range = hardValue(text);
  const std::string unit = hardUnit(text);
  if (!startsWith(text, "V [") || soft.empty() || !endsWith(hard, "/LSB") || !(range > 0.0) ||
      unit.empty()) {
    return std::nullopt;
  }
  const std::string sensitivity = onlyValue(lists, "@" + soft);
  if (sensitivity.empty()) return std::nullopt;
  const double metres = metresPerVolt(sensitivity);
  const double volts = unit == "V" ? range : unit == "mV" ? 1e-3 * range : 0.0;
  if (metres > 0.0) return volts > 0.0 ? std::optional<Scale>({volts * metres, "m"}) : std::nullopt;
  return volts > 0.0 ? Scale{volts, "V"} : Scale{range, unit};
}

/// Rows from the bottom, little-endian.
template <typename Number>
cv::Mat valuesOf(const char* data, int rows, int cols, double scale) {
  cv::Mat values(rows, cols, CV_64FC1);
  for (int row = rows - 1; row >= 0; --row) {
    double* line = values.ptr<double>(row);
    for (int col = 0; col < cols; ++col, data += sizeof(Number)) {
      Number number;
      std::memcpy(&number, data, sizeof number);
      line[col] = number * scale;
    }
  }
  return values;
}

std::optional<FileChannel> channelOf(const List& image, const std::vector<List>& lists,
                                     const std::string& bytes) {
  const HeaderLines& lines = image.lines;
  for (const char* key :
       {"Data offset", "Data length", "Samps/line", "Number of lines", "@2:Image Data", kScale}) {
    if (lines.times(key) != 1) return std::nullopt;
  }
  const std::uint64_t bytes_each = bytesOfNumber(lists);
  if (lines.has("@4:Z scale") ||
      (lines.has("Bytes/pixel") && lines.count("Bytes/pixel") != bytes_each)) {
    return std::nullopt;
  }
  const std::uint64_t cols = lines.count("Samps/line");
  const std::uint64_t rows = lines.count("Number of lines");
  const std::uint64_t offset = lines.count("Data offset");
  const Size size = scanSize(lines);
  const auto scale = scaleOf(image, lists);
  FileChannel channel;
  channel.title = between(lines.value("@2:Image Data"), '[', ']');
  if (!scale || channel.title.empty() || !(size.x > 0.0) || !(size.y > 0.0)) return std::nullopt;
  checkPixelCount(cols, rows);
  if (offset > bytes.size() || cols * rows * bytes_each > bytes.size() - offset)
    return std::nullopt;
  const char* data = bytes.data() + offset;
  const int height = static_cast<int>(rows);
  const int width = static_cast<int>(cols);
  channel.values = bytes_each == 4
                       ? valuesOf<std::int32_t>(data, height, width, scale->range / 4294967296.0)
                       : valuesOf<std::int16_t>(data, height, width, scale->range / 65536.0);
  channel.width = size.x;
  channel.height = size.y;
  channel.unit_xy = "m";
  channel.unit_z = scale->unit;
  return channel;
}

}  // namespace

std::vector<FileChannel> parseNanoscope(const std::string& bytes) {
  if (!isNanoscope(bytes)) return {};
  const std::vector<List> lists = listsOf(bytes);
  std::vector<FileChannel> channels;
  for (const List& list : lists) {
    if (list.name == "Ciao scan list" || !endsWith(list.name, "image list")) continue;
    auto channel = list.name == "Ciao image list" ? channelOf(list, lists, bytes) : std::nullopt;
    if (!channel) return {};
    channel->id = static_cast<int>(channels.size());
    channels.push_back(std::move(*channel));
  }
  return channels;
}

}  // namespace mems_stiction
