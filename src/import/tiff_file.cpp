#include "import/format_readers.hpp"

#include <tiffio.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>

#include "import/byte_cursor.hpp"
#include "import/file_bytes.hpp"
#include "import/tiff_tags.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr ttag_t kGdalMetadata = 42112;
constexpr ttag_t kGdalMissing = 42113;
constexpr int kMostPages = 1000;

/// The file in memory, as libtiff's callbacks see it.
struct Source {
  const std::string& bytes;
  std::uint64_t at = 0;
};

tmsize_t readSource(thandle_t handle, void* buffer, tmsize_t size) {
  auto& source = *static_cast<Source*>(handle);
  const std::uint64_t left = source.at < source.bytes.size() ? source.bytes.size() - source.at : 0;
  const auto count = static_cast<std::size_t>(std::min(left, static_cast<std::uint64_t>(size)));
  std::memcpy(buffer, source.bytes.data() + std::min<std::uint64_t>(source.at, source.bytes.size()),
              count);
  source.at += count;
  return static_cast<tmsize_t>(count);
}

toff_t seekSource(thandle_t handle, toff_t offset, int whence) {
  auto& source = *static_cast<Source*>(handle);
  if (whence == SEEK_SET) source.at = offset;
  if (whence == SEEK_CUR) source.at += offset;
  if (whence == SEEK_END) source.at = source.bytes.size() + offset;
  return source.at;
}

toff_t sizeOfSource(thandle_t handle) { return static_cast<Source*>(handle)->bytes.size(); }
tmsize_t writeNothing(thandle_t, void*, tmsize_t) { return 0; }
int closeNothing(thandle_t) { return 0; }

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

template <typename Number>
Number tag(TIFF* tiff, ttag_t name, Number otherwise) {
  Number value{};
  return TIFFGetFieldDefaulted(tiff, name, &value) == 1 ? value : otherwise;
}

std::string textTag(TIFF* tiff, ttag_t name) {
  const char* text = nullptr;
  return TIFFGetField(tiff, name, &text) == 1 && text != nullptr ? text : "";
}

/// A tag that libtiff does not know comes with a count, unless another library of this process has
/// introduced it.
std::string privateTextTag(TIFF* tiff, ttag_t name) {
  const TIFFField* field = TIFFFindField(tiff, name, TIFF_ASCII);
  if (field == nullptr) return "";
  if (TIFFFieldPassCount(field) == 0) return textTag(tiff, name);
  std::uint32_t count = 0;
  const char* text = nullptr;
  if (TIFFGetField(tiff, name, &count, &text) != 1 || text == nullptr) return "";
  std::string value(text, count);
  value.erase(std::min(value.find('\0'), value.size()));
  return value;
}

/// How the numbers of a page are laid out.
struct Layout {
  std::uint32_t cols = 0, rows = 0;
  int bits = 1, samples = 1, format = SAMPLEFORMAT_UINT;
  bool is_separate = false;
};

Layout layoutOf(TIFF* tiff) {
  Layout layout;
  layout.cols = tag<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH, 0);
  layout.rows = tag<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH, 0);
  layout.bits = tag<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE, 1);
  layout.samples = tag<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  layout.format = tag<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  layout.is_separate =
      tag<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) == PLANARCONFIG_SEPARATE;
  checkPixelCount(layout.cols, layout.rows);
  const bool is_float = layout.format == SAMPLEFORMAT_IEEEFP;
  const bool is_integer = layout.format == SAMPLEFORMAT_UINT || layout.format == SAMPLEFORMAT_INT ||
                          layout.format == SAMPLEFORMAT_VOID;
  if ((is_float && layout.bits != 16 && layout.bits != 32 && layout.bits != 64) ||
      (is_integer && layout.bits > 32) || (!is_float && !is_integer)) {
    throw FileError("pixels of " + std::to_string(layout.bits) + " bits of sample format " +
                    std::to_string(layout.format) + " are not read");
  }
  return layout;
}

