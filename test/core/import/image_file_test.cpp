#include "mems_stiction/import/image_file.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/import/channel_choice.hpp"
#include "support/binary_writer.hpp"

namespace mems_stiction {
namespace {

std::string refusal(FileChannel (*parse)(const std::string&), const std::string& bytes) {
  try {
    parse(bytes);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

// ---- PNG, chunk by chunk

std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto checksum =
      static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size())));
  return bigBytes(static_cast<std::uint32_t>(data.size())) + body + bigBytes(checksum);
}

std::string png(std::uint32_t cols, std::uint32_t rows, int bits, const std::string& lines) {
  std::string packed(lines.size() + 100, '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(lines.data()), lines.size());
  packed.resize(size);
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", bigBytes(cols) + bigBytes(rows) + static_cast<char>(bits) + std::string(4, '\0')) +
         chunk("IDAT", packed) + chunk("IEND", "");
}

TEST(PngFile, CountsOfFewBitsAreNotScaled) {
  // Each line begins with its filter, 0.
  const cv::Mat four = parsePng(png(4, 2, 4, std::string("\0\x01\x2F\0\xE0\x70", 6))).values;
  ASSERT_EQ(four.size(), cv::Size(4, 2));
  EXPECT_EQ(four.at<std::uint8_t>(0, 1), 1);
  EXPECT_EQ(four.at<std::uint8_t>(0, 3), 15);
  EXPECT_EQ(four.at<std::uint8_t>(1, 0), 14);
  const cv::Mat one = parsePng(png(8, 2, 1, std::string("\0\x81\0\x00", 4))).values;
  EXPECT_EQ(one.at<std::uint8_t>(0, 0), 1);
  EXPECT_EQ(one.at<std::uint8_t>(0, 1), 0);
}

TEST(PngFile, TheSizeInTheHeaderIsReadBeforeMemoryIsTaken) {
  EXPECT_NE(refusal(parsePng, png(30000, 30000, 8, "x")).find("30000 x 30000 pixels are more than the 100000000"),
            std::string::npos);
}

// ---- OpenEXR

/// One line a block, no compression, float32 channels.
std::string exr(const std::vector<std::string>& channels, std::int32_t cols, std::int32_t rows) {
  const auto attribute = [](const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + littleBytes(static_cast<std::int32_t>(value.size())) + value;
  };
  std::string list;
  for (const std::string& channel : channels) {
    list += channel + '\0' + littleBytes(std::int32_t{2}) + std::string(4, '\0') + littleBytes(std::int32_t{1}) +
            littleBytes(std::int32_t{1});
  }
  const std::string window = std::string(8, '\0') + littleBytes(cols - 1) + littleBytes(rows - 1);
  std::string bytes = "\x76\x2f\x31\x01" + littleBytes(std::int32_t{2}) + attribute("channels", "chlist", list + '\0') +
                      attribute("compression", "compression", std::string(1, '\0')) +
                      attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window) +
                      attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
                      attribute("pixelAspectRatio", "float", littleBytes(1.0F)) +
                      attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
                      attribute("screenWindowWidth", "float", littleBytes(1.0F)) + '\0';
  const auto line_size = static_cast<std::int32_t>(4 * static_cast<int>(channels.size()) * cols);
  std::uint64_t offset = bytes.size() + 8 * static_cast<std::uint64_t>(rows);
  for (std::int32_t row = 0; row < rows; ++row, offset += 8 + static_cast<std::uint64_t>(line_size))
    bytes += littleBytes(offset);
  for (std::int32_t row = 0; row < rows; ++row) {
    bytes += littleBytes(row) + littleBytes(line_size);
    for (std::size_t channel = 0; channel < channels.size(); ++channel) {
      for (std::int32_t col = 0; col < cols; ++col) bytes += littleBytes(static_cast<float>(10 * row + col));
    }
  }
  return bytes;
}

TEST(ExrFile, ASingleChannelIsReadWhateverItsName) {
  for (const std::string name : {"Y", "Z", "R", "height"}) {
    const cv::Mat values = parseExr(exr({name}, 5, 4)).values;
    ASSERT_EQ(values.size(), cv::Size(5, 4)) << name;
    for (int row = 0; row < 4; ++row) {
      for (int col = 0; col < 5; ++col)
        EXPECT_EQ(values.at<float>(row, col), static_cast<float>(10 * row + col)) << name;
    }
  }
}

TEST(ExrFile, OtherChannelsAreRefusedByName) {
  EXPECT_NE(refusal(parseExr, exr({"A", "Z"}, 5, 4)).find("2 channels per pixel (A, Z)"), std::string::npos);
}

TEST(ExrFile, TheSizeInTheHeaderIsReadBeforeMemoryIsTaken) {
  EXPECT_NE(refusal(parseExr,
                    exr({"Y"}, 30000, 1)
                        .replace(exr({"Y"}, 30000, 1).find("box2i") + 6 + 4 + 12, 4, littleBytes(std::int32_t{29999})))
                .find("30000 x 30000 pixels"),
            std::string::npos);
}

}  // namespace
}  // namespace mems_stiction
