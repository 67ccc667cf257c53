#include "import/file_checks.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <vector>

#include "import/byte_cursor.hpp"
#include "import/file_bytes.hpp"
#include "import/header_lines.hpp"
#include "import/unpacked_stream.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

/// By chance, one line feed of 256 stands behind a carriage return, and one high byte of thousands
/// begins such a group.
constexpr std::size_t kTooManyForChance = 64;
constexpr const char* kReplaced = "\xEF\xBF\xBD";  // U+FFFD
constexpr std::size_t kCreatecHeader = 16384;      // [bytes]
constexpr std::size_t kMostFiller = 16384;         // [bytes] that programs add behind the data

ByteCursor at(const std::string& bytes, std::size_t offset, const char* what,
              ByteOrder order = ByteOrder::kLittle) {
  ByteCursor cursor(bytes.data(), bytes.size(), what, order);
  cursor.take(offset);
  return cursor;
}

/// Zygo: a header, intensities of 2 bytes, phases of 4 bytes.
void checkMetroPro(const std::string& bytes) {
  ByteCursor cursor = at(bytes, 6, "the MetroPro file", ByteOrder::kBig);
  const std::uint64_t header = cursor.number<std::uint32_t>();
  cursor = at(bytes, 52, "the MetroPro file", ByteOrder::kBig);
  const std::uint64_t cols = cursor.number<std::uint16_t>();
  const std::uint64_t rows = cursor.number<std::uint16_t>();
  const std::uint64_t images = cursor.number<std::uint16_t>();
  cursor.take(2 + 4 + 4);
  const std::uint64_t phase_cols = cursor.number<std::uint16_t>();
  const std::uint64_t phase_rows = cursor.number<std::uint16_t>();
  demandLength("MetroPro", bytes.size(),
               header + 2 * cols * rows * images + 4 * phase_cols * phase_rows);
}

/// A number in one of Alicona's tags of 52 bytes; 0 if it has none.
std::uint64_t aliconaTag(const std::string& bytes, const std::string& key) {
  constexpr std::size_t kTag = 52;
  constexpr std::size_t kMostTags = 1000;
  const std::string name = (key + std::string(20, '\0')).substr(0, 20);
  for (std::size_t tag = 17; tag + kTag <= bytes.size() && tag < kMostTags * kTag; tag += kTag) {
    if (bytes.compare(tag, name.size(), name) != 0) continue;
    return countIn(bytes.substr(tag + 20, 30)).value_or(0);
  }
  return 0;
}

void checkAlicona(const std::string& bytes) {
  const auto stride = [](std::uint64_t width) { return (width + 7) / 8 * 8; };
  const std::uint64_t cols = aliconaTag(bytes, "Cols");
  const std::uint64_t rows = aliconaTag(bytes, "Rows");
  checkPixelCount(cols, rows);
  std::uint64_t end = 0;
  const auto reach = [&](const char* key, std::uint64_t size) {
    const std::uint64_t offset = aliconaTag(bytes, key);
    if (offset > 0) end = std::max(end, offset + size);
  };
  reach("IconOffset", 68400);
  reach("DepthImageOffset", stride(4 * cols) * rows);
  reach("TextureImageOffset", stride(cols) * rows * aliconaTag(bytes, "NumberOfPlanes"));
  if (end > 0) demandLength("Alicona", bytes.size(), end);
}

/// Agilent, Molecular Imaging: images of one size behind each other; text has no length.
void checkAgilent(const std::string& bytes) {
  const std::size_t data = bytes.find("\ndata          BINARY");
  if (data == std::string::npos) return;
  const std::size_t start = bytes.find('\n', data + 1) + 1;
  const HeaderLines header(bytes.substr(0, data + 1), " ");
  const bool is_wide = bytes.compare(data + 21, 3, "_32") == 0;
  const std::uint64_t cols = header.count("xPixels");
  const std::uint64_t rows = header.count("yPixels");
  checkPixelCount(cols, rows);
  demandLength("Agilent", bytes.size(),
               start + cols * rows * (is_wide ? 4 : 2) * header.times("bufferLabel"));
}

