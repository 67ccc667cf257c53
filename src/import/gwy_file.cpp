#include "import/format_readers.hpp"

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>

#include "height_map/validity.hpp"
#include "import/byte_cursor.hpp"
#include "import/file_bytes.hpp"
#include "import/file_statements.hpp"
#include "import/length_unit.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr const char* kGwyContainer = "the .gwy container";

/// One component: its content is not read until somebody asks for it.
struct Component {
  std::string name;
  char type = '\0';
  std::string object_type;  ///< class name, for type 'o'
  ByteCursor content{nullptr, 0, kGwyContainer};
};

Component readComponent(ByteCursor& cursor) {
  Component component;
  component.name = cursor.text();
  component.type = *cursor.take(1);
  const auto array = [&cursor](std::size_t item_size) {
    const std::uint32_t count = cursor.number<std::uint32_t>();
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
      ByteCursor start = cursor;
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
      for (std::uint32_t left = cursor.number<std::uint32_t>(); left > 0; --left) {
        cursor.text();
        if (component.type == 'O') array(1);
      }
      break;
    default:
      throw FileError("the .gwy container has a component of unknown type");
  }
  return component;
}

std::string readUnit(ByteCursor unit) {
  while (!unit.atEnd()) {
    Component component = readComponent(unit);
    if (component.name == "unitstr" && component.type == 's') return component.content.text();
  }
  return "";
}

/// Gwyddion writes metres; other programs that write .gwy also um and nm. In Gwyddion's units A is
/// the ampere.
void toMetres(FileChannel& channel) {
  const auto unit_xy = heightUnit(channel.unit_xy);
  const auto unit_z = heightUnit(channel.unit_z);
  if (unit_xy) {
    channel.unit_xy = "m";
    channel.width *= *unit_xy;
    channel.height *= *unit_xy;
  }
  if (unit_z) {
    channel.unit_z = "m";
    if (*unit_z != 1.0) channel.values *= *unit_z;
  }
}

/// Title and mask aside, a GwyDataField is a channel.
FileChannel readField(ByteCursor field) {
  FileChannel channel;
  std::int64_t cols = 0;
  std::int64_t rows = 0;
  ByteCursor data{nullptr, 0, kGwyContainer};
  std::int64_t data_count = -1;
  while (!field.atEnd()) {
    Component component = readComponent(field);
    const std::string& name = component.name;
    if (component.type == 'i') {
      if (name == "xres") cols = component.content.number<std::uint32_t>();
      if (name == "yres") rows = component.content.number<std::uint32_t>();
    } else if (component.type == 'd') {
      if (name == "xreal") channel.width = component.content.number<double>();
      if (name == "yreal") channel.height = component.content.number<double>();
    } else if (component.type == 'o') {
      if (name == "si_unit_xy") channel.unit_xy = readUnit(component.content);
      if (name == "si_unit_z") channel.unit_z = readUnit(component.content);
    } else if (component.type == 'D' && name == "data") {
      data = component.content;
      data_count = static_cast<std::int64_t>(data.size() / sizeof(double));
    }
  }
  constexpr std::int64_t kMaxSide = std::numeric_limits<int>::max();
  if (cols <= 0 || rows <= 0 || cols > kMaxSide || rows > kMaxSide || data_count < 0 ||
      data_count / cols != rows || data_count % cols != 0) {
    throw FileError("the .gwy container has a channel whose size does not match its data");
  }
  checkPixelCount(static_cast<std::uint64_t>(cols), static_cast<std::uint64_t>(rows));
  channel.values.create(static_cast<int>(rows), static_cast<int>(cols), CV_64FC1);
  for (int row = 0; row < channel.values.rows; ++row) {
    double* line = channel.values.ptr<double>(row);
    for (int col = 0; col < channel.values.cols; ++col) line[col] = data.number<double>();
  }
  toMetres(channel);
  return channel;
}

/// What the maker of the file, or Gwyddion's user, has noted of a channel.
FileStatements readMeta(ByteCursor meta) {
  FileStatements statements;
  while (!meta.atEnd()) {
    Component component = readComponent(meta);
    if (component.type == 's') statements[component.name] = component.content.text();
  }
  return statements;
}

/// N of "/N/rest"; -1 for other names.
int channelId(const std::string& name, std::string& rest) {
  if (name.size() < 3 || name[0] != '/') return -1;
  const std::size_t slash = name.find('/', 1);
  if (slash == std::string::npos || slash == 1 || slash > 8) return -1;
  const std::string digits = name.substr(1, slash - 1);
  if (digits.find_first_not_of("0123456789") != std::string::npos) return -1;
  rest = name.substr(slash + 1);
  return static_cast<int>(std::strtol(digits.c_str(), nullptr, 10));
}

/// @return how many pixels that had a height have none now
int invalidateMasked(FileChannel& channel, const cv::Mat& mask) {
  if (mask.size() != channel.values.size()) {
    throw FileError("the .gwy container has a mask of another size than its channel");
  }
  const cv::Mat marked = mask > 0.5;
  const int count = cv::countNonZero(marked & validMask(channel.values));
  channel.values.setTo(std::numeric_limits<double>::quiet_NaN(), marked);
  return count;
}

}  // namespace

std::vector<FileChannel> parseGwy(const std::string& bytes, bool ignore_mask) {
  ByteCursor file(bytes.data(), bytes.size(), kGwyContainer);
  if (!startsWith(bytes, "GWYP"))
    throw FileError("not a .gwy container: it does not begin with GWYP");
  file.take(4);
  if (file.text() != "GwyContainer") throw FileError("the .gwy file does not hold a GwyContainer");
  const std::uint32_t size = file.number<std::uint32_t>();
  ByteCursor container = file.part(size);

  std::map<int, FileChannel> channels;
  std::map<int, std::string> titles;
  std::map<int, cv::Mat> masks;
  std::map<int, ScanIdentity> identities;
  while (!container.atEnd()) {
    Component component = readComponent(container);
    std::string rest;
    const int id = channelId(component.name, rest);
    if (id < 0) continue;
    const bool is_field = component.type == 'o' && component.object_type == "GwyDataField";
    if (rest == "data" && is_field) channels[id] = readField(component.content);
    if (rest == "mask" && is_field) masks[id] = readField(component.content).values;
    const bool is_container = component.type == 'o' && component.object_type == "GwyContainer";
    if (rest == "meta" && is_container) identities[id] = identityFrom(readMeta(component.content));
    if (rest == "data/title" && component.type == 's') titles[id] = component.content.text();
  }

  std::vector<FileChannel> result;
  for (auto& [id, channel] : channels) {
    channel.id = id;
    channel.title = titles[id];
    channel.identity = identities[id];
    const int masked =
        masks.count(id) == 0 || ignore_mask ? 0 : invalidateMasked(channel, masks[id]);
    if (masked > 0) {
      channel.notes.push_back(
          std::to_string(masked) +
          " pixels under the mask of the channel count as missing (--ignore-mask keeps them)");
    }
    result.push_back(std::move(channel));
  }
  return result;
}

}  // namespace mems_stiction
