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
constexpr std::uint16_t kBigVersion = 43;

ByteCursor startOf(const std::string& bytes) {
  const ByteOrder order = !bytes.empty() && bytes[0] == 'M' ? ByteOrder::kBig : ByteOrder::kLittle;
  return {bytes.data(), bytes.size(), "the list of its pages", order};
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
    const std::uint64_t entries = is_big ? page.number<std::uint64_t>() : page.number<std::uint16_t>();
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

}  // namespace mems_stiction
