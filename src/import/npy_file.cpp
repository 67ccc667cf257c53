#include "import/format_readers.hpp"

#include <cstdint>
#include <functional>

#include "import/byte_cursor.hpp"
#include "import/file_bytes.hpp"
#include "import/header_lines.hpp"
#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

/// What follows "'key':" in the header, a Python dictionary of three entries. Of a key given twice
/// numpy takes the last one.
std::string entry(const std::string& header, const std::string& key) {
  const std::size_t at = header.find("'" + key + "'");
  if (at != std::string::npos && header.find("'" + key + "'", at + 1) != std::string::npos)
    throw FileError("the .npy header states '" + key + "' twice, must state it once");
  const std::size_t colon = at == std::string::npos ? at : header.find(':', at);
  if (colon == std::string::npos) throw FileError("the .npy header does not state '" + key + "'");
  const std::size_t begin = std::min(header.find_first_not_of(' ', colon + 1), header.size());
  const std::size_t end = header[begin] == '(' ? header.find(')', begin) : header.find(',', begin);
  return header.substr(begin, end - begin);
}

/// "(480, 640": two numbers.
void readShape(const std::string& shape, std::uint64_t& rows, std::uint64_t& cols) {
  const std::size_t comma = shape.find(',');
  const std::size_t second =
      comma == std::string::npos ? comma : shape.find_first_of("0123456789", comma);
  if (second == std::string::npos || shape.find(',', second) != std::string::npos) {
    throw FileError("an array of the shape " + shownPiece(shape) +
                    ") is no scan: it must have two dimensions");
  }
  const auto size = [&shape](const std::string& text) {
    std::string digits = trimmed(text, " ");
    if (endsWith(digits, "L")) digits.pop_back();  // of Python 2
    const auto count = countIn(digits);
    if (!count || digits.find_first_not_of("0123456789") != std::string::npos) {
      throw FileError("an array of the shape " + shownPiece(shape) +
                      ") is no scan: it must have two whole numbers");
    }
    return *count;
  };
  rows = size(shape.substr(1, comma - 1));
  cols = size(shape.substr(comma + 1));
}

using Reader = std::function<double(ByteCursor&)>;

template <typename Number>
double numberAs(ByteCursor& cursor) {
  return static_cast<double>(cursor.number<Number>());
}

bool isTransposed(const std::string& order) {
  const std::string word = trimmed(order, " }\n");
  if (word == "True" || word == "False") return word == "True";
  throw FileError("the .npy header states '" + shownPiece(word) +
                  "' as fortran_order, must be True or False");
}

/// "<f8": order, kind, bytes. @throw FileError
Reader readerOf(const std::string& type, std::size_t& size, ByteOrder& order) {
  const std::string name =
      type.size() > 2 ? type.substr(2, type.size() - 3) : "";  // without quotes and order
  order = type.size() > 2 && type[1] == '>' ? ByteOrder::kBig : ByteOrder::kLittle;
  size = name.empty() ? 0 : static_cast<std::size_t>(name[name.size() - 1] - '0');
  if (name == "f8") return numberAs<double>;
  if (name == "f4") return numberAs<float>;
  if (name == "f2")
    return [](ByteCursor& cursor) { return halfToFloat(cursor.number<std::uint16_t>()); };
  if (name == "i1") return numberAs<std::int8_t>;
  if (name == "i2") return numberAs<std::int16_t>;
  if (name == "i4") return numberAs<std::int32_t>;
  if (name == "i8") return numberAs<std::int64_t>;
  if (name == "u1") return numberAs<std::uint8_t>;
  if (name == "u2") return numberAs<std::uint16_t>;
  if (name == "u4") return numberAs<std::uint32_t>;
  if (name == "u8") return numberAs<std::uint64_t>;
  throw FileError("an array of the type " + shownPiece(type) +
                  " is no scan: it must hold integers or floating-point numbers");
}

}  // namespace

FileChannel parseNpy(const std::string& bytes) {
  ByteCursor cursor(bytes.data(), bytes.size(), "the .npy file");
  cursor.take(6);
  const int version = cursor.number<std::uint8_t>();
  const int minor = cursor.number<std::uint8_t>();
  if (version < 1 || version > 3 || minor != 0) {
    throw FileError("a .npy file of version " + std::to_string(version) + "." +
                    std::to_string(minor) + " is not read, must be 1.0, 2.0 or 3.0");
  }
  const std::size_t header_size =
      version == 1 ? cursor.number<std::uint16_t>() : cursor.number<std::uint32_t>();
  const std::string header(cursor.take(header_size), header_size);
  std::uint64_t rows = 0;
  std::uint64_t cols = 0;
  readShape(entry(header, "shape"), rows, cols);
  checkPixelCount(cols, rows);
  std::size_t size = 0;
  ByteOrder order = ByteOrder::kLittle;
  const Reader read = readerOf(entry(header, "descr"), size, order);
  const bool is_transposed = isTransposed(entry(header, "fortran_order"));
  if (cursor.size() != rows * cols * size) {
    throw FileError("the .npy file has " + std::to_string(cursor.size()) +
                    " bytes of numbers, its header states " + std::to_string(rows * cols * size));
  }
  const std::size_t data_size = cursor.size();
  ByteCursor data(cursor.take(data_size), data_size, "the .npy file", order);
  FileChannel channel;
  channel.takes_settings = true;
  channel.values.create(static_cast<int>(rows), static_cast<int>(cols), CV_64FC1);
  for (std::uint64_t i = 0; i < rows * cols; ++i) {
    const auto row = static_cast<int>(is_transposed ? i % rows : i / cols);
    const auto col = static_cast<int>(is_transposed ? i / rows : i % cols);
    channel.values.at<double>(row, col) = read(data);
  }
  return channel;
}

}  // namespace mems_stiction
