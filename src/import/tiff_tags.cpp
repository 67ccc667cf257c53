#include "import/tiff_tags.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "import/byte_cursor.hpp"
#include "import/length_unit.hpp"
#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr std::uint16_t kParkTag = 50432;
constexpr std::uint32_t kParkMagic = 0x0E031301;
constexpr std::uint16_t kJpkFileVersion = 32768;
constexpr std::uint16_t kJpkProgramVersion = 32769;
constexpr std::uint16_t kDescription = 270;
constexpr const char* kLextDescription = "TiffTagDescData";
constexpr std::size_t kDescriptionStart = 400;  // the XML begins with its declaration
constexpr std::uint16_t kBigVersion = 43;

ByteCursor startOf(const std::string& bytes) {
  const ByteOrder order = !bytes.empty() && bytes[0] == 'M' ? ByteOrder::kBig : ByteOrder::kLittle;
  return {bytes.data(), bytes.size(), "the list of its pages", order};
}

/// "VALUE" of "key=VALUE" on a line of its own; empty if there is none.
std::string lineValue(const std::string& text, const std::string& key) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    if (text.compare(at, key.size() + 1, key + "=") == 0)
      return text.substr(at + key.size() + 1, end - at - key.size() - 1);
    at = end + 1;
  }
  return "";
}

/// VALUE of key="VALUE" in XML; empty if there is none.
std::string attribute(const std::string& xml, const std::string& key) {
  for (const char quote : {'"', '\''}) {
    const std::string start = " " + key + "=" + quote;
    const std::size_t at = xml.find(start);
    if (at == std::string::npos) continue;
    const std::size_t begin = at + start.size();
    const std::size_t end = xml.find(quote, begin);
    if (end != std::string::npos) return xml.substr(begin, end - begin);
  }
  return "";
}

double number(const std::string& text, const std::string& key) {
  try {
    return plainNumber(text);
  } catch (const FileError& error) {
    throw FileError(key + ": " + error.what());
  }
}

void setPitch(FileChannel& channel, double pitch_x, double pitch_y) {
  channel.width = pitch_x * channel.values.cols;
  channel.height = pitch_y * channel.values.rows;
  channel.unit_xy = "m";
}

/// height = offset + scale x value, in doubles.
void scaleValues(FileChannel& channel, double scale, double offset) {
  channel.values.convertTo(channel.values, CV_64F, scale, offset);
}

void applyImageJ(const TiffNotes& notes, int pages, FileChannel& channel) {
  const std::string& text = notes.description;
  const std::string images = lineValue(text, "images");
  if (!images.empty() && number(images, "images") > pages) {
    throw FileError("ImageJ wrote a stack of " + images +
                    " images: save the one that is a scan by itself");
  }
  const std::string own_of_y = lineValue(text, "yunit");  // where y has another than x
  const auto unit = lengthUnit(lineValue(text, "unit"));
  const auto unit_of_y = own_of_y.empty() ? unit : lengthUnit(own_of_y);
  if (unit && unit_of_y && notes.resolution_x > 0.0 && notes.resolution_y > 0.0) {
    setPitch(channel, *unit / notes.resolution_x, *unit_of_y / notes.resolution_y);
  }
  const std::string value_unit = lineValue(text, "vunit");
  const std::string function = lineValue(text, "cf");
  if (function.empty()) return;
  if (number(function, "cf") != 0.0)
    throw FileError("ImageJ's calibration function of the values is no straight line");
  scaleValues(channel, number(lineValue(text, "c1"), "c1"), number(lineValue(text, "c0"), "c0"));
  const auto height_unit = heightUnit(value_unit);
  if (value_unit.empty() || value_unit == "Gray Value") return;
  channel.unit_z = height_unit ? "m" : value_unit;
  if (height_unit) channel.values *= *height_unit;
}

void applyOme(const std::string& xml, FileChannel& channel) {
  std::array<double, 2> pitch{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::string key = axis == 0 ? "PhysicalSizeX" : "PhysicalSizeY";
    const std::string value = attribute(xml, key);
    if (value.empty()) return;
    const std::string unit_text = attribute(xml, key + "Unit");
    const auto unit = unit_text.empty() ? std::optional<double>(1e-6) : lengthUnit(unit_text);
    if (!unit) return;  // "pixel": no scale
    pitch[axis] = number(value, key) * *unit;
  }
  setPitch(channel, pitch[0], pitch[1]);
}