/// Aarhus: an index of images in blocks of 128 bytes, then each with a label.
void checkAarhus(const std::string& bytes) {
  constexpr std::uint64_t kBlock = 128;
  ByteCursor index = at(bytes, 0, "the .mul file").part(3 * kBlock);
  std::uint64_t end = 0;
  for (int i = 0; i < 64; ++i) {
    const auto id = index.number<std::int16_t>();
    const std::uint64_t address = index.number<std::uint32_t>();
    if (id == 0) continue;
    ByteCursor label =
        at(bytes, static_cast<std::size_t>(std::min<std::uint64_t>(address * kBlock, bytes.size())),
           "the .mul file");
    const bool is_named = label.number<std::int16_t>() == id;
    const std::uint64_t blocks = label.number<std::uint16_t>();
    const std::uint64_t pixels =
        std::uint64_t{label.number<std::uint16_t>()} * label.number<std::uint16_t>();
    if (!is_named || blocks * kBlock < kBlock + 2 * pixels ||
        blocks * kBlock >= 3 * kBlock + 2 * pixels) {
      throw FileError(
          "the image " + std::to_string(id) +
          " of the .mul file is not where or not as large as its index and label say: damaged");
    }
    end = std::max(end, address + blocks);
  }
  demandLength(".mul", bytes.size(), end * kBlock);
}

/// The numbers behind a Createc header of 16 kB, unpacked. @throw FileError
std::uint64_t unpackedCreatec(const std::string& bytes, std::size_t start, std::uint64_t needed) {
  std::uint64_t size = 0;
  bool is_filler = true;
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data() + start);
  const int state =
      unpackStream(data, bytes.size() - start, MAX_WBITS, [&](const Bytef* piece, std::size_t got) {
        for (std::size_t i = size < needed ? std::min<std::uint64_t>(needed - size, got) : 0;
             i < got; ++i) {
          is_filler = is_filler && piece[i] == 0;
        }
        size += got;
        return size <= needed + kMostFiller;
      });
  if (state != Z_STREAM_END && size <= needed + kMostFiller)
    throw FileError("the Createc data cannot be unpacked: cut off or damaged");
  return is_filler && size <= needed + kMostFiller ? std::min(size, needed) : size;
}

void checkCreatec(const std::string& bytes) {
  if (bytes.size() <= kCreatecHeader)
    throw FileError("the Createc file ends in its header: cut off");
  const HeaderLines header(bytes.substr(0, kCreatecHeader), "=");
  const auto count = [&header](const std::string& key) {
    return header.has(key) ? header.count(key) : header.count(key + " / " + key);
  };
  const std::uint64_t cols = count("Num.X");
  const std::uint64_t rows = count("Num.Y");
  checkPixelCount(cols, rows);
  const std::uint64_t pixels = cols * rows * count("Channels");
  if (startsWith(bytes, "[Paramco32]")) {
    const std::uint64_t needed = 4 + 4 * pixels;
    demandLength("unpacked Createc", unpackedCreatec(bytes, kCreatecHeader, needed), needed);
    return;
  }
  const std::uint64_t bytes_each = startsWith(bytes, "[Paramet32]") ? 4 : 2;
  const std::uint64_t end = kCreatecHeader + bytes_each * (pixels + 1);
  const bool is_filled =
      bytes.size() > end && bytes.size() - end <= kMostFiller &&
      bytes.find_first_not_of('\0', static_cast<std::size_t>(end)) == std::string::npos;
  if (!is_filled) demandLength("Createc", bytes.size(), end);
}

