#include "import/format_readers.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <png.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "import/byte_cursor.hpp"
#include "import/file_bytes.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

/// The file in memory, as libpng's callback sees it.
struct PngSource {
  const char* at;
  std::size_t left;
};

void readPngSource(png_structp png, png_bytep target, std::size_t count) {
  auto& source = *static_cast<PngSource*>(png_get_io_ptr(png));
  if (count > source.left) png_error(png, "cut off");
  std::memcpy(target, source.at, count);
  source.at += count;
  source.left -= count;
}

// libpng leaves a damaged image by longjmp(); nothing is said by itself.
void leavePng(png_structp png, png_const_charp) { png_longjmp(png, 1); }
void ignorePngWarning(png_structp, png_const_charp) {}

/// libpng's two structures, freed with the object.
struct PngReader {
  PngReader()
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, leavePng, ignorePngWarning)) {
    if (png != nullptr) info = png_create_info_struct(png);
  }
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  png_structp png;
  png_infop info = nullptr;
};

/// Everything up to the pixels. No object with a destructor lives in the functions that libpng
/// jumps out of.
bool readPngHeader(PngReader& reader, PngSource& source) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_set_read_fn(reader.png, &source, readPngSource);
  png_set_user_limits(reader.png, 0x7FFFFFFF, 0x7FFFFFFF);  // the pixels are counted already
  png_read_info(reader.png, reader.info);
  png_set_packing(reader.png);  // one count a byte, not scaled
  if (png_get_bit_depth(reader.png, reader.info) == 16) png_set_swap(reader.png);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool readPngPixels(PngReader& reader, png_bytepp lines) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_read_image(reader.png, lines);
  png_read_end(reader.png, nullptr);
  return true;
}

/// The file in memory, as OpenEXR sees it.
class ExrSource : public Imf::IStream {
 public:
  explicit ExrSource(const std::string& bytes) : Imf::IStream("scan"), bytes_(bytes) {}

  bool read(char target[], int count) override {
    if (count < 0 || static_cast<std::uint64_t>(count) >
                         bytes_.size() - std::min<std::uint64_t>(at_, bytes_.size())) {
      throw FileError("the EXR file is cut off");
    }
    std::memcpy(target, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::uint64_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  const std::string& bytes_;
  std::uint64_t at_ = 0;
};

/// The channel as float32, or double where it has integers of 32 bits.
cv::Mat exrPixels(Imf::InputFile& file, const std::string& name, Imf::PixelType type, int cols,
                  int rows) {
  const bool is_integer = type == Imf::UINT;
  cv::Mat raw(rows, cols, is_integer ? CV_32SC1 : CV_32FC1);
  Imf::FrameBuffer frame;
  frame.insert(name, Imf::Slice::Make(is_integer ? Imf::UINT : Imf::FLOAT, raw.data,
                                      file.header().dataWindow(), sizeof(float),
                                      sizeof(float) * static_cast<std::size_t>(cols)));
  file.setFrameBuffer(frame);
  file.readPixels(file.header().dataWindow().min.y, file.header().dataWindow().max.y);
  if (!is_integer) return raw;
  cv::Mat wide(rows, cols, CV_64FC1);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      wide.at<double>(row, col) =
          static_cast<double>(static_cast<std::uint32_t>(raw.at<std::int32_t>(row, col)));
    }
  }
  return wide;
}

/// Before the library takes memory for lines and tables. @throw FileError without a file name
void checkExrSize(const std::string& bytes) {
  ByteCursor cursor(bytes.data(), bytes.size(), "the EXR header");
  cursor.take(8);
  for (std::string name = cursor.text(); !name.empty(); name = cursor.text()) {
    cursor.text();  // type
    ByteCursor value = cursor.array(cursor.number<std::uint32_t>(), 1);
    if (name != "dataWindow") continue;
    const auto left = value.number<std::int32_t>();
    const auto top = value.number<std::int32_t>();
    const std::int64_t cols = std::int64_t{value.number<std::int32_t>()} - left + 1;
    const std::int64_t rows = std::int64_t{value.number<std::int32_t>()} - top + 1;
    checkPixelCount(static_cast<std::uint64_t>(std::max<std::int64_t>(cols, 0)),
                    static_cast<std::uint64_t>(std::max<std::int64_t>(rows, 0)));
  }
}

FileChannel readExr(const std::string& bytes) {
  checkExrSize(bytes);
  ExrSource source(bytes);
  Imf::InputFile file(source, 1);
  const Imf::ChannelList& channels = file.header().channels();
  const auto window = file.header().dataWindow();
  const int cols = window.max.x - window.min.x + 1;
  const int rows = window.max.y - window.min.y + 1;
  std::string names;
  int count = 0;
  for (auto entry = channels.begin(); entry != channels.end(); ++entry, ++count) {
    names += (names.empty() ? "" : ", ") + std::string(entry.name());
  }
  if (count != 1) {
    throw FileError(std::to_string(count) + " channels per pixel (" + names +
                    ") are a picture, a height map has 1");
  }
  const Imf::Channel& only = channels.begin().channel();
  if (only.xSampling != 1 || only.ySampling != 1)
    throw FileError("its channel does not have a value for each pixel");
  FileChannel channel;
  channel.takes_settings = true;
  channel.title = names;
  channel.values = exrPixels(file, names, only.type, cols, rows);
  return channel;
}

}  // namespace

FileChannel parsePng(const std::string& bytes) {
  const std::string damaged = "the image cannot be read: cut off or damaged";
  ByteCursor cursor(bytes.data(), bytes.size(), "the PNG header", ByteOrder::kBig);
  cursor.take(12);
  if (std::string(cursor.take(4), 4) != "IHDR") throw FileError(damaged);
  const auto cols = cursor.number<std::uint32_t>();
  const auto rows = cursor.number<std::uint32_t>();
  checkPixelCount(cols, rows);
  PngReader reader;
  PngSource source{bytes.data(), bytes.size()};
  if (reader.info == nullptr || !readPngHeader(reader, source)) throw FileError(damaged);
  const bool has_table =
      (png_get_color_type(reader.png, reader.info) & PNG_COLOR_MASK_PALETTE) != 0;
  const int samples = has_table ? 3 : png_get_channels(reader.png, reader.info);
  const int depth = png_get_bit_depth(reader.png, reader.info) == 16 ? CV_16U : CV_8U;
  FileChannel channel;
  channel.takes_settings = true;
  channel.values =
      cv::Mat::zeros(static_cast<int>(rows), static_cast<int>(cols), CV_MAKETYPE(depth, samples));
  if (samples > 1) return channel;  // a picture: listed, not read
  std::vector<png_bytep> lines;
  lines.reserve(rows);
  for (int row = 0; row < channel.values.rows; ++row) lines.push_back(channel.values.ptr(row));
  if (!readPngPixels(reader, lines.data())) throw FileError(damaged);
  return channel;
}

FileChannel parseExr(const std::string& bytes) {
  try {
    return readExr(bytes);
  } catch (const FileError&) {
    throw;
  } catch (const std::exception&) {
    throw FileError("the image cannot be read: cut off, damaged, or of a kind OpenEXR lacks");
  }
}

}  // namespace mems_stiction
