/// NanoScope's images, from bytes by their definition.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "import/format_readers.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/maker_bytes.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

using namespace maker_bytes;

/// Two rows of three numbers, the lower one first.
NanoscopeImage image(std::size_t bytes_each) {
  NanoscopeImage made;
  made.cols = 3;
  made.rows = 2;
  made.bytes_each = static_cast<int>(bytes_each);
  made.size = "3 2 ~m";
  made.data.clear();
  for (const int number : {-3, 20, 7, 100, 0, -32768}) {
    for (std::size_t byte = 0; byte < bytes_each; ++byte)
      made.data += static_cast<char>(number >> 8 * byte & 0xFF);
  }
  return made;
}

std::string with(std::string bytes, const std::string& part, const std::string& other) {
  const std::size_t at = bytes.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  EXPECT_EQ(part.size(), other.size());  // the data stay where they are
  return bytes.replace(at, part.size(), other);
}

TEST(NanoscopeFile, HeightsAreVoltsTimesTheScannersSensitivity) {
  const std::vector<FileChannel> channels = parseNanoscope(nanoscope({image(2), image(2)}));
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_EQ(channels[1].id, 1);
  const FileChannel& channel = channels[0];
  EXPECT_EQ(channel.title, "Height");
  EXPECT_EQ(channel.unit_z, "m");
  EXPECT_DOUBLE_EQ(channel.width, 3e-6);
  EXPECT_DOUBLE_EQ(channel.height, 2e-6);
  ASSERT_EQ(channel.values.size(), cv::Size(3, 2));
  const double step = 24.57563 * 10e-9 / 65536.0;  // [m]
  EXPECT_NEAR(channel.values.at<double>(0, 0), 100 * step,
              1e-22);  // the last line of the file is the upper row
  EXPECT_NEAR(channel.values.at<double>(0, 2), -32768 * step, 1e-20);
  EXPECT_NEAR(channel.values.at<double>(1, 0), -3 * step, 1e-22);
}

TEST(NanoscopeFile, NewerVersionsHaveFourBytes) {
  const std::string bytes = with(nanoscope({image(4)}), "0x07200000", "0x09300201");
  const std::vector<FileChannel> channels = parseNanoscope(bytes);
  ASSERT_EQ(channels.size(), 1u);
  EXPECT_NEAR(channels[0].values.at<double>(1, 1), 20 * 24.57563 * 10e-9 / 4294967296.0, 1e-27);
}

TEST(NanoscopeFile, WhatIsNoLengthKeepsTheUnitOfItsRange) {
  const std::string bytes = with(nanoscope({image(2)}), "V 10.00000 nm/V", "V 10.00000     ");
  const std::vector<FileChannel> channels = parseNanoscope(bytes);
  ASSERT_EQ(channels.size(), 1u);
  EXPECT_EQ(channels[0].unit_z, "V");
  EXPECT_NEAR(channels[0].values.at<double>(1, 1), 20 * 24.57563 / 65536.0, 1e-15);
}

TEST(NanoscopeFile, MillivoltsAreVolts) {
  std::string bytes = with(nanoscope({image(2)}), "V 10.00000 nm/V", "V 10.00000     ");
  bytes = with(bytes, "24.57563 V", "24.5756 mV");
  const std::vector<FileChannel> channels = parseNanoscope(bytes);
  ASSERT_EQ(channels.size(), 1u);
  EXPECT_EQ(channels[0].unit_z, "V");
  EXPECT_NEAR(channels[0].values.at<double>(1, 1), 20 * 24.5756e-3 / 65536.0, 1e-18);
  const std::vector<FileChannel> heights =
      parseNanoscope(with(nanoscope({image(2)}), "24.57563 V", "24.5756 mV"));
  ASSERT_EQ(heights.size(), 1u);
  EXPECT_EQ(heights[0].unit_z, "m");
  EXPECT_NEAR(heights[0].values.at<double>(1, 1), 20 * 24.5756e-3 * 10e-9 / 65536.0, 1e-25);
}

TEST(NanoscopeFile, WhatIsSaidInAnotherWayIsLeftToGwyddion) {
  const std::string bytes = nanoscope({image(2), image(2)});
  EXPECT_EQ(parseNanoscope(bytes).size(), 2u);
  for (const auto& [part, other] : std::vector<std::pair<std::string, std::string>>{
           {"@2:Z scale: V [Sens. Zsens]", "@2:Z scale: V [Sens. Other]"},
           {"@2:Z scale: V [Sens", "@4:Z scale: V [Sens"},
           {"Ciao image list", "Ciao force list"},
           {"Bytes/pixel: 2", "Bytes/pixel: 4"},
           {"3750000 V/LSB", "3750000 V/XXX"},
           {"24.57563 V", "24.57563V "},
           {"24.57563 V", "24.57563 A"},
           {"S [Height]", "S  Height "},
           {"3 2 ~m", "3 2 ~V"},
           {"*File list", "*Fool list"}}) {
    const std::string changed = with(bytes, part, other);
    if (other == "Ciao force list") {
      EXPECT_EQ(parseNanoscope(changed).size(), 1u) << "no list of an image";
    } else {
      EXPECT_TRUE(parseNanoscope(changed).empty()) << other;
    }
  }
}

TEST(NanoscopeFile, NeedsNoGwyddion) {
  const ScratchFolder folder;
  ScanFileOptions options;
  options.import.gwyddion_reader = "no-such-program";
  const ScanFile scan = openScanFile(folder.write("scan.spm", nanoscope({{}, {}})), {}, options);
  EXPECT_EQ(scan.channel, "0: Height");
  EXPECT_DOUBLE_EQ(scan.surface.pitchX(), 1e-6 / 8);
  EXPECT_THROW(
      openScanFile(folder.write("cut.spm", nanoscope({{}, {}}).substr(0, 4300)), {}, options),
      FileError);
}

TEST(NanoscopeFile, IsReadUnderTheNameOfAText) {
  const ScratchFolder folder;
  for (const char* name : {"scan.txt", "scan.asc", "scan.csv"}) {
    const ScanFile scan = openScanFile(folder.write(name, nanoscope({{}, {}})));
    EXPECT_EQ(scan.channel, "0: Height") << name;
    EXPECT_DOUBLE_EQ(scan.surface.pitchX(), 1e-6 / 8) << name;
  }
}

}  // namespace
}  // namespace mems_stiction
