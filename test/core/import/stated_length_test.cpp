/// Files whose bytes are not what their own headers state: each is refused, with the two figures.

#include <gtest/gtest.h>

#include <map>

#include "import/file_checks.hpp"
#include "import/nanoscope_check.hpp"
#include "import/stated_twice.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "support/maker_bytes.hpp"

namespace mems_stiction {
namespace {

using namespace maker_bytes;

template <typename Check>
std::string complaint(Check&& check, const std::string& bytes) {
  try {
    check(bytes);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string everywhere(const std::string& text, const std::string& from, const std::string& to) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t next = std::min(text.find(from, at), text.size());
    result += text.substr(at, next - at) + (next < text.size() ? to : "");
    at = next + from.size();
  }
  return result;
}

const std::map<std::string, std::string>& makers() {
  static const std::map<std::string, std::string> kMakers = {
      {"MetroPro", metroPro()},
      {"Alicona", alicona()},
      {"Agilent of 16 bits", agilent("BINARY", 2)},
      {"Agilent of 32 bits", agilent("BINARY_32", 4)},
      {"Aarhus", aarhus()},
      {"Createc of 16 bits", createc("[Parameter]")},
      {"Createc of 32 bits", createc("[Paramet32]")},
      {"Createc, compressed", createc("[Paramco32]")},
      {"MATRIX", matrix()},
      {"Nanosurf", nanosurf()},
      {"Wyko", wyko()},
  };
  return kMakers;
}

TEST(StatedLength, ASoundFileIsTaken) {
  for (const auto& [maker, bytes] : makers())
    EXPECT_EQ(complaint(checkStatedLength, bytes), "") << maker;
  EXPECT_EQ(complaint(checkStatedLength, surfstand()), "");
  EXPECT_EQ(complaint(checkStatedLength, "anything else"), "");
}

TEST(StatedLength, BytesTooFewAreRefused) {
  for (const auto& [maker, bytes] : makers()) {
    for (const std::size_t missing : {1, 2, 7}) {
      const std::string cut = bytes.substr(0, bytes.size() - missing);
      EXPECT_TRUE(mentions(complaint(checkStatedLength, cut), "cut off"))
          << maker << " " << missing;
    }
  }
}

TEST(StatedLength, BytesTooManyAreRefused) {
  for (const auto& [maker, bytes] : makers()) {
    if (maker == "Createc, compressed") continue;  // the stream says where it ends
    EXPECT_TRUE(mentions(complaint(checkStatedLength, bytes + "surplus"), "its header states"))
        << maker;
  }
}

TEST(StatedLength, FillerBehindCreatecDataIsNoSurplus) {
  const std::string bytes = createc("[Paramet32]");
  EXPECT_EQ(complaint(checkStatedLength, bytes + std::string(8188, '\0')), "");
  EXPECT_NE(complaint(checkStatedLength, bytes + std::string(20000, '\0')), "");
  const std::string halved = replaced(createc("[Paramco32]"), "Num.Y=4", "Num.Y=2");
  EXPECT_TRUE(mentions(complaint(checkStatedLength, halved), "its header states"))
      << "half of the data is no filler";
}

TEST(StatedLength, ACreatecHeaderThatEndsWithItsTextIsFilledUp) {
  std::string whole = createc("[Paramco32]");
  whole.replace(16380, 4, "DATA");
  EXPECT_FALSE(withWholeCreatecHeader(whole)) << "its data are where they are looked for";
  const std::string text = whole.substr(0, whole.find('\0')) + "Comment=DATAxy of DATA\r\n";
  const auto filled = withWholeCreatecHeader(text + whole.substr(16380));
  ASSERT_TRUE(filled);
  EXPECT_EQ(filled->substr(16380), whole.substr(16380));
  EXPECT_EQ(filled->substr(0, text.size()), text);
  EXPECT_EQ(complaint(checkStatedLength, *filled), "");
  EXPECT_FALSE(withWholeCreatecHeader(text + "DATA"));
  EXPECT_FALSE(withWholeCreatecHeader("[Paramet32]" + text.substr(11) + whole.substr(16380)));
  const auto cut = withWholeCreatecHeader((text + whole.substr(16380)).substr(0, text.size() + 40));
  ASSERT_TRUE(cut);
  EXPECT_TRUE(mentions(complaint(checkStatedLength, *cut), "cut off"));
}

TEST(StatedLength, SurfstandTextHasTheHeightsThatItStates) {
  const std::string bytes = surfstand();
  EXPECT_TRUE(
      mentions(complaint(checkStatedLength, bytes.substr(0, bytes.size() - 3)), "last number"));
  EXPECT_TRUE(mentions(complaint(checkStatedLength, bytes.substr(0, bytes.size() - 8)),
                       "5 heights, its header states 6"));
  EXPECT_TRUE(
      mentions(complaint(checkStatedLength, replaced(bytes, "NumProfiles = 2", "NumProfiles = 1")),
               "its header states 3"));
}

// ---- NanoScope

TEST(Nanoscope, ASoundFileIsTaken) {
  EXPECT_EQ(complaint(checkedNanoscope, nanoscope({{}, {}})), "");
  EXPECT_TRUE(checkedNanoscope(nanoscope({{}, {}})).notes.empty());
}

TEST(Nanoscope, AFileOfAnotherLengthIsRefused) {
  const std::string bytes = nanoscope({{}, {}});
  EXPECT_TRUE(
      mentions(complaint(checkedNanoscope, bytes + "x"), "has 4353 bytes, its header states 4352"));
  EXPECT_TRUE(mentions(complaint(checkedNanoscope, bytes.substr(0, 4300)), "cut off"));
  EXPECT_NE(complaint(checkedNanoscope, everywhere(bytes, "\n", "\r\n")), "");
  EXPECT_NE(complaint(checkedNanoscope, everywhere(bytes, "\r\n", "\n")), "");
}

TEST(Nanoscope, EachImageIsAsLongAsItsSamplesAndLines) {
  for (const std::string key : {"Samps/line: 8\r\n\\Number", "Number of lines: 8"}) {
    const std::string other = replaced(nanoscope({{}, {}}), key, everywhere(key, "8", "4"));
    EXPECT_TRUE(mentions(complaint(checkedNanoscope, other), "contradicts itself")) << key;
  }
  NanoscopeImage wide;
  wide.data += "ab";
  EXPECT_TRUE(
      mentions(complaint(checkedNanoscope, nanoscope({{}, wide})), "are not the 130 bytes"));
}

TEST(Nanoscope, PixelsAreSquareWhereTheHeaderSaysSo) {
  NanoscopeImage image;
  image.cols = 16;
  image.rows = 4;
  EXPECT_TRUE(mentions(complaint(checkedNanoscope, nanoscope({image})), "aspect ratio 1:1"));
  image.size = "1 0.25 ~m";
  EXPECT_EQ(complaint(checkedNanoscope, nanoscope({image})), "");
}

TEST(Nanoscope, ImagesDoNotOverlap) {
  const std::string bytes = replaced(nanoscope({{}, {}}), "Data offset: 4224", "Data offset: 4222");
  EXPECT_TRUE(mentions(complaint(checkedNanoscope, bytes), "begin inside"));
}

TEST(Nanoscope, AnotherSizeOfTheScanIsSaid) {
  const auto notes = checkedNanoscope(nanoscope({{}}, "2000 nm")).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(mentions(notes[0], "scan size"));
}

TEST(Nanoscope, ThePiezoReachesItsVoltageTimesItsSensitivity) {
  EXPECT_NEAR(checkedNanoscope(nanoscope({{}})).reach, 1e-6, 1e-15);
  EXPECT_EQ(checkedNanoscope("another file").reach, 0.0);
}

// ---- any format

TEST(Transfer, BinaryDataWithLineEndsOfTextAreRefused) {
  const std::string bytes = std::string("header\n\0", 8) + noise(40000);
  EXPECT_EQ(complaint(checkTransfer, bytes), "");
  EXPECT_TRUE(mentions(complaint(checkTransfer, everywhere(bytes, "\n", "\r\n")), "as text"));
  EXPECT_EQ(complaint(checkTransfer, everywhere(std::string(300, '\n'), "\n", "1 2 3\r\n")), "")
      << "text may have them";
}

TEST(Transfer, BytesReplacedAsNoUtf8AreRefused) {
  std::string bytes("header\n\0", 8);
  for (const char c : noise(4000))
    bytes += (c & 0x80) != 0 ? std::string("\xEF\xBF\xBD") : std::string(1, c);
  EXPECT_TRUE(mentions(complaint(checkTransfer, bytes), "U+FFFD"));
}

TEST(Transfer, WhatStandsInForAFileIsNamed) {
  EXPECT_TRUE(
      mentions(complaint(checkTransfer,
                         "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"),
               "Git LFS"));
  EXPECT_TRUE(mentions(complaint(checkTransfer, "<!DOCTYPE html>\n<html></html>"), "web page"));
}

TEST(StatedTwice, ASizeOrGainThatDiffersIsRefused) {
  const std::string sxm =
      ":NANONIS_VERSION:\n2\n:SCAN_PIXELS:\n       256       256\n:SCAN_RANGE:\n  1.0E-8  "
      "1.0E-8\n:Comment:\n:COMMENT:\n"
      "first\n";
  const std::string end = ":SCANIT_END:\n\x1A\x04:SCAN_PIXELS:\n1 1\n";
  EXPECT_EQ(complaint(checkStatedTwice, sxm + end), "");
  EXPECT_EQ(complaint(checkStatedTwice, sxm + ":SCAN_PIXELS:\n256 256\n" + end), "") << "the same";
  EXPECT_TRUE(mentions(complaint(checkStatedTwice, sxm + ":SCAN_PIXELS:\n128 256\n" + end),
                       "'scan_pixels' twice, as '256 256' and '128 256'"));
  EXPECT_TRUE(mentions(complaint(checkStatedTwice, sxm + ":scan_range:\n2.0E-8 1.0E-8\n" + end),
                       "'scan_range' twice"));
  EXPECT_TRUE(mentions(complaint(checkStatedTwice, sxm + ":DATA_INFO:\na\n:DATA_INFO:\nb\n" + end),
                       "'data_info' twice"));
  for (const char* kind : {"[Parameter]", "[Paramet32]", "[Paramco32]"}) {
    const std::string header =
        std::string(kind) + "\r\nNum.X / Num.X=3\r\nGainZ / GainZ=10\r\nTitle=a\r\nTitle=b\r\n";
    EXPECT_EQ(complaint(checkStatedTwice, header + "GainZ=10\r\n"), "");
    EXPECT_TRUE(mentions(complaint(checkStatedTwice, header + "GainZ=1\r\n"),
                         "'gainz' twice, as '10' and '1'"));
    EXPECT_TRUE(
        mentions(complaint(checkStatedTwice, header + "Num.X / Num.X=4\r\n"), "'num.x' twice"));
  }
}

}  // namespace
}  // namespace mems_stiction
