#include "mems_stiction/import/image_file.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cstdint>
#include <mutex>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/import/byte_cursor.hpp"
#include "mems_stiction/import/file_bytes.hpp"

namespace mems_stiction {
namespace {

/// OpenCV's readers and the libraries below them complain about damaged files on standard error by themselves. For the
/// life of this object the process's standard error is silent: the caller says what is wrong, in one line.
class SilentStandardError {
 public:
  SilentStandardError() : lock_(mutex()), saved_(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3)) {
    const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (saved_ >= 0 && nothing >= 0) dup2(nothing, STDERR_FILENO);
    if (nothing >= 0) close(nothing);
  }
  ~SilentStandardError() {
    if (saved_ < 0) return;
    dup2(saved_, STDERR_FILENO);
    close(saved_);
  }
  SilentStandardError(const SilentStandardError&) = delete;
  SilentStandardError& operator=(const SilentStandardError&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }

  std::lock_guard<std::mutex> lock_;  // two at a time would save each other's silence
  int saved_;
};

cv::Mat decoded(const std::string& bytes) {
  cv::Mat pixels;
  try {
    const SilentStandardError silent;
    const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
    pixels = cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    throw FileError("OpenCV cannot read it: " + error.err);
  }
  if (pixels.empty()) throw FileError("the image cannot be read: cut off, damaged, or of a kind OpenCV lacks");
  return pixels;
}

/// The part of an OpenEXR header that matters here.
struct ExrHeader {
  std::vector<std::string> channels;
  std::size_t first_name = 0;  ///< where the first channel's name begins in the file
  std::int64_t cols = 0, rows = 0;
};

ExrHeader exrHeader(const std::string& bytes) {
  ByteCursor cursor(bytes.data(), bytes.size(), "the EXR header");
  cursor.take(4);
  const auto version = cursor.number<std::uint32_t>();
  if ((version & 0x1000u) != 0) throw FileError("an EXR file of several parts is no scan");
  ExrHeader header;
  for (;;) {
    const std::string name = cursor.text();
    if (name.empty()) break;
    cursor.text();  // type
    ByteCursor value = cursor.array(cursor.number<std::uint32_t>(), 1);
    if (name == "dataWindow") {
      const auto left = value.number<std::int32_t>();
      const auto top = value.number<std::int32_t>();
      header.cols = std::int64_t{value.number<std::int32_t>()} - left + 1;
      header.rows = std::int64_t{value.number<std::int32_t>()} - top + 1;
    }
    if (name != "channels") continue;
    header.first_name = bytes.size() - cursor.size() - value.size();
    while (!value.atEnd()) {
      const std::string channel = value.text();
      if (channel.empty()) break;
      header.channels.push_back(channel);
      value.take(16);  // type, linearity, sampling
    }
  }
  if (header.cols <= 0 || header.rows <= 0) throw FileError("the EXR header has no size: damaged");
  return header;
}

}  // namespace

FileChannel parsePng(const std::string& bytes) {
  ByteCursor cursor(bytes.data(), bytes.size(), "the PNG header", ByteOrder::kBig);
  cursor.take(12);
  if (std::string(cursor.take(4), 4) != "IHDR") throw FileError("the image cannot be read: its header is damaged");
  const auto cols = cursor.number<std::uint32_t>();
  const auto rows = cursor.number<std::uint32_t>();
  const int bits = cursor.number<std::uint8_t>();
  checkPixelCount(cols, rows);
  FileChannel channel;
  channel.takes_settings = true;
  channel.values = decoded(bytes);
  // OpenCV spreads counts of 1, 2 and 4 bits over 0 to 255, by whole factors.
  if (bits < 8 && channel.values.type() == CV_8UC1) channel.values /= 255 / ((1 << bits) - 1);
  return channel;
}

FileChannel parseExr(const std::string& bytes) {
  // OpenCV has its OpenEXR reader switched off unless this says otherwise.
  static std::once_flag once;
  std::call_once(once, [] { setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 0); });
  const ExrHeader header = exrHeader(bytes);
  checkPixelCount(static_cast<std::uint64_t>(header.cols), static_cast<std::uint64_t>(header.rows));
  std::string names;
  for (const std::string& name : header.channels) names += (names.empty() ? "" : ", ") + name;
  if (header.channels.size() != 1) {
    throw FileError(std::to_string(header.channels.size()) + " channels per pixel (" + names +
                    ") are a picture, a height map has 1");
  }
  const std::string& name = header.channels.front();
  if (name.size() != 1) throw FileError("its channel '" + name + "' has a name of several letters: call it Y or Z");
  FileChannel channel;
  channel.takes_settings = true;
  channel.title = name;
  std::string as_luminance = bytes;  // the only name that OpenCV takes for a single channel
  as_luminance[header.first_name] = 'Y';
  channel.values = decoded(as_luminance);
  if (channel.values.cols != header.cols || channel.values.rows != header.rows || channel.values.channels() != 1) {
    throw FileError("OpenCV does not read the image that its header states");
  }
  return channel;
}

}  // namespace mems_stiction
