#include "mems_stiction/height_map/gwy_file.hpp"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>

#include "mems_stiction/base/errors.hpp"

namespace mems_stiction {
namespace {

/// A view of the bytes not read yet; every read checks the rest first.
class Cursor {
 public:
  Cursor(const char* begin, std::size_t size) : data_(begin), size_(size) {}

  bool atEnd() const { return size_ == 0; }
  std::size_t size() const { return size_; }

  const char* take(std::size_t count) {
    if (count > size_) throw FileError("the .gwy container ends in the middle of a component");
    const char* start = data_;
    data_ += count;
    size_ -= count;
    return start;
  }

  Cursor part(std::size_t count) { return {take(count), count}; }

  /// `count` items of `item_size` bytes, without overflow.
  Cursor array(std::size_t count, std::size_t item_size) {
    if (count > size_ / item_size) throw FileError("the .gwy container ends in the middle of an array");
    return part(count * item_size);
  }

  std::string text() {
    const void* end = size_ == 0 ? nullptr : std::memchr(data_, '\0', size_);
    if (end == nullptr) throw FileError("the .gwy container ends in the middle of a text");
    const auto length = static_cast<std::size_t>(static_cast<const char*>(end) - data_);
    std::string value(data_, length);
    take(length + 1);
    return value;
  }

  template <typename Unsigned>
  Unsigned littleEndian() {
    const char* bytes = take(sizeof(Unsigned));
    Unsigned value = 0;
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
      value |= static_cast<Unsigned>(static_cast<unsigned char>(bytes[i])) << (8 * i);
    }
    return value;
  }

