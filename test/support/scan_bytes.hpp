#pragma once

/// Small scan files of each format that is read here, byte by byte from the formats' definitions.

#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "support/binary_writer.hpp"

namespace mems_stiction::scan_bytes {

// ---- PNG, chunk by chunk

inline std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto checksum = static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size())));
  return bigBytes(static_cast<std::uint32_t>(data.size())) + body + bigBytes(checksum);
}

inline std::string png(std::uint32_t cols, std::uint32_t rows, int bits, const std::string& lines) {
  std::string packed(lines.size() + 100, '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(lines.data()), lines.size());
  packed.resize(size);
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR",
               bigBytes(cols) + bigBytes(rows) + static_cast<char>(bits) + std::string(4, '\0')) +
         chunk("IDAT", packed) + chunk("IEND", "");
}

// ---- OpenEXR

/// One line a block, no compression, float32 channels.
inline std::string exr(const std::vector<std::string>& channels, std::int32_t cols,
                       std::int32_t rows) {
  const auto attribute = [](const std::string& name, const std::string& type,
                            const std::string& value) {
    return name + '\0' + type + '\0' + littleBytes(static_cast<std::int32_t>(value.size())) + value;
  };
  std::string list;
  for (const std::string& channel : channels) {
    list += channel + '\0' + littleBytes(std::int32_t{2}) + std::string(4, '\0') +
            littleBytes(std::int32_t{1}) + littleBytes(std::int32_t{1});
  }
  const std::string window = std::string(8, '\0') + littleBytes(cols - 1) + littleBytes(rows - 1);
  std::string bytes = "\x76\x2f\x31\x01" + littleBytes(std::int32_t{2}) +
                      attribute("channels", "chlist", list + '\0') +
                      attribute("compression", "compression", std::string(1, '\0')) +
                      attribute("dataWindow", "box2i", window) +
                      attribute("displayWindow", "box2i", window) +
                      attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
                      attribute("pixelAspectRatio", "float", littleBytes(1.0F)) +
                      attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
                      attribute("screenWindowWidth", "float", littleBytes(1.0F)) + '\0';
  const auto line_size = static_cast<std::int32_t>(4 * static_cast<int>(channels.size()) * cols);
  std::uint64_t offset = bytes.size() + 8 * static_cast<std::uint64_t>(rows);
  for (std::int32_t row = 0; row < rows; ++row, offset += 8 + static_cast<std::uint64_t>(line_size))
    bytes += littleBytes(offset);
  for (std::int32_t row = 0; row < rows; ++row) {
    bytes += littleBytes(row) + littleBytes(line_size);
    for (std::size_t channel = 0; channel < channels.size(); ++channel) {
      for (std::int32_t col = 0; col < cols; ++col)
        bytes += littleBytes(static_cast<float>(10 * row + col));
    }
  }
  return bytes;
}

// ---- WSxM

inline std::string wsxm(const std::string& type, const std::string& size,
                        const std::string& amplitude, const std::string& data) {
  const std::string rest =
      "[Control]\r\n    X Amplitude: " + size + "\r\n    Y Amplitude: " + size +
      "\r\n[General Info]\r\n    Image Data Type: " + type +
      "\r\n    Number of columns: 3\r\n    Number of rows: 2\r\n    Z Amplitude: " + amplitude +
      "\r\n[Header end]\r\n";
  const std::string start = "WSxM file copyright UAM\r\nSxM Image file\r\nImage header size: ";
  return start + std::to_string(start.size() + 5 + rest.size()) + "\r\n" + rest + data;
}

inline std::string wsxmDoubles() {
  std::string data;
  for (int i = 0; i < 6; ++i) data += littleBytes(static_cast<double>(i));
  return data;
}

// ---- Digital Surf

struct Sur {
  int special = 1, inversion = 0;
  bool is_compressed = false;
  std::string unit_z = "nm";
  std::string operator_name = "";
  std::vector<std::int16_t> date = {0, 0, 0, 0, 0, 0};  ///< second, minute, hour, day, month, year
};

