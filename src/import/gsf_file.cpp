#include "import/byte_cursor.hpp"
#include "import/file_bytes.hpp"
#include "import/format_readers.hpp"
#include "import/header_lines.hpp"
#include "import/length_unit.hpp"
#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr const char* kGsf = "the .gsf file";
constexpr std::size_t kMostHeader = 1 << 20;  // [bytes]
constexpr std::size_t kAlignment = 4;         // [bytes]; one to four NUL bytes fill the header up

/// [unit_xy]; 0 = not stated
double gsfSide(const HeaderLines& header, const std::string& key) {
  if (!header.has(key)) return 0.0;
  const double side = plainNumber(header.value(key));
  if (!(side > 0.0))
    throw FileError("the .gsf file states " + key + " as '" + shownPiece(header.value(key)) + "'");
  return side;
}

/// A unit with its prefix: some programs then write the numbers in it, others in metres all the
/// same.
std::string gsfUnit(const HeaderLines& header, const std::string& key) {
  const std::string unit = header.value(key);
  if (unit == "m" || !heightUnit(unit)) return unit;
  throw FileError("the .gsf file states " + key + " as '" + shownPiece(unit) +
                  "', the format has units without prefix alone: write metres, and 'm'");
}

}  // namespace

FileChannel parseGsf(const std::string& bytes) {
  const std::size_t end = bytes.substr(0, kMostHeader).find('\0');
  if (end == std::string::npos) throw FileError("the .gsf header has no end: cut off");
  const HeaderLines header(bytes.substr(0, end), "=");
  for (const char* key : {"XRes", "YRes", "XReal", "YReal", "XYUnits", "ZUnits"}) {
    if (header.times(key) > 1)
      throw FileError("the .gsf header states " + std::string(key) + " twice: damaged");
  }
  const std::uint64_t cols = header.count("XRes");
  const std::uint64_t rows = header.count("YRes");
  checkPixelCount(cols, rows);
  const std::size_t begin = (end / kAlignment + 1) * kAlignment;
  const std::uint64_t size = cols * rows * sizeof(float);
  if (bytes.size() < begin || bytes.size() - begin != size) {
    throw FileError("the .gsf file has " + std::to_string(bytes.size()) +
                    " bytes, its header states " + std::to_string(begin + size) +
                    ": cut off or damaged");
  }
  FileChannel channel;
  channel.takes_settings = true;
  channel.title = header.value("Title");
  channel.width = gsfSide(header, "XReal");
  channel.height = gsfSide(header, "YReal");
  channel.unit_xy = gsfUnit(header, "XYUnits");
  channel.unit_z = gsfUnit(header, "ZUnits");
  channel.values.create(static_cast<int>(rows), static_cast<int>(cols), CV_64FC1);
  ByteCursor data(bytes.data() + begin, bytes.size() - begin, kGsf);
  for (int row = 0; row < channel.values.rows; ++row) {
    double* line = channel.values.ptr<double>(row);
    for (int col = 0; col < channel.values.cols; ++col)
      line[col] = static_cast<double>(data.number<float>());
  }
  if (channel.unit_xy != "m") channel.width = channel.height = 0.0;  // settings state the pitch
  return channel;
}

}  // namespace mems_stiction