/// The page's type in OpenCV: the smallest that ScanOptions scale and that shows every value, else
/// double.
int typeOf(const Layout& layout) {
  const bool is_signed = layout.format == SAMPLEFORMAT_INT;
  int depth = CV_64F;
  if (layout.format == SAMPLEFORMAT_IEEEFP) {
    depth = layout.bits == 64 ? CV_64F : CV_32F;
  } else if (layout.bits <= 8 && !is_signed) {
    depth = CV_8U;
  } else if (layout.bits <= 16) {
    depth = is_signed ? CV_16S : CV_16U;
  }
  return CV_MAKETYPE(depth, layout.samples);
}

/// Sample `index` of a line in the machine's byte order, packed without gaps from the highest bit
/// on.
double sampleAt(const unsigned char* line, std::size_t index, const Layout& layout) {
  const auto as = [line, index](auto number) {
    std::memcpy(&number, line + index * sizeof number, sizeof number);
    return number;
  };
  if (layout.format == SAMPLEFORMAT_IEEEFP) {
    if (layout.bits == 16) return halfToFloat(as(std::uint16_t{}));
    return layout.bits == 32 ? static_cast<double>(as(float{})) : as(double{});
  }
  const bool is_signed = layout.format == SAMPLEFORMAT_INT;
  if (layout.bits == 8)
    return is_signed ? static_cast<double>(as(std::int8_t{})) : as(std::uint8_t{});
  if (layout.bits == 16)
    return is_signed ? static_cast<double>(as(std::int16_t{})) : as(std::uint16_t{});
  if (layout.bits == 32)
    return is_signed ? static_cast<double>(as(std::int32_t{})) : as(std::uint32_t{});
  std::uint64_t value = 0;
  const std::size_t first = index * static_cast<std::size_t>(layout.bits);
  for (std::size_t bit = first; bit < first + static_cast<std::size_t>(layout.bits); ++bit) {
    value = value << 1 | (line[bit / 8] >> (7 - bit % 8) & 1u);
  }
  const std::uint64_t sign = std::uint64_t{1} << (layout.bits - 1);
  return is_signed && (value & sign) != 0
             ? static_cast<double>(value) - 2.0 * static_cast<double>(sign)
             : static_cast<double>(value);
}

void setSample(cv::Mat& pixels, int row, int index, double value) {
  switch (pixels.depth()) {
    case CV_8U:
      pixels.ptr<std::uint8_t>(row)[index] = static_cast<std::uint8_t>(value);
      break;
    case CV_16U:
      pixels.ptr<std::uint16_t>(row)[index] = static_cast<std::uint16_t>(value);
      break;
    case CV_16S:
      pixels.ptr<std::int16_t>(row)[index] = static_cast<std::int16_t>(value);
      break;
    case CV_32F:
      pixels.ptr<float>(row)[index] = static_cast<float>(value);
      break;
    default:
      pixels.ptr<double>(row)[index] = value;
  }
}

/// One rectangle of decoded samples into the page.
void unpack(const unsigned char* data, std::size_t line_bytes, const Layout& layout,
            const cv::Rect& place, int sample, cv::Mat& pixels) {
  const int in_line = layout.is_separate ? 1 : layout.samples;
  const int last_row = std::min(place.y + place.height, pixels.rows);
  const int last_col = std::min(place.x + place.width, pixels.cols);
  for (int row = place.y; row < last_row; ++row) {
    const unsigned char* line = data + static_cast<std::size_t>(row - place.y) * line_bytes;
    for (int col = place.x; col < last_col; ++col) {
      for (int i = 0; i < in_line; ++i) {
        const auto index =
            static_cast<std::size_t>(col - place.x) * static_cast<std::size_t>(in_line) +
            static_cast<std::size_t>(i);
        setSample(pixels, row, col * layout.samples + sample + i, sampleAt(line, index, layout));
      }
    }
  }
}