/// 3 x 2 heights of 10 to 50 with step 0.5, one not measured (8 = 10 - 2).
inline std::string sur(const Sur& kind) {
  std::string data;
  for (const int value : {10, 20, 8, 30, 40, 50})
    data += littleBytes(static_cast<std::int32_t>(value));
  std::string packed(100, '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(data.data()), data.size());
  packed.resize(size);
  std::string header =
      std::string(kind.is_compressed ? "DSCOMPRESSED" : "DIGITAL SURF") +
      littleBytes(std::int16_t{0}) + littleBytes(std::int16_t{1}) + littleBytes(std::int16_t{1}) +
      littleBytes(std::int16_t{2}) + std::string(30, '\0') + field(kind.operator_name, 30) +
      std::string(6, '\0') + littleBytes(static_cast<std::int16_t>(kind.special)) +
      std::string(10, '\0') + littleBytes(std::int16_t{32}) + littleBytes(std::int32_t{10}) +
      littleBytes(std::int32_t{50}) + littleBytes(std::int32_t{3}) + littleBytes(std::int32_t{2}) +
      littleBytes(std::int32_t{6}) + littleBytes(0.25F) + littleBytes(0.5F) + littleBytes(0.5F) +
      std::string(32, ' ') + field("Topography", 16, ' ') + field("\xE6m", 16, ' ') +
      field("\xB5m", 16, ' ') + field(kind.unit_z, 16, ' ') +
      std::string(3 * 16 + 3 * 4 + 2, '\0') +
      littleBytes(static_cast<std::int16_t>(kind.inversion));
  header = field(header, 306);
  for (const std::int16_t number : kind.date) header += littleBytes(number);
  header = field(header, 334) + littleBytes(std::int16_t{7}) + littleBytes(std::int16_t{0});
  header = field(header, 512) + "comment";
  if (!kind.is_compressed) return header + data;
  return header + littleBytes(std::int32_t{1}) +
         littleBytes(static_cast<std::int32_t>(data.size())) +
         littleBytes(static_cast<std::int32_t>(packed.size())) + packed;
}

// ---- x3p

/// An archive of stored files: names and contents.
inline std::string zip(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string bytes;
  std::string list;
  for (const auto& [name, content] : files) {
    const auto sum = static_cast<std::uint32_t>(crc32(
        0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())));
    const auto size = static_cast<std::uint32_t>(content.size());
    const std::string entry = littleBytes(std::uint16_t{20}) + std::string(8, '\0') +
                              littleBytes(sum) + littleBytes(size) + littleBytes(size) +
                              littleBytes(static_cast<std::uint16_t>(name.size())) +
                              std::string(2, '\0');
    list += "PK\1\2" + littleBytes(std::uint16_t{20}) + entry + std::string(10, '\0') +
            littleBytes(static_cast<std::uint32_t>(bytes.size())) + name;
    bytes += "PK\3\4" + entry + name + content;
  }
  const auto count = static_cast<std::uint16_t>(files.size());
  return bytes + list + "PK\5\6" + std::string(4, '\0') + littleBytes(count) + littleBytes(count) +
         littleBytes(static_cast<std::uint32_t>(list.size())) +
         littleBytes(static_cast<std::uint32_t>(bytes.size())) + std::string(2, '\0');
}

/// ISO 25178-72: 3 x 2 heights, and who measured them.
inline std::string x3p() {
  std::string data;
  for (const double height : {1e-9, 2e-9, 3e-9, 4e-9, 5e-9, 6e-9}) data += littleBytes(height);
  const auto axis = [](const char* name, const char* kind, const char* type) {
    return std::string("<") + name + "><AxisType>" + kind + "</AxisType><DataType>" + type +
           "</DataType><Increment>1e-8</Increment><Offset>0</Offset></" + name + ">";
  };
  const std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>"
      "<p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\"><Record1><Revision>ISO5436 - "
      "2000</Revision>"
      "<FeatureType>SUR</FeatureType><Axes>" +
      axis("CX", "I", "L") + axis("CY", "I", "L") + axis("CZ", "A", "D") +
      "</Axes></Record1><Record2><Date>2026-03-01T14:05:00+01:00</Date><Creator>A. "
      "Worker</Creator><Instrument>"
      "<Manufacturer>Maker</Manufacturer><Model>Two</Model><Serial>0012</Serial><Version>1</"
      "Version></Instrument>"
      "<CalibrationDate>2025-03-01T14:05:00+01:00</CalibrationDate></"
      "Record2><Record3><MatrixDimension>"
      "<SizeX>3</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ></"
      "MatrixDimension><DataLink><PointDataLink>bindata/data.bin"
      "</PointDataLink></DataLink></Record3></p:ISO5436_2>";
  return zip({{"main.xml", xml}, {"bindata/data.bin", data}});
}

// ---- NetCDF

inline std::string ncName(const std::string& name) {
  return bigBytes(static_cast<std::uint32_t>(name.size())) + field(name, (name.size() + 3) / 4 * 4);
}