/// <Item name="SCALE" sample="0" role="scale">0.01</Item>
double gdalItem(const std::string& xml, const std::string& role, double otherwise) {
  const std::size_t at = xml.find("role=\"" + role + "\"");
  const std::size_t begin = at == std::string::npos ? at : xml.find('>', at);
  if (begin == std::string::npos) return otherwise;
  return number(xml.substr(begin + 1, xml.find('<', begin) - begin - 1), "GDAL's " + role);
}

void applyGdal(const TiffNotes& notes, FileChannel& channel) {
  if (!notes.gdal_missing.empty()) {
    const double missing = number(notes.gdal_missing, "GDAL_NODATA");
    const bool is_single = channel.values.depth() == CV_32F;
    channel.values.convertTo(channel.values, CV_64F);
    const double nearest = is_single ? static_cast<double>(static_cast<float>(missing)) : missing;
    const double none = std::numeric_limits<double>::quiet_NaN();
    channel.values.setTo(none, (channel.values == missing) | (channel.values == nearest));
  }
  const double scale = gdalItem(notes.gdal_metadata, "scale", 1.0);
  const double offset = gdalItem(notes.gdal_metadata, "offset", 0.0);
  if (scale != 1.0 || offset != 0.0) {
    scaleValues(channel, scale, offset);
    channel.notes.push_back("GDAL's scale " + numberText(scale) + " and offset " +
                            numberText(offset) + " are applied");
  }
}

/// Printers, scanners and screens: what programs write when nobody said a resolution.
bool isPrintResolution(double per_metre) {
  const double per_inch = per_metre * 0.0254;
  return per_inch < 2500.0 && std::abs(per_inch - std::round(per_inch)) < 0.02;
}

}  // namespace

int pageCount(const std::string& bytes, int most) {
  ByteCursor start = startOf(bytes);
  start.take(2);
  const bool is_big = start.number<std::uint16_t>() == kBigVersion;
  if (is_big) start.take(4);
  const auto offset = [is_big](ByteCursor& cursor) {
    return is_big ? cursor.number<std::uint64_t>() : std::uint64_t{cursor.number<std::uint32_t>()};
  };
  int pages = 0;
  for (std::uint64_t next = offset(start); next != 0 && pages < most; ++pages) {
    ByteCursor page = startOf(bytes);
    page.take(static_cast<std::size_t>(next));
    const std::uint64_t entries =
        is_big ? page.number<std::uint64_t>() : page.number<std::uint16_t>();
    page.array(static_cast<std::size_t>(entries), is_big ? 20 : 12);
    next = offset(page);
  }
  return pages;
}

bool hasInstrumentTags(const std::string& bytes) {
  try {
    ByteCursor cursor = startOf(bytes);
    cursor.take(4);
    const auto directory = cursor.number<std::uint32_t>();
    if (directory < 8) return false;
    cursor.take(directory - 8);
    bool has_file_version = false;
    for (auto left = cursor.number<std::uint16_t>(); left > 0; --left) {
      const auto tag = cursor.number<std::uint16_t>();
      cursor.take(6);  // type and count
      const auto value = cursor.number<std::uint32_t>();
      if (tag == kParkTag && value == kParkMagic) return true;
      if (tag == kJpkFileVersion) has_file_version = true;
      if (tag == kJpkProgramVersion && has_file_version) return true;
      if (tag == kDescription && value < bytes.size() &&
          bytes.substr(value, kDescriptionStart).find(kLextDescription) != std::string::npos) {
        return true;
      }
    }
  } catch (const FileError&) {
    // Cut off: no such tags before the cut.
  }
  return false;
}

void applyTiffNotes(const TiffNotes& notes, int pages, FileChannel& channel) {
  if (channel.values.channels() != 1) return;
  applyGdal(notes, channel);
  if (startsWith(notes.description, "ImageJ")) {
    applyImageJ(notes, pages, channel);
  } else if (notes.description.find("<OME") != std::string::npos) {
    applyOme(notes.description, channel);
  }
  if (channel.width > 0.0 || notes.resolution_unit == 0.0 || !(notes.resolution_x > 0.0) ||
      !(notes.resolution_y > 0.0)) {
    return;
  }
  if (isPrintResolution(notes.resolution_x / notes.resolution_unit)) return;
  setPitch(channel, notes.resolution_unit / notes.resolution_x,
           notes.resolution_unit / notes.resolution_y);
  channel.is_pitch_a_guess = true;
}

}  // namespace mems_stiction
