#include <algorithm>

#include "import/byte_cursor.hpp"
#include "import/file_bytes.hpp"
#include "import/format_readers.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr const char* kTmd = "the .tmd file";
constexpr std::size_t kTmdMagic = 32;      // [bytes], with line end and NUL
constexpr std::size_t kMostComment = 256;  // [bytes]
constexpr double kTmdUnit = 1e-3;          // [m], of sides and heights

}  // namespace

FileChannel parseTmd(const std::string& bytes) {
  const std::size_t end = bytes.substr(0, kTmdMagic + kMostComment).find('\0', kTmdMagic);
  if (end == std::string::npos)
    throw FileError("the .tmd file's comment has no end: cut off or damaged");
  ByteCursor cursor(bytes.data() + end + 1, bytes.size() - end - 1, kTmd);
  const std::uint64_t cols = cursor.number<std::uint32_t>();
  const std::uint64_t rows = cursor.number<std::uint32_t>();
  checkPixelCount(cols, rows);
  FileChannel channel;
  channel.title = "Height";
  channel.width = kTmdUnit * static_cast<double>(cursor.number<float>());
  channel.height = kTmdUnit * static_cast<double>(cursor.number<float>());
  channel.unit_xy = channel.unit_z = "m";
  cursor.take(2 * sizeof(float));  // where in a larger field of view
  if (!(channel.width > 0.0) || !(channel.height > 0.0))
    throw FileError("the .tmd file states sides that are not > 0");
  if (cursor.size() != cols * rows * sizeof(float)) {
    throw FileError("the .tmd file has " + std::to_string(cursor.size()) +
                    " bytes of heights, its header states " +
                    std::to_string(cols * rows * sizeof(float)) + ": cut off or damaged");
  }
  channel.values.create(static_cast<int>(rows), static_cast<int>(cols), CV_64FC1);
  for (int row = 0; row < channel.values.rows; ++row) {
    double* line = channel.values.ptr<double>(row);
    for (int col = 0; col < channel.values.cols; ++col) {
      line[col] = kTmdUnit * static_cast<double>(cursor.number<float>());
    }
  }
  return channel;
}

}  // namespace mems_stiction
