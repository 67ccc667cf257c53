/// Text that NanoScope Analysis exports: points in columns under the instrument's heading.

#include <gtest/gtest.h>

#include <cmath>

#include "import/format_readers.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

std::string exported(const std::string& points, const std::string& size = "1.5 \xB5m") {
  return "\"\\*File list\"\r\n\"\\Version: 0x09150300\"\r\n\"\\Scan Size: " + size +
         "\"\r\n\"\\Samps/line: 3\"\r\n\"\\Lines: 2\"\r\n\"\\*Ciao image list\"\r\n\"\\Samps/line: "
         "3\"\r\n\r\n"
         "Height_Sensor(nm)\tAdhesion(nN)\t\r\n" +
         points;
}

const std::string kPoints =
    "1.5\t0.1\t\r\n2.5\t0.2\t\r\n-3.5\t0.3\t\r\n4.5\t0.4\t\r\n---\t0.5\t\r\n6.5\t0.6\t\r\n";

std::string refusal(const std::string& text) {
  try {
    parseNanoscopeText(text);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

TEST(NanoscopeText, HasAChannelForEachColumn) {
  const std::vector<FileChannel> channels = parseNanoscopeText(exported(kPoints));
  ASSERT_EQ(channels.size(), 2U);
  EXPECT_EQ(channels[0].title, "Height Sensor");
  EXPECT_EQ(channels[1].unit_z, "nN");
  ASSERT_EQ(channels[0].values.size(), cv::Size(3, 2));
  EXPECT_DOUBLE_EQ(channels[0].values.at<double>(0, 2), -3.5e-9);
  EXPECT_TRUE(std::isnan(channels[0].values.at<double>(1, 1)));
  EXPECT_DOUBLE_EQ(channels[1].values.at<double>(1, 2), 0.6);
}

TEST(NanoscopeText, SaysWhenAndWithWhatItWasMeasured) {
  const std::string text = exported(kPoints);
  const std::size_t lists = text.find("\"\\Scan Size");
  const ScanIdentity identity =
      parseNanoscopeText(
          text.substr(0, lists) +
          "\"\\Date: 01:33:51 PM Mon Dec 15 2014\"\r\n\"\\Microscope: Dimension V\"\r\n" +
          text.substr(lists))[1]
          .identity;
  EXPECT_EQ(identity.acquisition_time, "2014-12-15T13:33:51");
  EXPECT_EQ(identity.instrument, "Dimension V");
}

TEST(NanoscopeText, IsReadAsAScan) {
  const ScratchFolder folder;
  const HeightMap surface = readScanFile(folder.write("scan.txt", exported(kPoints)));
  EXPECT_DOUBLE_EQ(surface.pitchX(), 0.5e-6);
  EXPECT_DOUBLE_EQ(surface.pitchY(), 0.5e-6);
  EXPECT_DOUBLE_EQ(surface.height(1, 0), 4.5e-9);
  EXPECT_DOUBLE_EQ(readScanFile(folder.write("long.txt", exported(kPoints, "300 100 nm"))).pitchY(),
                   50e-9);
}

TEST(NanoscopeText, TheMatrixOfOneChannelIsRead) {
  std::string text = exported("1.5\t2.5\t-3.5\t\r\n4.5\t-nan(ind)\t6.5\t\r\n");
  text.replace(text.find("\tAdhesion(nN)"), 13, "");
  const std::vector<FileChannel> channels = parseNanoscopeText(text);
  ASSERT_EQ(channels.size(), 1U);
  ASSERT_EQ(channels[0].values.size(), cv::Size(3, 2));
  EXPECT_DOUBLE_EQ(channels[0].values.at<double>(0, 2), -3.5e-9);
  EXPECT_TRUE(std::isnan(channels[0].values.at<double>(1, 1)));
  EXPECT_NE(refusal(text.substr(0, text.find("4.5"))).find("cut off"), std::string::npos);
  std::string current = text;
  current.replace(current.find("Height_Sensor(nm)"), 17, "TUNA(A)");
  EXPECT_EQ(parseNanoscopeText(current)[0].unit_z, "A");
}

TEST(NanoscopeText, WhatIsCutOffOrOfAnotherKindIsRefused) {
  EXPECT_NE(refusal(exported(kPoints.substr(0, 40))).find("cut off"), std::string::npos);
  EXPECT_NE(refusal(exported(kPoints + "7.5\t0.7\t\r\n")).find("more points"), std::string::npos);
  EXPECT_NE(refusal(exported("1.5\t0.1\t9\r\n")).find("3 numbers under 2 names"),
            std::string::npos);
  EXPECT_NE(refusal(exported("1.5\tx\r\n")).find("column 2"), std::string::npos);
  EXPECT_NE(refusal(exported(kPoints, "3 bars")).find("no length"), std::string::npos);
  EXPECT_NE(refusal("\\*File list\n\\Lines: 2\n1.5 2.5\n").find("does not name the columns"),
            std::string::npos);
  EXPECT_NE(refusal("\\*File list\nHeight(nm)\n1.5\n").find("no Samps/line"), std::string::npos);
  std::string many = exported(kPoints);
  many.replace(many.find("Lines: 2"), 8, "Lines: 9" + std::string(80, '0'));
  EXPECT_NE(refusal(many).find("no Samps/line"), std::string::npos);
}

}  // namespace
}  // namespace mems_stiction
