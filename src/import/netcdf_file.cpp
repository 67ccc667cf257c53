#include "import/format_readers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "import/byte_cursor.hpp"
#include "import/file_bytes.hpp"
#include "import/length_unit.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {
namespace {

constexpr const char* kNetcdfFile = "the NetCDF file";
constexpr std::uint32_t kMostEntries = 100'000;
constexpr std::uint32_t kManyBytes = 0xFFFFFFFC;  // from here on the header does not say how many

enum Type { kByte = 1, kChar, kShort, kInt, kFloat, kDouble };

std::size_t sizeOf(std::uint32_t type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 4, 4, 8};
  if (type < kByte || type > kDouble)
    throw FileError("the NetCDF file has a type that is not known: damaged");
  return kSizes[type - 1];
}

double numberOf(ByteCursor& cursor, std::uint32_t type) {
  switch (type) {
    case kShort:
      return cursor.number<std::int16_t>();
    case kInt:
      return cursor.number<std::int32_t>();
    case kFloat:
      return static_cast<double>(cursor.number<float>());
    case kDouble:
      return cursor.number<double>();
    default:
      return cursor.number<std::int8_t>();
  }
}

struct Attribute {
  std::string text;     ///< of characters
  double number = 0.0;  ///< the first of numbers
};
using Attributes = std::map<std::string, Attribute>;

struct Variable {
  std::vector<std::uint32_t> dimensions;
  Attributes attributes;
  std::uint32_t type = 0;
  std::uint32_t bytes = 0;  ///< of all its numbers, filled up to a multiple of four; the largest
                            ///< number if there are more
  std::uint64_t begin = 0;
};

/// The header of the file; values are read when somebody asks for them.
class Netcdf {
 public:
  explicit Netcdf(const std::string& bytes) : bytes_(bytes) {
    ByteCursor cursor(bytes.data(), bytes.size(), kNetcdfFile, ByteOrder::kBig);
    cursor.take(3);
    const int version = cursor.number<std::uint8_t>();
    if (version != 1 && version != 2)
      throw FileError("a NetCDF file of version " + std::to_string(version) + " is not read");
    cursor.take(4);  // records
    for (std::uint32_t left = count(cursor); left > 0; --left) {
      dimension_names_.push_back(name(cursor));
      lengths_.push_back(cursor.number<std::uint32_t>());
    }
    attributes(cursor);
    for (std::uint32_t left = count(cursor); left > 0; --left) {
      const std::string variable_name = name(cursor);
      Variable variable;
      for (std::uint32_t axes = limited(cursor.number<std::uint32_t>()); axes > 0; --axes) {
        variable.dimensions.push_back(cursor.number<std::uint32_t>());
        if (variable.dimensions.back() >= lengths_.size())
          throw FileError("the NetCDF file has a damaged header");
      }
      variable.attributes = attributes(cursor);
      variable.type = cursor.number<std::uint32_t>();
      variable.bytes = cursor.number<std::uint32_t>();
      variable.begin =
          version == 1 ? cursor.number<std::uint32_t>() : cursor.number<std::uint64_t>();
      variables_[variable_name] = variable;
    }
  }

  const Variable* find(const std::string& variable) const {
    const auto found = variables_.find(variable);
    return found == variables_.end() ? nullptr : &found->second;
  }

  std::uint64_t length(const Variable& variable, std::size_t axis) const {
    return lengths_[variable.dimensions[axis]];
  }

  const std::string& dimension(const Variable& variable, std::size_t axis) const {
    return dimension_names_[variable.dimensions[axis]];
  }

  /// Its numbers, the last dimension fastest. @throw FileError if they lie beyond the end of the
  /// file
  ByteCursor data(const Variable& variable, std::uint64_t numbers) const {
    ByteCursor cursor(bytes_.data(), bytes_.size(), kNetcdfFile, ByteOrder::kBig);
    if (variable.begin > bytes_.size()) throw FileError("the NetCDF file is cut off");
    cursor.take(static_cast<std::size_t>(variable.begin));
    const std::uint64_t needed = (numbers * sizeOf(variable.type) + 3) / 4 * 4;
    if (variable.bytes != needed && variable.bytes < kManyBytes)
      throw FileError("the NetCDF file has a damaged header");
    return cursor.array(static_cast<std::size_t>(numbers), sizeOf(variable.type));
  }

 private:
  static std::uint32_t limited(std::uint32_t number) {
    if (number > kMostEntries) throw FileError("the NetCDF file has a damaged header");
    return number;
  }
  static std::uint32_t count(ByteCursor& cursor) {
    cursor.take(4);  // which list
    return limited(cursor.number<std::uint32_t>());
  }
  static std::string name(ByteCursor& cursor) {
    const std::size_t length = limited(cursor.number<std::uint32_t>());
    std::string text(cursor.take(length), length);
    cursor.take((4 - length % 4) % 4);
    return text;
  }
  static Attributes attributes(ByteCursor& cursor) {
    Attributes result;
    for (std::uint32_t left = count(cursor); left > 0; --left) {
      Attribute& attribute = result[name(cursor)];
      const auto type = cursor.number<std::uint32_t>();
      const auto elements = cursor.number<std::uint32_t>();
      ByteCursor value = cursor.array(elements, sizeOf(type));
      const std::size_t size = value.size();
      if (type == kChar) {
        attribute.text = toUtf8(value.field(size));
      } else if (elements > 0) {
        attribute.number = numberOf(value, type);
      }
      cursor.take((4 - size % 4) % 4);
    }
    return result;
  }

