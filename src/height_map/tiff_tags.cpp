#include "mems_stiction/height_map/tiff_tags.hpp"

#include <cstdint>
#include <fstream>

namespace mems_stiction {
namespace {

constexpr std::uint32_t kParkTag = 50432;
constexpr std::uint32_t kParkMagic = 0x0E031301;

/// Unsigned integer of `count` bytes in the file's byte order; 0 past its end, and then the stream has failed.
std::uint32_t readUnsigned(std::istream& stream, int count, bool big_endian) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) {
    const int byte = stream.get();
    if (byte == std::istream::traits_type::eof()) return 0;
    if (big_endian) {
      value = value << 8 | static_cast<std::uint32_t>(byte);
    } else {
      value |= static_cast<std::uint32_t>(byte) << (8 * i);
    }
  }
  return value;
}

}  // namespace

bool hasParkTags(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  const bool big_endian = stream.get() == 'M';
  stream.seekg(4);
  stream.seekg(readUnsigned(stream, 4, big_endian));
  const std::uint32_t entries = readUnsigned(stream, 2, big_endian);
  for (std::uint32_t entry = 0; entry < entries && stream.good(); ++entry) {
    const std::uint32_t tag = readUnsigned(stream, 2, big_endian);
    readUnsigned(stream, 2, big_endian);  // type
    readUnsigned(stream, 4, big_endian);  // count
    const std::uint32_t value = readUnsigned(stream, 4, big_endian);
    if (tag == kParkTag && value == kParkMagic) return true;
  }
  return false;
}

}  // namespace mems_stiction