/// Where a strip or tile stands in the file.
struct Extent {
  std::uint64_t begin = 0, end = 0, size = 0;
  std::uint32_t number = 0;
};

[[noreturn]] void refuseExtent(bool is_tiled, std::uint32_t number, std::uint32_t count,
                               const std::string& why) {
  throw FileError(std::string(is_tiled ? "tile " : "strip ") + std::to_string(number + 1) + " of " +
                  std::to_string(count) + " " + why);
}

/// Bytes of the strip or tile without compression.
std::uint64_t fullSize(TIFF* tiff, const Layout& layout, std::uint32_t number, std::uint32_t count,
                       std::uint32_t high) {
  if (TIFFIsTiled(tiff) != 0) return TIFFTileSize64(tiff);
  const std::uint32_t in_plane =
      count / static_cast<std::uint32_t>(layout.is_separate ? layout.samples : 1);
  const std::uint64_t first = std::uint64_t{high} * (number % std::max(in_plane, 1u));
  const std::uint64_t lines =
      std::min<std::uint64_t>(high, layout.rows - std::min<std::uint64_t>(first, layout.rows));
  return TIFFVStripSize64(tiff, static_cast<std::uint32_t>(lines));
}

/// A strip or tile that was not written has offset or byte count 0: libtiff would read the file's
/// heading in its place. Two strips share no bytes. Without compression the bytes of a strip follow
/// from the page's size: other bytes tell of damage. Strips may be padded by a line.
void checkExtents(TIFF* tiff, const Layout& layout, std::uint32_t high, std::uint64_t line_bytes,
                  std::uint64_t file_bytes) {
  const bool is_tiled = TIFFIsTiled(tiff) != 0;
  const bool is_plain =
      tag<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE) == COMPRESSION_NONE;
  const std::uint64_t heading = TIFFIsBigTIFF(tiff) != 0 ? 16 : 8;
  const std::uint32_t count = is_tiled ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
  std::vector<Extent> extents;
  std::uint64_t stated = 0;
  std::uint64_t needed = 0;
  for (std::uint32_t number = 0; number < count; ++number) {
    const std::uint64_t begin = TIFFGetStrileOffset(tiff, number);
    const std::uint64_t size = TIFFGetStrileByteCount(tiff, number);
    if (begin < heading || size == 0 || begin >= file_bytes) {
      refuseExtent(is_tiled, number, count,
                   "is not in the file: the file states offset " + std::to_string(begin) + " and " +
                       std::to_string(size) + " bytes for it");
    }
    const std::uint64_t full = fullSize(tiff, layout, number, count, high);
    if (is_plain && size < full) {
      refuseExtent(is_tiled, number, count,
                   "is cut off: the file states " + std::to_string(size) +
                       " bytes for it, must be " + std::to_string(full));
    }
    stated += size;
    needed += full;
    // Padding is not read. Writers state too many compressed bytes, which stand for themselves.
    extents.push_back({begin, begin + (is_plain ? full : 1), size, number});
  }
  if (is_plain && !is_tiled && stated > needed + line_bytes * count) {
    throw FileError("a page states " + std::to_string(stated) +
                    " bytes of pixels, its size needs " + std::to_string(needed) + ": damaged");
  }
  std::sort(extents.begin(), extents.end(),
            [](const Extent& a, const Extent& b) { return a.begin < b.begin; });
  for (std::size_t i = 1; i < extents.size(); ++i) {
    if (extents[i].begin >= extents[i - 1].end) continue;
    // some writers keep compressed tiles that are alike once
    if (!is_plain && extents[i].size == extents[i - 1].size) continue;
    refuseExtent(is_tiled, std::max(extents[i].number, extents[i - 1].number), count,
                 "overlaps number " +
                     std::to_string(std::min(extents[i].number, extents[i - 1].number) + 1) +
                     ": the heights of one of them are not in the file");
  }
}