  const std::string& bytes_;
  std::vector<std::string> dimension_names_;
  std::vector<std::uint32_t> lengths_;
  std::map<std::string, Variable> variables_;
};

std::string textOf(const Variable& variable, const std::string& attribute) {
  const auto found = variable.attributes.find(attribute);
  return found == variable.attributes.end() ? "" : found->second.text;
}

/// Physical size along an axis in metres; 0 = not stated.
double sizeAlong(const Netcdf& file, const char* axis) {
  const Variable* variable = file.find(axis);
  if (variable == nullptr || variable->attributes.count("length") == 0) return 0.0;
  const auto unit = lengthUnit(textOf(*variable, "unit"));
  return unit ? variable->attributes.at("length").number * *unit : 0.0;
}

/// A variable that is one number in metres, which GXSM keeps in Angstrom; none if the file has no
/// such variable.
std::optional<double> gxsmLength(const Netcdf& file, const char* name) {
  const Variable* variable = file.find(name);
  if (variable == nullptr || !variable->dimensions.empty()) return std::nullopt;
  ByteCursor data = file.data(*variable, 1);
  return std::abs(numberOf(data, variable->type)) *
         lengthUnit(textOf(*variable, "var_unit")).value_or(1e-10);
}

/// [m]; 0 = not stated
double gxsmPitch(const Netcdf& file, const char* step_name, const char* range_name,
                 std::uint64_t pixels) {
  const auto step = gxsmLength(file, step_name);
  const auto range = gxsmLength(file, range_name);
  const double steps = static_cast<double>(pixels) - 1.0;
  if (!(steps > 0.0)) return 0.0;
  if (step && range && std::abs(*range - *step * steps) > 0.01 * *range) {
    throw FileError("the NetCDF file contradicts itself: " + std::string(step_name) + " " +
                    numberText(*step) + " m, " + range_name + " " + numberText(*range) + " m, " +
                    std::to_string(pixels) + " pixels");
  }
  return step ? *step : range.value_or(0.0) / steps;
}

}  // namespace

std::optional<FileChannel> parseNetcdfHeights(const std::string& bytes) {
  const Netcdf file(bytes);
  const Variable* heights = file.find("heights");
  if (heights == nullptr) return std::nullopt;
  if (heights->dimensions.size() != 2 || file.dimension(*heights, 0) != "x" ||
      file.dimension(*heights, 1) != "y") {
    throw FileError("the variable 'heights' of the NetCDF file is no surface over x and y");
  }
  const std::uint64_t cols = file.length(*heights, 0);
  const std::uint64_t rows = file.length(*heights, 1);
  checkPixelCount(cols, rows);
  FileChannel channel;
  channel.takes_settings = true;
  channel.title = "heights";
  channel.width = sizeAlong(file, "x");
  channel.height = sizeAlong(file, "y");
  if (channel.width > 0.0 && channel.height > 0.0) channel.unit_xy = "m";
  // Where heights state no unit it is that of x and y.
  std::string unit_text = textOf(*heights, "unit");
  if (unit_text.empty() && file.find("x") != nullptr) unit_text = textOf(*file.find("x"), "unit");
  const auto unit = heightUnit(unit_text);
  channel.unit_z = unit ? "m" : unit_text;

  channel.values.create(static_cast<int>(rows), static_cast<int>(cols), CV_64FC1);
  ByteCursor data = file.data(*heights, cols * rows);
  const Variable* mask = file.find("mask");
  ByteCursor masked = mask == nullptr ? data : file.data(*mask, cols * rows);
  for (int col = 0; col < channel.values.cols; ++col) {
    for (int row = 0; row < channel.values.rows; ++row) {
      const double value = numberOf(data, heights->type) * unit.value_or(1.0);
      const bool is_missing = mask != nullptr && numberOf(masked, mask->type) != 0.0;
      channel.values.at<double>(row, col) =
          is_missing ? std::numeric_limits<double>::quiet_NaN() : value;
    }
  }
  return channel;
}

GxsmStatements gxsmStatements(const std::string& bytes) {
  const Netcdf file(bytes);
  GxsmStatements stated;
  for (const char* name : {"FloatField", "DoubleField", "H", "rangez", "dz"}) {
    const Variable* variable = file.find(name);
    if (variable == nullptr) continue;
    if (variable->dimensions.size() == 4) {
      stated.pitch_y = gxsmPitch(file, "dy", "rangey", file.length(*variable, 2));
      stated.pitch_x = gxsmPitch(file, "dx", "rangex", file.length(*variable, 3));
    }
    for (const char* attribute : {"unit", "units", "var_unit", "var_units", "ZSrcUnit"}) {
      const std::string unit = textOf(*variable, attribute);
      if (stated.other_unit.empty() && !unit.empty() && unit != "1" && !heightUnit(unit))
        stated.other_unit = unit;
    }
  }
  return stated;
}

}  // namespace mems_stiction
