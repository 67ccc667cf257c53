
#include <gtest/gtest.h>

#include "import/channel_choice.hpp"
#include "import/format_readers.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "support/scan_bytes.hpp"

namespace mems_stiction {
namespace {

using namespace scan_bytes;

std::string refusal(FileChannel (*parse)(const std::string&), const std::string& bytes) {
  try {
    parse(bytes);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

// ---- PNG, chunk by chunk

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
  EXPECT_NE(refusal(parsePng, png(30000, 30000, 8, "x"))
                .find("30000 x 30000 pixels are more than the 100000000"),
            std::string::npos);
}

// ---- OpenEXR

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
  EXPECT_NE(refusal(parseExr, exr({"A", "Z"}, 5, 4)).find("2 channels per pixel (A, Z)"),
            std::string::npos);
}

TEST(ExrFile, TheSizeInTheHeaderIsReadBeforeMemoryIsTaken) {
  EXPECT_NE(refusal(parseExr, exr({"Y"}, 30000, 1)
                                  .replace(exr({"Y"}, 30000, 1).find("box2i") + 6 + 4 + 12, 4,
                                           littleBytes(std::int32_t{29999})))
                .find("30000 x 30000 pixels"),
            std::string::npos);
}

}  // namespace
}  // namespace mems_stiction
