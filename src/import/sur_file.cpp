#include "import/format_readers.hpp"

#include <zlib.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>

#include "import/byte_cursor.hpp"
#include "import/file_bytes.hpp"
#include "import/file_checks.hpp"
#include "import/file_statements.hpp"
#include "import/length_unit.hpp"
#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr const char* kSurFile = "the .sur file";
constexpr int kNotMeasured = -2;  // beyond the smallest value

/// Kinds of object that begin with a surface.
enum Kind { kProfile = 1, kSurface = 2, kSurfaceSeries = 5, kColourSurface = 12 };

/// What one of the file's objects states in its 512 bytes.
struct Header {
  bool is_compressed = false;
  int objects = 0, kind = 0, special_points = 0, bits = 0, inversion = 0, comment = 0, hidden = 0;
  std::int32_t smallest = 0, cols = 0, rows = 0;
  double step_x = 0.0, step_y = 0.0, step_z = 0.0;
  std::string name, operator_name, date, title, unit_x, unit_y, unit_z;
};

/// Seconds, minutes, hours, day, month, year and day of the week.
std::string dateIn(ByteCursor numbers) {
  std::array<int, 6> part{};
  for (int& number : part) number = numbers.number<std::int16_t>();
  char text[64];
  std::snprintf(text, sizeof text, "%04d-%02d-%02d %02d:%02d:%02d", part[5], part[4], part[3],
                part[2], part[1], part[0]);
  return text;
}

Header readHeader(ByteCursor& file) {
  ByteCursor cursor = file.part(512);
  Header header;
  const std::string code = cursor.field(12);
  header.is_compressed = code == "DSCOMPRESSED";
  if (!header.is_compressed && code != "DIGITAL SURF")
    throw FileError("the .sur file has a damaged header");
  if (cursor.number<std::int16_t>() != 0)
    throw FileError("a .sur file of Macintosh byte order is not read");
  header.objects = cursor.number<std::int16_t>();
  cursor.take(2);
  header.kind = cursor.number<std::int16_t>();
  header.name = cursor.field(30);
  header.operator_name = cursor.field(30);
  cursor.take(6);
  header.special_points = cursor.number<std::int16_t>();
  cursor.take(10);
  header.bits = cursor.number<std::int16_t>();
  header.smallest = cursor.number<std::int32_t>();
  cursor.take(4);
  header.cols = cursor.number<std::int32_t>();
  header.rows = cursor.number<std::int32_t>();
  const auto points = cursor.number<std::int32_t>();
  header.step_x = static_cast<double>(cursor.number<float>());
  header.step_y = static_cast<double>(cursor.number<float>());
  header.step_z = static_cast<double>(cursor.number<float>());
  cursor.take(32);
  header.title = toUtf8(cursor.field(16));
  header.unit_x = toUtf8(cursor.field(16));
  header.unit_y = toUtf8(cursor.field(16));
  header.unit_z = toUtf8(cursor.field(16));
  cursor.take(3 * 16 + 3 * 4 + 2);
  header.inversion = cursor.number<std::int16_t>();
  cursor.take(2 + 12);
  header.date = dateIn(cursor.part(14));
  cursor.take(4 + 4 + 6);
  header.comment = cursor.number<std::uint16_t>();
  header.hidden = cursor.number<std::uint16_t>();
  const bool is_count_right = points == 0 || points == std::int64_t{header.cols} * header.rows;
  if (header.cols <= 0 || header.rows <= 0 || !is_count_right ||
      (header.bits != 16 && header.bits != 32)) {
    throw FileError("the .sur file has a damaged header");
  }
  checkPixelCount(static_cast<std::uint64_t>(header.cols), static_cast<std::uint64_t>(header.rows));
  return header;
}

/// The numbers of a compressed object: a count of streams, their sizes unpacked and packed, then
/// the streams.
std::string unpacked(ByteCursor& file, std::uint64_t size) {
  const auto count = file.number<std::uint32_t>();
  ByteCursor sizes = file.array(count, 8);
  std::string data(static_cast<std::size_t>(size), '\0');
  std::uint64_t done = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto raw = sizes.number<std::uint32_t>();
    const auto packed = sizes.number<std::uint32_t>();
    const char* stream = file.take(packed);
    uLongf got = raw;
    if (raw > size - done ||
        uncompress(reinterpret_cast<Bytef*>(&data[static_cast<std::size_t>(done)]), &got,
                   reinterpret_cast<const Bytef*>(stream), packed) != Z_OK ||
        got != raw) {
      throw FileError("the .sur file's compressed data are damaged");
    }
    done += raw;
  }
  if (done != size) throw FileError("the .sur file has fewer numbers than its header states");
  return data;
}

