#pragma once

/// Small files of instrument makers, by the definitions of their formats: what their headers state
/// of their length.

#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

#include "support/binary_writer.hpp"

namespace mems_stiction::maker_bytes {

/// Bytes that are no text: every value in turn, none of them a line end behind a carriage return
/// only.
inline std::string noise(std::size_t count) {
  std::string bytes;
  std::uint32_t state = 1;
  for (std::size_t i = 0; i < count; ++i) {
    state = state * 1664525u + 1013904223u;
    bytes += static_cast<char>(state >> 24);
  }
  return bytes;
}

// ---- NanoScope

struct NanoscopeImage {
  int cols = 8, rows = 8, bytes_each = 2;
  std::string size = "1 1 ~m";
  std::string data = noise(8 * 8 * 2);
};

inline std::string nanoscope(const std::vector<NanoscopeImage>& images,
                             const std::string& scan_size = "1000 nm") {
  constexpr std::size_t kHeader = 4096;
  std::string header =
      "\\*File list\r\n\\Version: 0x07200000\r\n\\Data length: " + std::to_string(kHeader) +
      "\r\n\\*Scanner list\r\n\\@Sens. Zsens: V 10.00000 nm/V\r\n\\*Ciao scan list\r\n\\Scan "
      "Size: " +
      scan_size +
      "\r\n\\Samps/line: 8\r\n\\Lines: 8\r\n\\Aspect Ratio: 1:1\r\n"
      "\\@1:ZLimit: V [Sens. Zsens] (0.006713867 V/LSB) 100.0000 V\r\n";
  std::string data;
  for (const NanoscopeImage& image : images) {
    header += "\\*Ciao image list\r\n\\Data offset: " + std::to_string(kHeader + data.size()) +
              "\r\n\\Data length: " + std::to_string(image.data.size()) +
              "\r\n\\Bytes/pixel: " + std::to_string(image.bytes_each) +
              "\r\n\\Samps/line: " + std::to_string(image.cols) +
              "\r\n\\Number of lines: " + std::to_string(image.rows) +
              "\r\n\\Aspect Ratio: 1:1\r\n\\Scan Size: " + image.size +
              "\r\n\\@2:Z scale: V [Sens. Zsens] (0.0003750000 V/LSB) 24.57563 V\r\n\\@2:Image "
              "Data: S [Height] "
              "\"Height\"\r\n";
    data += image.data;
  }
  return field(header + "\\*File list end\r\n\x1a", kHeader) + data;
}

// ---- others

inline std::string metroPro() {
  std::string header = bigBytes(std::uint32_t{0x881B036F}) + bigBytes(std::uint16_t{1}) +
                       bigBytes(std::uint32_t{834});
  header = field(header, 52) + bigBytes(std::uint16_t{3}) + bigBytes(std::uint16_t{2}) +
           bigBytes(std::uint16_t{1}) + std::string(10, '\0') + bigBytes(std::uint16_t{4}) +
           bigBytes(std::uint16_t{5});
  return field(header, 834) + noise(2 * 3 * 2 + 4 * 4 * 5);
}

inline std::string alicona() {
  const auto tag = [](const std::string& key, const std::string& value) {
    return field(key, 20) + field(value, 30) + "\r\n";
  };
  std::string header = field("AliconaImaging", 15) + "\r\n";
  header += tag("Version", "1") + tag("TagCount", "5") + tag("Cols", "3") + tag("Rows", "4") +
            tag("DepthImageOffset", "1024") + tag("TextureImageOffset", "1088") +
            tag("NumberOfPlanes", "4");
  return field(header, 1024) + noise(4 * 16 + 4 * 4 * 8);
}

inline std::string agilent(const std::string& type, std::size_t bytes_each) {
  const std::string header =
      "fileType      Image\nxPixels       3\nyPixels       4\nbufferLabel   "
      "Topography\nbufferLabel   Friction\n";
  return header + "data          " + type + "\n" + noise(2 * 3 * 4 * bytes_each);
}

inline std::string aarhus() {
  const std::string index = littleBytes(std::int16_t{1}) + littleBytes(std::int32_t{3}) +
                            littleBytes(std::int16_t{0}) + littleBytes(std::int32_t{6});
  const std::string label = littleBytes(std::int16_t{1}) + littleBytes(std::int16_t{3}) +
                            littleBytes(std::int16_t{10}) + littleBytes(std::int16_t{12});
  return field(index, 384) + field(label, 128) + field(noise(240), 256);
}

inline std::string createc(const std::string& kind) {
  const std::string header =
      kind + "\r\nNum.X / Num.X=3\r\nNum.Y / Num.Y=4\r\nChannels / Channels=2\r\n";
  if (kind == "[Parameter]") return field(header, 16384) + noise(2 + 2 * 3 * 4 * 2);
  const std::string data = noise(4 + 4 * 3 * 4 * 2);
  if (kind == "[Paramet32]") return field(header, 16384) + data;
  const std::string filled = data + std::string(8188, '\0');
  std::string packed(1000, '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(filled.data()), filled.size());
  return field(header, 16384) + packed.substr(0, size);
}

inline std::string surfstand() {
  return "aISO-1.0\nNumPoints = 3\nNumProfiles = 2\nXscale = 1.0E-6\nYscale = 1.0E-6\nZscale = "
         "1.0E-6\n*\n1.0 2.0 "
         "3.5\n4.25 5.0 6.125\n";
}

inline std::string matrix() {
  const std::string description = "CSED" + littleBytes(std::uint32_t{28}) + std::string(20, '\0') +
                                  littleBytes(std::uint32_t{12}) + littleBytes(std::uint32_t{6});
  return "ONTMATRX0101TLKB" + littleBytes(std::uint32_t{80}) + std::string(12, '\0') + description +
         "ATAD" + littleBytes(std::uint32_t{24}) + noise(24);
}

inline std::string nanosurf() {
  const std::string image = "]\r\nPoints=3\r\nLines=4\r\nSaveBits=16\r\n";
  return "[DataSet]\r\nGroupCount=1\r\n\r\n[DataSet-0:0" + image + "\r\n[DataSet-0:1" + image +
         "\r\n#!" + noise(2 * 2 * 3 * 4);
}

inline std::string wyko() {
  const auto entry = [](const std::string& name, std::int32_t size) {
    return field(name, 16) + littleBytes(std::int16_t{1}) + littleBytes(size) +
           littleBytes(std::int16_t{8});
  };
  return std::string("\1\0", 2) + entry("Directory", 96) + entry("Wavelength", 4) +
         entry("Raw", 30) + entry("", 0) + noise(34);
}

}  // namespace mems_stiction::maker_bytes