inline std::string ncText(const std::string& name, const std::string& text) {
  return ncName(name) + bigBytes(std::uint32_t{2}) + ncName(text);
}

inline std::string ncNumber(const std::string& name, double number) {
  return ncName(name) + bigBytes(std::uint32_t{6}) + bigBytes(std::uint32_t{1}) + bigBytes(number);
}

inline std::string ncList(std::uint32_t tag, const std::vector<std::string>& entries) {
  std::string text =
      bigBytes(entries.empty() ? 0u : tag) + bigBytes(static_cast<std::uint32_t>(entries.size()));
  for (const std::string& entry : entries) text += entry;
  return text;
}

struct NcVariable {
  std::string name;
  std::vector<std::uint32_t> dimensions;
  std::vector<std::string> attributes;
  std::string data;  ///< doubles
};

inline std::string netcdf(const std::vector<std::pair<std::string, std::uint32_t>>& dimensions,
                          const std::vector<NcVariable>& variables) {
  std::vector<std::string> dimension_entries;
  for (const auto& [name, length] : dimensions)
    dimension_entries.push_back(ncName(name) + bigBytes(length));
  const auto header = [&](std::size_t data_begin) {
    std::vector<std::string> entries;
    for (const NcVariable& variable : variables) {
      std::string axes = bigBytes(static_cast<std::uint32_t>(variable.dimensions.size()));
      for (const std::uint32_t axis : variable.dimensions) axes += bigBytes(axis);
      entries.push_back(ncName(variable.name) + axes + ncList(12, variable.attributes) +
                        bigBytes(std::uint32_t{6}) +
                        bigBytes(static_cast<std::uint32_t>(variable.data.size())) +
                        bigBytes(static_cast<std::uint32_t>(data_begin)));
      data_begin += variable.data.size();
    }
    return std::string("CDF\1", 4) + bigBytes(std::uint32_t{0}) + ncList(10, dimension_entries) +
           ncList(12, {}) + ncList(11, entries);
  };
  std::string bytes = header(header(0).size());
  for (const NcVariable& variable : variables) bytes += variable.data;
  return bytes;
}

inline std::string bigDoubles(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += bigBytes(number);
  return text;
}

inline std::string heights(const std::string& unit) {
  return netcdf({{"x", 3}, {"y", 2}},
                {{"x", {0}, {ncNumber("length", 3.0), ncText("unit", unit)}, bigDoubles({0, 1, 2})},
                 {"y", {1}, {ncNumber("length", 4.0), ncText("unit", unit)}, bigDoubles({0, 2})},
                 {"heights", {0, 1}, {ncText("unit", unit)}, bigDoubles({0, 1, 10, 11, 20, 21})}});
}

// ---- NumPy

inline std::string npy(const std::string& type, const std::string& data,
                       const std::string& shape = "(2, 3)", bool fortran = false) {
  std::string header = "{'descr': '" + type +
                       "', 'fortran_order': " + (fortran ? "True" : "False") +
                       ", 'shape': " + shape + ", }";
  header = field(header, 117, ' ') + "\n";
  return std::string("\x93NUMPY\1\0", 8) + littleBytes(static_cast<std::uint16_t>(header.size())) +
         header + data;
}

// ---- Gwyddion Simple Field and TrueMap

/// 2 x 2 heights, the first of them missing if so told.
inline std::string gsf(const std::string& units, bool has_missing = false) {
  std::string bytes =
      "Gwyddion Simple Field 1.0\nXRes = 2\nYRes = 2\nXReal = 4.0e-6\nYReal = 2.0e-6\n" + units;
  bytes.resize((bytes.size() / 4 + 1) * 4, '\0');
  for (const float height : {has_missing ? std::nanf("") : 1e-9F, 2e-9F, 3e-9F, 5e-9F})
    bytes += littleBytes(height);
  return bytes;
}

inline std::string tmd(const std::string& comment, float width = 4.0F) {
  std::string bytes = std::string("Binary TrueMap Data File v2.0\r\n\0", 32) + comment + '\0';
  for (int side = 0; side < 2; ++side) bytes += littleBytes(std::uint32_t{2});
  for (const float length : {width, 2.0F, 0.0F, 0.0F}) bytes += littleBytes(length);
  for (const float height : {0.001F, 0.002F, 0.003F, 0.005F}) bytes += littleBytes(height);
  return bytes;
}

}  // namespace mems_stiction::scan_bytes
