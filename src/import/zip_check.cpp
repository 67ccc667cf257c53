#include "mems_stiction/import/zip_check.hpp"

#include <zlib.h>

#include <cstdint>
#include <vector>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/import/byte_cursor.hpp"
#include "mems_stiction/import/file_bytes.hpp"
#include "mems_stiction/import/plain_number.hpp"

namespace mems_stiction {
namespace {

constexpr const char* kWhat = "the zip archive";
constexpr std::uint32_t kEntry = 0x02014B50;        // in the central directory
constexpr std::uint32_t kLocal = 0x04034B50;        // before the data
constexpr std::uint64_t kNarrowLimit = 0xFFFFFFFF;  // larger sizes stand in a field of their own

ByteCursor from(const std::string& bytes, std::uint64_t offset) {
  ByteCursor cursor(bytes.data(), bytes.size(), kWhat);
  cursor.take(static_cast<std::size_t>(offset));
  return cursor;
}

/// What the central directory states of one entry.
struct Entry {
  std::string name;
  int method = 0;
  std::uint64_t packed = 0, size = 0, offset = 0;
  std::uint32_t checksum = 0;
};

/// Checksum and size of the unpacked data. @throw FileError
void checkEntry(const std::string& bytes, const Entry& entry) {
  const std::string where = "the zip entry '" + shownPiece(entry.name) + "' ";
  ByteCursor local = from(bytes, entry.offset);
  if (local.number<std::uint32_t>() != kLocal) throw FileError(where + "is not where the archive says: damaged");
  local.take(22);
  const auto name_size = local.number<std::uint16_t>();
  const auto extra_size = local.number<std::uint16_t>();
  local.take(std::size_t{name_size} + extra_size);
  ByteCursor packed = local.part(static_cast<std::size_t>(entry.packed));
  if (entry.size > kMaxFileBytes) throw FileError(where + "unpacks to more bytes than a scan has");
  uLong checksum = crc32(0, nullptr, 0);
  std::uint64_t size = 0;
  const auto* data = reinterpret_cast<const Bytef*>(packed.take(packed.size()));
  if (entry.method == 0) {
    size = entry.packed;
    checksum = crc32_z(checksum, data, static_cast<z_size_t>(size));
  } else if (entry.method == Z_DEFLATED) {
    z_stream stream{};
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw FileError(where + "cannot be unpacked");
    stream.next_in = const_cast<Bytef*>(data);
    stream.avail_in = static_cast<uInt>(entry.packed);
    std::vector<Bytef> buffer(1 << 16);
    int state = Z_OK;
    while (state == Z_OK && size <= entry.size) {
      stream.next_out = buffer.data();
      stream.avail_out = static_cast<uInt>(buffer.size());
      state = inflate(&stream, Z_NO_FLUSH);
      const std::size_t got = buffer.size() - stream.avail_out;
      checksum = crc32_z(checksum, buffer.data(), got);
      size += got;
    }
    inflateEnd(&stream);
    if (state != Z_STREAM_END) throw FileError(where + "cannot be unpacked: damaged");
  } else {
    return;  // a method that zlib does not know; who reads it must
  }
  if (size != entry.size || checksum != entry.checksum) throw FileError(where + "does not have its checksum: damaged");
}

}  // namespace

std::vector<std::string> checkZip(const std::string& bytes) {
  std::vector<std::string> names;
  const std::size_t end = bytes.rfind(std::string("PK\5\6", 4));
  if (end == std::string::npos) throw FileError("the zip archive has no directory: cut off");
  ByteCursor cursor = from(bytes, end + 8);
  cursor.take(2);
  const auto count = cursor.number<std::uint16_t>();
  cursor.take(4);
  const auto start = cursor.number<std::uint32_t>();
  cursor.take(cursor.number<std::uint16_t>());  // the archive's comment
  if (start == kNarrowLimit) return names;      // a directory of the 64-bit kind: no scan is that large
  ByteCursor directory = from(bytes, start);
  std::uint64_t total = 0;
  for (int i = 0; i < count; ++i) {
    if (directory.number<std::uint32_t>() != kEntry) throw FileError("the zip archive's directory is damaged");
    directory.take(6);
    Entry entry;
    entry.method = directory.number<std::uint16_t>();
    directory.take(4);  // time and date
    entry.checksum = directory.number<std::uint32_t>();
    entry.packed = directory.number<std::uint32_t>();
    entry.size = directory.number<std::uint32_t>();
    const auto name_size = directory.number<std::uint16_t>();
    const auto extra_size = directory.number<std::uint16_t>();
    const auto comment_size = directory.number<std::uint16_t>();
    directory.take(8);
    entry.offset = directory.number<std::uint32_t>();
    entry.name = std::string(directory.take(name_size), name_size);
    directory.take(std::size_t{extra_size} + comment_size);
    names.push_back(entry.name);
    if (entry.packed == kNarrowLimit || entry.size == kNarrowLimit) continue;
    total += entry.size;
    if (total > kMaxFileBytes) throw FileError("the zip archive unpacks to more bytes than a scan has");
    checkEntry(bytes, entry);
  }
  return names;
}

}  // namespace mems_stiction
