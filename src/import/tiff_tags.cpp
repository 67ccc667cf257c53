#include "mems_stiction/import/tiff_tags.hpp"

#include <cstdint>

#include "mems_stiction/import/byte_cursor.hpp"

namespace mems_stiction {
namespace {

constexpr std::uint16_t kParkTag = 50432;
constexpr std::uint32_t kParkMagic = 0x0E031301;
constexpr std::uint16_t kJpkFileVersion = 32768;
constexpr std::uint16_t kJpkProgramVersion = 32769;
constexpr std::uint16_t kDescription = 270;
constexpr const char* kLextDescription = "TiffTagDescData";
constexpr std::size_t kDescriptionStart = 400;  // the XML begins with its declaration

}  // namespace

bool hasInstrumentTags(const std::string& bytes) {
  try {
    const ByteOrder order = !bytes.empty() && bytes[0] == 'M' ? ByteOrder::kBig : ByteOrder::kLittle;
    ByteCursor cursor(bytes.data(), bytes.size(), "the TIFF file", order);
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

}  // namespace mems_stiction