double unitOf(const std::string& text, const char* axis) {
  const auto unit = lengthUnit(text);
  if (!unit) {
    throw FileError(std::string("the .sur file states ") + axis + " in '" + shownPiece(text) +
                    "', which is no length");
  }
  return *unit;
}

/// Gwyddion writes the same two words into every file.
bool isGwyddions(const Header& header) {
  return header.name == "SCRATCH" && header.operator_name == "csm";
}

/// The next object of the file.
FileChannel readObject(ByteCursor& file, const Header& header) {
  file.take(static_cast<std::size_t>(header.comment) + static_cast<std::size_t>(header.hidden));
  const auto points =
      static_cast<std::uint64_t>(header.cols) * static_cast<std::uint64_t>(header.rows);
  const std::uint64_t size = points * static_cast<std::uint64_t>(header.bits / 8);
  const std::string data = header.is_compressed
                               ? unpacked(file, size)
                               : std::string(file.take(static_cast<std::size_t>(size)), size);
  const auto unit_z = heightUnit(header.unit_z);
  const bool is_turned = header.inversion >= 1 && header.inversion <= 3;
  const double scale = header.step_z * unit_z.value_or(1.0) * (is_turned ? -1.0 : 1.0);
  FileChannel channel;
  channel.title = header.title;
  channel.identity = identityFrom(
      {{"Date", header.date}, {"Operator", isGwyddions(header) ? "" : header.operator_name}});
  channel.unit_xy = "m";
  channel.unit_z = unit_z ? "m" : header.unit_z;
  channel.width = header.step_x * unitOf(header.unit_x, "x") * header.cols;
  channel.height = header.step_y * unitOf(header.unit_y, "y") * header.rows;
  channel.values.create(header.rows, header.cols, CV_64FC1);
  ByteCursor cursor(data.data(), data.size(), kSurFile);
  const std::int64_t missing = std::int64_t{header.smallest} + kNotMeasured;
  for (int i = 0; i < header.rows; ++i) {
    double* line = channel.values.ptr<double>(header.inversion == 3 ? header.rows - 1 - i : i);
    for (int j = 0; j < header.cols; ++j) {
      const std::int64_t value =
          header.bits == 16 ? cursor.number<std::int16_t>() : cursor.number<std::int32_t>();
      const bool is_missing = header.special_points == 1 && value == missing;
      line[header.inversion == 2 ? header.cols - 1 - j : j] =
          is_missing ? std::numeric_limits<double>::quiet_NaN()
                     : static_cast<double>(value) * scale;
    }
  }
  return channel;
}

/// Gwyddion calls the surfaces that it writes profiles.
bool isSurface(const Header& header) {
  return header.kind == kSurface || header.kind == kSurfaceSeries ||
         header.kind == kColourSurface ||
         (header.kind == kProfile && header.rows > 1 && isGwyddions(header));
}

}  // namespace

std::vector<FileChannel> parseSur(const std::string& bytes) {
  ByteCursor file(bytes.data(), bytes.size(), kSurFile);
  std::vector<FileChannel> channels;
  Header header = readHeader(file);
  if (!isSurface(header)) {
    throw FileError("the .sur file holds an object of kind " + std::to_string(header.kind) +
                    ", not a surface");
  }
  const bool is_series = header.kind == kSurfaceSeries;
  const int objects = is_series ? std::max(1, header.objects) : 1;
  for (int i = 0; i < objects; ++i) {
    if (i > 0) header = readHeader(file);
    channels.push_back(readObject(file, header));
    channels.back().id = i;
    channels.back().takes_settings = false;
  }
  if (header.kind == kSurface && header.objects <= 1)
    demandLength(".sur", bytes.size(), bytes.size() - file.size());
  if (is_series && channels.size() > 1) {
    channels.front().notes.push_back("the first of " + std::to_string(channels.size()) +
                                     " surfaces of a series");
  }
  return channels;
}

}  // namespace mems_stiction