/// Surfstand's text: a header, as many numbers as it states, a star.
void checkSurfstandText(const std::string& bytes) {
  const std::size_t header_end = bytes.find("\n*");
  if (header_end == std::string::npos) throw FileError("the .sdf header has no end: cut off");
  const HeaderLines header(bytes.substr(0, header_end + 1), "=");
  const std::uint64_t stated = header.count("NumPoints") * header.count("NumProfiles");
  const std::size_t begin = std::min(bytes.find('\n', header_end + 1), bytes.size());
  const std::size_t end = bytes.find('*', begin);
  std::uint64_t found = 0;
  bool is_inside = false;
  for (std::size_t i = begin; i < std::min(end, bytes.size()); ++i) {
    const bool is_blank = std::isspace(static_cast<unsigned char>(bytes[i])) != 0;
    if (!is_blank && !is_inside) ++found;
    is_inside = !is_blank;
  }
  if (found != stated) {
    throw FileError("the .sdf file has " + std::to_string(found) + " heights, its header states " +
                    std::to_string(stated) + ": cut off or damaged");
  }
  if (is_inside && end == std::string::npos)
    throw FileError("the last number of the .sdf file has no line end: cut off");
}

/// Omicron: a description with the number of points taken, then those.
void checkMatrix(const std::string& bytes) {
  const std::size_t description = bytes.substr(0, 4096).find("CSED");
  const std::size_t data = bytes.substr(0, 4096).find("ATAD");
  if (description == std::string::npos || data == std::string::npos) return;
  ByteCursor cursor = at(bytes, description + 8 + 24, "the MATRIX file");
  const std::uint64_t taken = cursor.number<std::uint32_t>();
  cursor = at(bytes, data + 4, "the MATRIX file");
  const std::uint64_t size = cursor.number<std::uint32_t>();
  if (size != 4 * taken) {
    throw FileError("the MATRIX file states " + std::to_string(taken) + " points of 4 bytes, and " +
                    std::to_string(size) + " bytes of data: damaged");
  }
  const bool is_filled =
      cursor.size() > size && cursor.size() - size <= 8 &&
      bytes.find_first_not_of('\0', data + 8 + static_cast<std::size_t>(size)) == std::string::npos;
  if (!is_filled) demandLength("MATRIX", bytes.size(), data + 8 + size);
}

/// Nanosurf: sections of a text, "#!", then the images in the order of the groups.
void checkNanosurf(const std::string& bytes) {
  const std::size_t mark = bytes.find("\n#!");
  if (mark == std::string::npos) throw FileError("the Nanosurf file has no data: cut off");
  const std::string text = bytes.substr(0, mark + 1);
  std::uint64_t length = mark + 3;
  std::size_t next = 0;
  for (std::size_t section = text.find("\n[DataSet-"); section != std::string::npos;
       section = next) {
    next = text.find("\n[", section + 1);
    const HeaderLines lines(
        text.substr(section, next == std::string::npos ? next : next + 1 - section), "=");
    if (!lines.has("SaveBits")) continue;
    if (lines.has("SaveMode") && lines.value("SaveMode") != "Binary") return;  // text
    length += lines.count("Points") * lines.count("Lines") * (lines.count("SaveBits") / 8);
  }
  demandLength("Nanosurf", bytes.size(), length);
}

/// Wyko: a directory of blocks, itself the first, that stand behind each other.
void checkWyko(const std::string& bytes) {
  constexpr std::uint64_t kEntry = 24;
  ByteCursor directory = at(bytes, 2, "the Wyko file");
  std::uint64_t length = 2;
  std::uint64_t entries = 1;
  for (std::uint64_t i = 0; i < entries; ++i) {
    directory.take(18);
    const std::uint64_t size = directory.number<std::uint32_t>();
    directory.take(2);
    if (i == 0) entries = size / kEntry;
    length += size;
  }
  demandLength("Wyko", bytes.size(), length);
}

