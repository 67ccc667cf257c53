#include "import/zip_check.hpp"

#include <zlib.h>

#include <algorithm>

#include "import/byte_cursor.hpp"
#include "import/file_bytes.hpp"
#include "import/header_lines.hpp"
#include "import/plain_number.hpp"
#include "import/unpacked_stream.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr const char* kZip = "the zip archive";
constexpr std::uint32_t kZipEntry = 0x02014B50;     // in the central directory
constexpr std::uint32_t kZipLocal = 0x04034B50;     // before the data
constexpr std::uint64_t kNarrowLimit = 0xFFFFFFFF;  // larger sizes stand in a field of their own
constexpr std::uint16_t kWideField = 1;             // of an entry: sizes of 64 bits
constexpr std::uint64_t kMostEntries = 100'000;
constexpr const char* kX3pDocument = "main.xml";
constexpr std::uint64_t kMostX3pEntry = 64 << 20;  // [bytes] for whatever surface
constexpr std::uint64_t kMostX3pPoint = 24;        // [bytes]: x, y and z

ByteCursor zipAt(const std::string& bytes, std::uint64_t offset) {
  ByteCursor cursor(bytes.data(), bytes.size(), kZip);
  if (offset > bytes.size()) throw FileError("the zip archive's directory is damaged");
  cursor.take(static_cast<std::size_t>(offset));
  return cursor;
}

std::string entryName(const ZipEntry& entry) {
  return "the zip entry '" + shownPiece(entry.name) + "' ";
}

/// Sizes that do not fit stand in an extra field, in this order.
void readWideSizes(const std::string& extra, ZipEntry& entry) {
  ByteCursor cursor(extra.data(), extra.size(), kZip);
  while (cursor.size() >= 4) {
    const auto id = cursor.number<std::uint16_t>();
    ByteCursor field = cursor.part(cursor.number<std::uint16_t>());
    if (id != kWideField) continue;
    for (std::uint64_t* const value : {&entry.size, &entry.packed, &entry.offset}) {
      if (*value == kNarrowLimit) *value = field.number<std::uint64_t>();
    }
    return;
  }
}

/// Where the directory is.
struct Directory {
  std::uint64_t start = 0, count = 0;
};

Directory directoryOf(const std::string& bytes) {
  const std::size_t end = bytes.rfind(std::string("PK\5\6", 4));
  if (end == std::string::npos) throw FileError("the zip archive has no directory: cut off");
  ByteCursor cursor = zipAt(bytes, end + 8);
  cursor.take(2);
  Directory directory;
  directory.count = cursor.number<std::uint16_t>();
  cursor.take(4);
  directory.start = cursor.number<std::uint32_t>();
  cursor.take(cursor.number<std::uint16_t>());  // the archive's comment
  if (directory.start != kNarrowLimit && directory.count != 0xFFFF) return directory;
  const std::size_t wide = bytes.rfind(std::string("PK\6\6", 4), end);
  if (wide == std::string::npos) {
    if (directory.start == kNarrowLimit) throw FileError("the zip archive's directory is damaged");
    return directory;
  }
  cursor = zipAt(bytes, wide + 32);
  directory.count = cursor.number<std::uint64_t>();
  cursor.take(8);
  directory.start = cursor.number<std::uint64_t>();
  return directory;
}

/// Unpacks an entry, and compares checksum and size.
/// - @p take gets each piece
template <typename Take>
void unpackEntry(const std::string& bytes, const ZipEntry& entry, Take take) {
  const std::string where = entryName(entry);
  ByteCursor local = zipAt(bytes, entry.offset);
  if (local.number<std::uint32_t>() != kZipLocal)
    throw FileError(where + "is not where the archive says: damaged");
  local.take(22);
  const auto name_size = local.number<std::uint16_t>();
  const auto extra_size = local.number<std::uint16_t>();
  local.take(std::size_t{name_size} + extra_size);
  ByteCursor packed = local.part(static_cast<std::size_t>(entry.packed));
  uLong checksum = crc32(0, nullptr, 0);
  std::uint64_t size = 0;
  const auto* data = reinterpret_cast<const Bytef*>(packed.take(packed.size()));
  if (entry.method == 0) {
    size = entry.packed;
    checksum = crc32_z(checksum, data, static_cast<z_size_t>(size));
    if (size == entry.size) take(data, static_cast<std::size_t>(size));
  } else if (entry.method == Z_DEFLATED) {
    const int state =
        unpackStream(data, entry.packed, -MAX_WBITS, [&](const Bytef* piece, std::size_t got) {
          checksum = crc32_z(checksum, piece, got);
          size += got;
          if (size <= entry.size) take(piece, got);
          return size <= entry.size;
        });
    if (state != Z_STREAM_END) throw FileError(where + "cannot be unpacked: damaged");
  } else {
    return;  // a method that zlib does not know; who reads it must
  }
  if (size != entry.size || checksum != entry.checksum)
    throw FileError(where + "does not have its checksum: damaged");
}