cv::Mat pixelsOf(TIFF* tiff, const Layout& layout, std::uint64_t file_bytes) {
  const std::string damaged =
      "the image cannot be read: cut off, damaged, or of a compression that libtiff lacks";
  const bool is_tiled = TIFFIsTiled(tiff) != 0;
  const tmsize_t size = is_tiled ? TIFFTileSize(tiff) : TIFFStripSize(tiff);
  const tmsize_t line_bytes = is_tiled ? TIFFTileRowSize(tiff) : TIFFScanlineSize(tiff);
  const std::uint32_t high =
      is_tiled ? tag<std::uint32_t>(tiff, TIFFTAG_TILELENGTH, 0)
               : std::min(tag<std::uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP, layout.rows), layout.rows);
  const std::uint32_t wide =
      is_tiled ? tag<std::uint32_t>(tiff, TIFFTAG_TILEWIDTH, 0) : layout.cols;
  if (size <= 0 || line_bytes <= 0 || high == 0 || wide == 0 || high > (1u << 20) + layout.rows ||
      static_cast<std::uint64_t>(size) > kMaxFileBytes) {
    throw FileError(damaged);
  }
  checkExtents(tiff, layout, high, static_cast<std::uint64_t>(line_bytes), file_bytes);
  cv::Mat pixels =
      cv::Mat::zeros(static_cast<int>(layout.rows), static_cast<int>(layout.cols), typeOf(layout));
  std::vector<unsigned char> buffer(static_cast<std::size_t>(size));
  const int planes = layout.is_separate ? layout.samples : 1;
  for (int plane = 0; plane < planes; ++plane) {
    for (std::uint32_t y = 0; y < layout.rows; y += high) {
      const std::uint32_t lines = std::min(high, layout.rows - y);
      for (std::uint32_t x = 0; x < layout.cols; x += wide) {
        const auto sample = static_cast<std::uint16_t>(plane);
        const tmsize_t got = is_tiled
                                 ? TIFFReadTile(tiff, buffer.data(), x, y, 0, sample)
                                 : TIFFReadEncodedStrip(tiff, TIFFComputeStrip(tiff, y, sample),
                                                        buffer.data(), size);
        if (got < static_cast<tmsize_t>(is_tiled ? high : lines) * line_bytes)
          throw FileError(damaged);
        const std::uint32_t columns =
            std::min(wide, layout.cols - x);  // a tile may reach over the page
        unpack(buffer.data(), static_cast<std::size_t>(line_bytes), layout,
               {static_cast<int>(x), static_cast<int>(y), static_cast<int>(columns),
                static_cast<int>(lines)},
               plane, pixels);
      }
    }
  }
  return pixels;
}

/// Row 0 is the top and column 0 the left, whatever the order in the file.
cv::Mat upright(const cv::Mat& pixels, int orientation) {
  if (orientation <= ORIENTATION_TOPLEFT) return pixels;
  if (orientation > ORIENTATION_BOTLEFT)
    throw FileError("its orientation tag turns rows into columns: turn it upright");
  const int axes = orientation == ORIENTATION_TOPRIGHT  ? 1
                   : orientation == ORIENTATION_BOTLEFT ? 0
                                                        : -1;  // -1: both
  cv::Mat turned;
  cv::flip(pixels, turned, axes);
  return turned;
}

TiffNotes notesOf(TIFF* tiff) {
  TiffNotes notes;
  notes.description = textTag(tiff, TIFFTAG_IMAGEDESCRIPTION);
  notes.gdal_metadata = privateTextTag(tiff, kGdalMetadata);
  notes.gdal_missing = privateTextTag(tiff, kGdalMissing);
  notes.resolution_x = static_cast<double>(tag<float>(tiff, TIFFTAG_XRESOLUTION, 0.0F));
  notes.resolution_y = static_cast<double>(tag<float>(tiff, TIFFTAG_YRESOLUTION, 0.0F));
  const int unit = tag<std::uint16_t>(tiff, TIFFTAG_RESOLUTIONUNIT, RESUNIT_NONE);
  notes.resolution_unit = unit == RESUNIT_CENTIMETER ? 1e-2 : unit == RESUNIT_INCH ? 0.0254 : 0.0;
  return notes;
}