  double real() {
    const auto bits = littleEndian<std::uint64_t>();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  const char* data_;
  std::size_t size_;
};

/// One component: its content is not read until somebody asks for it.
struct Component {
  std::string name;
  char type = '\0';
  std::string object_type;  ///< class name, for type 'o'
  Cursor content{nullptr, 0};
};

Component readComponent(Cursor& cursor) {
  Component component;
  component.name = cursor.text();
  component.type = *cursor.take(1);
  const auto array = [&cursor](std::size_t item_size) {
    const std::uint32_t count = cursor.littleEndian<std::uint32_t>();
    return cursor.array(count, item_size);
  };
  switch (component.type) {
    case 'b':
    case 'c':
      component.content = cursor.part(1);
      break;
    case 'i':
      component.content = cursor.part(4);
      break;
    case 'q':
    case 'd':
      component.content = cursor.part(8);
      break;
    case 's': {
      Cursor start = cursor;
      component.content = start.part(cursor.text().size() + 1);
      break;
    }
    case 'o':
      component.object_type = cursor.text();
      component.content = array(1);
      break;
    case 'C':
      component.content = array(1);
      break;
    case 'I':
      component.content = array(4);
      break;
    case 'Q':
    case 'D':
      component.content = array(8);
      break;
    case 'S':
    case 'O':
      for (std::uint32_t left = cursor.littleEndian<std::uint32_t>(); left > 0; --left) {
        cursor.text();
        if (component.type == 'O') array(1);
      }
      break;
    default:
      throw FileError("the .gwy container has a component of unknown type");
  }
  return component;
}

std::string readUnit(Cursor unit) {
  while (!unit.atEnd()) {
    Component component = readComponent(unit);
    if (component.name == "unitstr" && component.type == 's') return component.content.text();
  }
  return "";
}

/// Title and mask aside, a GwyDataField is a channel.
GwyChannel readField(Cursor field) {
  GwyChannel channel;
  std::int64_t cols = 0;
  std::int64_t rows = 0;
  Cursor data{nullptr, 0};
  std::int64_t data_count = -1;
  while (!field.atEnd()) {
    Component component = readComponent(field);
    const std::string& name = component.name;
    if (component.type == 'i') {
      if (name == "xres") cols = component.content.littleEndian<std::uint32_t>();
      if (name == "yres") rows = component.content.littleEndian<std::uint32_t>();
    } else if (component.type == 'd') {
      if (name == "xreal") channel.width = component.content.real();
      if (name == "yreal") channel.height = component.content.real();
    } else if (component.type == 'o') {
      if (name == "si_unit_xy") channel.unit_xy = readUnit(component.content);
      if (name == "si_unit_z") channel.unit_z = readUnit(component.content);
    } else if (component.type == 'D' && name == "data") {
      data = component.content;
      data_count = static_cast<std::int64_t>(data.size() / sizeof(double));
    }
  }
  constexpr std::int64_t kMaxSide = std::numeric_limits<int>::max();
  if (cols <= 0 || rows <= 0 || cols > kMaxSide || rows > kMaxSide || data_count < 0 || data_count / cols != rows ||
      data_count % cols != 0) {
    throw FileError("the .gwy container has a channel whose size does not match its data");
  }
  channel.values.create(static_cast<int>(rows), static_cast<int>(cols), CV_64FC1);
  for (int row = 0; row < channel.values.rows; ++row) {
    double* line = channel.values.ptr<double>(row);
    for (int col = 0; col < channel.values.cols; ++col) line[col] = data.real();
  }
  return channel;
}

/// N of "/N/rest"; -1 for other names.
int channelId(const std::string& name, std::string& rest) {
  if (name.size() < 3 || name[0] != '/') return -1;
  const std::size_t slash = name.find('/', 1);
  if (slash == std::string::npos || slash == 1 || slash > 8) return -1;
  const std::string digits = name.substr(1, slash - 1);
  if (digits.find_first_not_of("0123456789") != std::string::npos) return -1;
  rest = name.substr(slash + 1);
  return std::atoi(digits.c_str());
}

void invalidateMasked(GwyChannel& channel, const cv::Mat& mask) {
  if (mask.size() != channel.values.size()) {
    throw FileError("the .gwy container has a mask of another size than its channel");
  }
  for (int row = 0; row < mask.rows; ++row) {
    const double* marked = mask.ptr<double>(row);
    double* line = channel.values.ptr<double>(row);
    for (int col = 0; col < mask.cols; ++col) {
      if (marked[col] > 0.5) line[col] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace

std::vector<GwyChannel> parseGwy(const std::string& bytes) {
  Cursor file(bytes.data(), bytes.size());
  if (bytes.compare(0, 4, "GWYP") != 0) throw FileError("not a .gwy container: it does not begin with GWYP");
  file.take(4);
  if (file.text() != "GwyContainer") throw FileError("the .gwy file does not hold a GwyContainer");
  const std::uint32_t size = file.littleEndian<std::uint32_t>();
  Cursor container = file.part(size);

  std::map<int, GwyChannel> channels;
  std::map<int, std::string> titles;
  std::map<int, cv::Mat> masks;
  while (!container.atEnd()) {
    Component component = readComponent(container);
    std::string rest;
    const int id = channelId(component.name, rest);
    if (id < 0) continue;
    const bool is_field = component.type == 'o' && component.object_type == "GwyDataField";
    if (rest == "data" && is_field) channels[id] = readField(component.content);
    if (rest == "mask" && is_field) masks[id] = readField(component.content).values;
    if (rest == "data/title" && component.type == 's') titles[id] = component.content.text();
  }

  std::vector<GwyChannel> result;
  for (auto& [id, channel] : channels) {
    channel.id = id;
    channel.title = titles[id];
    if (masks.count(id) != 0) invalidateMasked(channel, masks[id]);
    result.push_back(std::move(channel));
  }
  return result;
}

std::vector<GwyChannel> readGwyFile(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path + ": cannot be opened");
  const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (stream.bad()) throw FileError(path + ": cannot be read");
  try {
    return parseGwy(bytes);
  } catch (const FileError& error) {
    throw FileError(path + ": " + error.what());
  }
}

}  // namespace mems_stiction