/// Every line feed of the binary part stands behind a carriage return.
bool hasLineEndsOnly(const std::string& bytes, std::size_t binary) {
  std::size_t count = 0;
  for (std::size_t at = bytes.find('\n', binary); at != std::string::npos;
       at = bytes.find('\n', at + 1)) {
    if (at == 0 || bytes[at - 1] != '\r') return false;
    ++count;
  }
  return count >= kTooManyForChance;
}

/// No high byte but those of the sign that replaces what is no UTF-8.
bool hasReplacedBytes(const std::string& bytes) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    if (static_cast<unsigned char>(bytes[at]) < 0x80) continue;
    if (bytes.compare(at, 3, kReplaced) != 0) return false;
    at += 2;
    ++count;
  }
  return count >= kTooManyForChance;
}

}  // namespace

void demandLength(const std::string& maker, std::uint64_t length, std::uint64_t stated) {
  if (length == stated) return;
  throw FileError(
      "the " + maker + " file has " + std::to_string(length) + " bytes, its header states " +
      std::to_string(stated) +
      (length < stated ? ": cut off" : ": transferred as text, or its header is damaged"));
}

void checkStatedLength(const std::string& bytes) {
  struct Format {
    std::string start;
    void (*check)(const std::string& bytes);
  };
  static const Format kFormats[] = {
      {"\x88\x1b\x03\x6f", checkMetroPro},
      {"\x88\x1b\x03\x70", checkMetroPro},
      {"\x88\x1b\x03\x71", checkMetroPro},
      {std::string("AliconaImaging\0\r\n", 17), checkAlicona},
      {"fileType      Image", checkAgilent},
      {"[Parameter]", checkCreatec},
      {"[Paramet32]", checkCreatec},
      {"[Paramco32]", checkCreatec},
      {"aBCR-1.", checkSurfstandText},
      {"aISO-1.", checkSurfstandText},
      {"ONTMATRX0101", checkMatrix},
      {std::string("\1\0\3\0\0\0", 6), checkAarhus},
      {"[DataSet]\r\n", checkNanosurf},
      {std::string("\1\0Directory\0", 12), checkWyko},
  };
  for (const Format& format : kFormats) {
    if (startsWith(bytes, format.start)) return format.check(bytes);
  }
}

std::optional<std::string> withWholeCreatecHeader(const std::string& bytes) {
  const std::string mark = "DATA";
  if (!startsWith(bytes, "[Paramco32]")) return std::nullopt;
  for (std::size_t at = bytes.find(mark); at < kCreatecHeader - mark.size();
       at = bytes.find(mark, at + 1)) {
    const std::size_t data = at + mark.size();
    if (data + 1 >= bytes.size()) break;
    const auto* head = reinterpret_cast<const unsigned char*>(bytes.data() + data);
    if (head[0] != 0x78 || (256 * head[0] + head[1]) % 31 != 0) continue;  // no stream of zlib
    return bytes.substr(0, at) + std::string(kCreatecHeader - data, '\0') + bytes.substr(at);
  }
  return std::nullopt;
}

void checkTransfer(const std::string& bytes) {
  if (startsWith(bytes, "version https://git-lfs.")) {
    throw FileError("is a pointer of Git LFS, not the file itself: get it by 'git lfs pull'");
  }
  const std::string start = lowered(bytes.substr(0, 15));
  if (startsWith(start, "<!doctype html") || startsWith(start, "<html")) {
    throw FileError(
        "is a web page, not a scan: what it was loaded from did not give the file itself");
  }
  const std::size_t binary = bytes.find('\0');
  if (binary == std::string::npos) return;  // text, where line ends may be of any kind
  if (hasLineEndsOnly(bytes, binary)) {
    throw FileError(
        "was transferred as text: every line feed in its data stands behind a carriage return; "
        "copy it anew, as "
        "binary");
  }
  if (hasReplacedBytes(bytes)) {
    throw FileError(
        "was transferred as text: bytes of its data were replaced by U+FFFD; copy it anew, as "
        "binary");
  }
}

}  // namespace mems_stiction