/// Small copies for a quick look, and masks.
bool isAside(TIFF* tiff) {
  return (tag<std::uint32_t>(tiff, TIFFTAG_SUBFILETYPE, 0) &
          (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) != 0;
}

/// The page's name, or a description that is one: a short line that no program wrote for itself.
std::string titleOf(TIFF* tiff) {
  std::string title = textTag(tiff, TIFFTAG_PAGENAME);
  if (!title.empty()) return title;
  title = textTag(tiff, TIFFTAG_IMAGEDESCRIPTION);
  const bool is_for_programs =
      title.size() > 60 || title.find_first_of("{}<>=\n\r") != std::string::npos;
  return is_for_programs ? "" : title;
}

FileChannel channelOf(TIFF* tiff, int page, int pages, const std::string& page_zero_description,
                      std::uint64_t file_bytes) {
  FileChannel channel;
  channel.id = page;
  channel.title = titleOf(tiff);
  channel.takes_settings = true;
  const Layout layout = layoutOf(tiff);
  const int photometric = tag<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  if (layout.samples > 2 || photometric == PHOTOMETRIC_PALETTE) {  // a picture: listed, not read
    channel.values = cv::Mat::zeros(static_cast<int>(layout.rows), static_cast<int>(layout.cols),
                                    CV_8UC(std::clamp(layout.samples, 3, 4)));
    return channel;
  }
  channel.values = upright(pixelsOf(tiff, layout, file_bytes),
                           tag<std::uint16_t>(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT));
  TiffNotes notes = notesOf(tiff);
  if (notes.description.empty()) notes.description = page_zero_description;
  applyTiffNotes(notes, pages, channel);
  return channel;
}

}  // namespace

std::vector<FileChannel> parseTiff(const std::string& bytes) {
  TIFFSetErrorHandler(nullptr);  // what is wrong is said by us, in one line
  TIFFSetWarningHandler(nullptr);
  Source source{bytes};
  const Tiff tiff(TIFFClientOpen("scan", "rm", &source, readSource, writeNothing, seekSource,
                                 closeNothing, sizeOfSource, nullptr, nullptr),
                  &TIFFClose);
  if (!tiff) throw FileError("the image cannot be read: cut off or damaged");
  const std::string description = textTag(tiff.get(), TIFFTAG_IMAGEDESCRIPTION);
  int pages = 0;
  do {
    ++pages;
  } while (pages < kMostPages && TIFFReadDirectory(tiff.get()) != 0);
  if (TIFFLastDirectory(tiff.get()) == 0 || pageCount(bytes, kMostPages) != pages) {
    throw FileError("the list of its pages is damaged, or longer than " +
                    std::to_string(kMostPages));
  }

  std::vector<FileChannel> channels;
  std::uint64_t pixels = 0;
  for (int page = 0; page < pages; ++page) {
    if (TIFFSetDirectory(tiff.get(), static_cast<tdir_t>(page)) == 0)
      throw FileError("page " + std::to_string(page) + " is damaged");
    if (isAside(tiff.get())) continue;
    const Layout layout = layoutOf(tiff.get());
    pixels += std::uint64_t{layout.cols} * layout.rows;
    checkPixelCount(pixels, 1);
    channels.push_back(channelOf(tiff.get(), page, pages, description, bytes.size()));
  }
  if (channels.empty()) throw FileError("the file has no page that is no thumbnail");
  return channels;
}

}  // namespace mems_stiction