void checkEntries(const std::string& bytes, const std::vector<ZipEntry>& entries) {
  for (const ZipEntry& entry : entries) unpackEntry(bytes, entry, [](const Bytef*, std::size_t) {});
}

/// The whole number of the first element of this name, with a prefix or without; 1 if there is
/// none.
std::uint64_t statedIn(const std::string& xml, const std::string& name) {
  for (std::size_t at = xml.find(name); at != std::string::npos; at = xml.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    const bool is_start = at > 0 && (xml[at - 1] == '<' || xml[at - 1] == ':') &&
                          end < xml.size() &&
                          std::string("> \t\r\n").find(xml[end]) != std::string::npos;
    if (!is_start) continue;
    const std::size_t begin = std::min(xml.find('>', end), xml.size() - 1) + 1;
    const std::string text = xml.substr(begin, std::min(xml.find('<', begin), xml.size()) - begin);
    const auto count = countIn(trimmed(text, " \t\r\n"));
    if (!count || *count == 0)
      throw FileError(std::string(kX3pDocument) + " states '" + shownPiece(text) + "' as " + name);
    return *count;
  }
  return 1;
}

/// x3p wants its files at the top of the archive; who packs the folder instead of its content moves
/// them down.
void refuseX3pFolder(const std::vector<ZipEntry>& entries) {
  for (const ZipEntry& entry : entries) {
    const std::size_t slash = entry.name.rfind('/');
    if (slash == std::string::npos || entry.name.substr(slash + 1) != kX3pDocument) continue;
    throw FileError(std::string("the archive has its ") + kX3pDocument + " in the folder '" +
                    shownPiece(entry.name.substr(0, slash)) +
                    "': pack what is in the folder, not the folder itself");
  }
}

void requireSize(const ZipEntry& entry, std::uint64_t most, const std::string& why) {
  if (entry.size <= most) return;
  throw FileError(entryName(entry) + "unpacks to " + std::to_string(entry.size) +
                  " bytes, more than the " + std::to_string(most) + " that " + why);
}

void checkX3pSizes(const std::string& bytes, const std::vector<ZipEntry>& entries,
                   const ZipEntry& document) {
  requireSize(document, kMostX3pEntry, "it may have");
  std::string xml;
  unpackEntry(bytes, document, [&xml](const Bytef* piece, std::size_t size) {
    xml.append(reinterpret_cast<const char*>(piece), size);
  });
  std::uint64_t points = 1;
  for (const char* name : {"SizeX", "SizeY", "SizeZ", "ListDimension"}) {
    const std::uint64_t count = statedIn(xml, name);
    checkPixelCount(points, count);
    points *= count;
  }
  const std::uint64_t most = std::max(kMostX3pEntry, kMostX3pPoint * points);
  for (const ZipEntry& entry : entries)
    requireSize(entry, most, std::to_string(points) + " points may need");
}

}  // namespace

std::vector<ZipEntry> zipEntries(const std::string& bytes) {
  const Directory stated = directoryOf(bytes);
  if (stated.count > kMostEntries) {
    throw FileError("the zip archive states " + std::to_string(stated.count) +
                    " entries, more than the " + std::to_string(kMostEntries) + " of a scan");
  }
  ByteCursor directory = zipAt(bytes, stated.start);
  std::vector<ZipEntry> entries;
  std::uint64_t total = 0;
  for (std::uint64_t i = 0; i < stated.count; ++i) {
    if (directory.number<std::uint32_t>() != kZipEntry)
      throw FileError("the zip archive's directory is damaged");
    directory.take(6);
    ZipEntry entry;
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
    readWideSizes(std::string(directory.take(extra_size), extra_size), entry);
    directory.take(comment_size);
    if (entry.size > kMaxFileBytes || total + entry.size > kMaxFileBytes) {
      throw FileError(entryName(entry) + "unpacks to " + std::to_string(entry.size) +
                      " bytes: with those before it more than the " +
                      std::to_string(kMaxFileBytes) + " of a scan");
    }
    total += entry.size;
    entries.push_back(std::move(entry));
  }
  return entries;
}

void checkZip(const std::string& bytes) { checkEntries(bytes, zipEntries(bytes)); }

void checkX3p(const std::string& bytes) {
  const std::vector<ZipEntry> entries = zipEntries(bytes);
  const auto document = std::find_if(entries.begin(), entries.end(), [](const ZipEntry& entry) {
    return entry.name == kX3pDocument;
  });
  if (document == entries.end()) {
    refuseX3pFolder(entries);
  } else {
    checkX3pSizes(bytes, entries, *document);
  }
  checkEntries(bytes, entries);
}

}  // namespace mems_stiction
