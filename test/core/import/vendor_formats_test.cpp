/// Formats of instruments and programs that are read here, from bytes by their definitions.

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdlib>

#include "import/channel_choice.hpp"
#include "import/format_readers.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/scan_bytes.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

using namespace scan_bytes;

template <typename Function>
std::string refusal(Function&& read) {
  try {
    read();
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// ---- WSxM

TEST(WsxmFile, TheMicroSignOfLatin1IsRead) {
  for (const std::string micro : {"\xB5", "\xC2\xB5", "u"}) {
    const FileChannel channel =
        parseWsxm(wsxm("double", "2 " + micro + "m", "5 nm", wsxmDoubles()));
    EXPECT_DOUBLE_EQ(channel.width, 2e-6);
    EXPECT_EQ(channel.unit_z, "m");
    // Upside down and mirrored: the first number is the last pixel.
    EXPECT_DOUBLE_EQ(channel.values.at<double>(1, 2), 0.0);
    EXPECT_DOUBLE_EQ(channel.values.at<double>(0, 0), 5e-9);
  }
}

TEST(WsxmFile, IntegersSpanTheAmplitude) {
  std::string data;
  for (const int value : {100, 200, 150, 300, 100, 100})
    data += littleBytes(static_cast<std::int16_t>(value));
  const FileChannel channel = parseWsxm(wsxm("short", "2 nm", "1 nm", data));
  const double range =
      channel.values.at<double>(0, 2) - channel.values.at<double>(1, 2);  // 300 - 100
  EXPECT_NEAR(range, 1e-9, 1e-22);
}

TEST(WsxmFile, EveryCutIsRefused) {
  const std::string whole = wsxm("double", "2 nm", "5 nm", wsxmDoubles());
  for (std::size_t size = 60; size < whole.size(); ++size) {
    EXPECT_THROW(parseWsxm(whole.substr(0, size)), FileError) << size << " of " << whole.size();
  }
}

TEST(WsxmFile, ASizeThatDoesNotMatchTheFileIsRefused) {
  std::string bytes = wsxm("double", "2 nm", "5 nm", wsxmDoubles());
  const std::string rows = "Number of rows: ";
  bytes[bytes.find(rows) + rows.size()] = '1';
  EXPECT_TRUE(mentions(refusal([&] { parseWsxm(bytes); }), "its header states"));
}

TEST(WsxmFile, DataThatBeginBeforeTheFileAreRefused) {
  std::string bytes = wsxm("double", "2 nm", "5 nm", wsxmDoubles());
  bytes.replace(bytes.find("Number of rows: 2"), 17,
                "Number of rows: 99");  // 2376 bytes of numbers
  const std::string key = "header size: ";
  const std::size_t size = bytes.find(key) + key.size();
  bytes.replace(size, bytes.find('\r', size) - size, "-0000");
  bytes.replace(size, 5, std::to_string(static_cast<int>(bytes.size()) - 99 * 3 * 8));
  EXPECT_TRUE(mentions(refusal([&] { parseWsxm(bytes); }), "its header states"));
}

TEST(WsxmFile, OneByteTooManyIsRefused) {
  EXPECT_TRUE(
      mentions(refusal([] { parseWsxm(wsxm("double", "2 nm", "5 nm", wsxmDoubles() + "x")); }),
               "its header states"));
}

TEST(WsxmFile, OtherExtremesThanTheHeaderStatesAreRefused) {
  const auto read = [](const std::string& largest) {
    return refusal([&] {
      parseWsxm(wsxm("double", "2 nm", "5 nm\r\n[Miscellaneous]\r\n    Maximum: " + largest,
                     wsxmDoubles()));
    });
  };
  EXPECT_EQ(read("5"), "");
  EXPECT_EQ(read("5.00001"), "") << "rounded";
  EXPECT_TRUE(mentions(read("6"), "the data have 5"));
}

TEST(WsxmFile, VoltsAreNoHeights) {
  const FileChannel channel = parseWsxm(wsxm("double", "2 nm", "5 V", wsxmDoubles()));
  EXPECT_EQ(channel.unit_z, "V");
  EXPECT_THROW(chooseHeightChannel({channel}), FileError);
}

// ---- Digital Surf

TEST(SurFile, PointsThatWereNotMeasuredAreMissing) {
  for (const bool is_compressed : {false, true}) {
    Sur kind;
    kind.is_compressed = is_compressed;
    const auto channels = parseSur(sur(kind));
    ASSERT_EQ(channels.size(), 1u);
    const cv::Mat& values = channels[0].values;
    EXPECT_TRUE(std::isnan(values.at<double>(0, 2)));
    EXPECT_DOUBLE_EQ(values.at<double>(0, 0), 5e-9);
    EXPECT_DOUBLE_EQ(values.at<double>(1, 2), 25e-9);
    EXPECT_DOUBLE_EQ(channels[0].width, 3 * 0.25e-6) << "a micro sign of MS-DOS";
    EXPECT_DOUBLE_EQ(channels[0].height, 2 * 0.5e-6);
    EXPECT_EQ(channels[0].title, "Topography");
  }
}

TEST(SurFile, SaysWhoMeasuredAndWhen) {
  Sur kind;
  EXPECT_EQ(parseSur(sur(kind))[0].identity.acquisition_time, "");
  kind.operator_name = "A. Worker";
  kind.date = {51, 33, 13, 15, 12, 2014};
  const ScanIdentity identity = parseSur(sur(kind))[0].identity;
  EXPECT_EQ(identity.operator_name, "A. Worker");
  EXPECT_EQ(identity.acquisition_time, "2014-12-15T13:33:51");
}

/// An archive of x3p as its standard has it, through Gwyddion.
TEST(X3pFile, SaysWhoMeasuredWhenAndWithWhat) {
  if (!MEMS_STICTION_HAS_GWYDDION) GTEST_SKIP() << "built without Gwyddion's libraries";
  const ScratchFolder folder;
  const ScanIdentity identity = openScanFile(folder.write("scan.x3p", x3p())).identity;
  EXPECT_EQ(identity.acquisition_time, "2026-03-01T14:05:00+01:00");
  EXPECT_EQ(identity.operator_name, "A. Worker");
  EXPECT_EQ(identity.instrument, "Maker Two, serial number 0012");
}

TEST(SurFile, WhereAllPointsWereMeasuredNoneIsMissing) {
  Sur kind;
  kind.special = 0;
  EXPECT_DOUBLE_EQ(parseSur(sur(kind))[0].values.at<double>(0, 2), 4e-9);
}

TEST(SurFile, InvertedSurfacesAreTurnedBack) {
  Sur kind;
  kind.inversion = 2;  // heights and columns
  EXPECT_DOUBLE_EQ(parseSur(sur(kind))[0].values.at<double>(0, 2), -5e-9);
  kind.inversion = 3;  // heights and rows
  EXPECT_DOUBLE_EQ(parseSur(sur(kind))[0].values.at<double>(1, 0), -5e-9);
}

TEST(SurFile, ASizeThatDoesNotMatchItsCountIsRefused) {
  std::string bytes = sur(Sur{});
  ASSERT_EQ(bytes[108], 3);  // columns; 6 points in all
  bytes[108] = 2;
  EXPECT_TRUE(mentions(refusal([&] { parseSur(bytes); }), "damaged header"));
}

TEST(SurFile, BytesBehindItsOnlySurfaceAreRefused) {
  EXPECT_TRUE(mentions(refusal([] { parseSur(sur(Sur{}) + "x"); }), "its header states"));
}

TEST(SurFile, AnotherUnitOrACutIsRefused) {
  Sur kind;
  kind.unit_z = "V";
  EXPECT_THROW(chooseHeightChannel(parseSur(sur(kind))), FileError);
  for (const bool is_compressed : {false, true}) {
    kind.is_compressed = is_compressed;
    const std::string whole = sur(kind);
    for (std::size_t size = 0; size < whole.size(); size += 7) {
      EXPECT_THROW(parseSur(whole.substr(0, size)), FileError) << size << " of " << whole.size();
    }
  }
}

TEST(SurFile, ThePublicFileHasTheRoughnessOfOtherReaders) {
  const char* folder = std::getenv("MEMS_STICTION_SCANS");
  if (folder == nullptr)
    GTEST_SKIP() << "MEMS_STICTION_SCANS is not set to a folder of vendor scans";
  const HeightStatistics statistics =
      heightStatistics(readScanFile(std::string(folder) + "/misread/sur-2.sur"));
  EXPECT_EQ(statistics.valid_count, 563 * 484 - 117);
  EXPECT_NEAR(statistics.rms_height, 17.5e-9, 0.05e-9);  // three digits are listed
}

// ---- NetCDF

TEST(NetcdfFile, HeightsOverXAndYKeepTheirUnitAndAxes) {
  const auto channel = parseNetcdfHeights(heights("um"));
  ASSERT_TRUE(channel.has_value());
  ASSERT_EQ(channel->values.size(), cv::Size(3, 2));
  EXPECT_DOUBLE_EQ(channel->values.at<double>(1, 2), 21e-6);
  EXPECT_DOUBLE_EQ(channel->values.at<double>(0, 1), 10e-6);
  EXPECT_DOUBLE_EQ(channel->width, 3e-6);
  EXPECT_DOUBLE_EQ(channel->height, 4e-6);
}

TEST(NetcdfFile, AUnitThatIsNoLengthIsRefused) {
  EXPECT_THROW(chooseHeightChannel({*parseNetcdfHeights(heights("V"))}), FileError);
}

TEST(NetcdfFile, ASizeThatDoesNotMatchItsNumbersIsRefused) {
  std::string bytes = heights("nm");
  const std::string x = std::string("\0\0\0\1x\0\0\0", 8);  // the dimension; its length follows
  const std::size_t at = bytes.find(x) + x.size();
  ASSERT_EQ(bytes[at + 3], 3);
  bytes[at + 3] = 2;
  EXPECT_TRUE(mentions(refusal([&] { parseNetcdfHeights(bytes); }), "damaged header"));
}

TEST(NetcdfFile, EveryCutIsRefused) {
  const std::string whole = heights("nm");
  for (std::size_t size = 4; size < whole.size(); ++size) {
    EXPECT_THROW(parseNetcdfHeights(whole.substr(0, size)), FileError)
        << size << " of " << whole.size();
  }
}

/// As GXSM writes them: "var_unit" is always Ang, the unit of the signal stands in "unit".
std::string gxsm(const std::string& unit, double step_x = 0.0) {
  const std::vector<std::string> range = {ncText("unit", "nm"), ncText("var_unit", "Ang")};
  std::vector<NcVariable> variables = {
      {"FloatField",
       {0, 1, 2, 3},
       {ncText("long_name", "FloatField")},
       bigDoubles({0, 1, 2, 10, 11, 12})},
      {"rangex", {}, range, bigDoubles({300})},
      {"rangey", {}, range, bigDoubles({200})},
      {"rangez", {}, {ncText("unit", unit), ncText("var_unit", "Ang")}, bigDoubles({1})},
      {"dz", {}, {ncText("unit", unit), ncText("var_unit", "Ang")}, bigDoubles({0.5})}};
  if (step_x > 0.0) variables.push_back({"dx", {}, range, bigDoubles({step_x})});
  return netcdf({{"time", 1}, {"value", 1}, {"dimy", 2}, {"dimx", 3}}, variables);
}

TEST(NetcdfFile, GxsmCurrentsAndFrequencyShiftsAreNoHeights) {
  EXPECT_EQ(gxsmStatements(gxsm("nA")).other_unit, "nA");
  EXPECT_EQ(gxsmStatements(gxsm("Hz")).other_unit, "Hz");
  EXPECT_EQ(gxsmStatements(gxsm("AA")).other_unit, "");
  EXPECT_EQ(gxsmStatements(gxsm("nm")).other_unit, "");
}

TEST(NetcdfFile, GxsmRangesReachFromTheFirstPixelToTheLast) {
  EXPECT_DOUBLE_EQ(gxsmStatements(gxsm("nm")).pitch_x, 150e-10) << "300 over two steps";
  EXPECT_DOUBLE_EQ(gxsmStatements(gxsm("nm")).pitch_y, 200e-10);
  EXPECT_DOUBLE_EQ(gxsmStatements(gxsm("nm", 150.5)).pitch_x, 150.5e-10) << "as the file's dx says";
  EXPECT_TRUE(mentions(refusal([] { gxsmStatements(gxsm("nm", 75.0)); }), "contradicts itself"));
}

TEST(NetcdfFile, GxsmFilesGoThroughGwyddionWithTheirOwnUnit) {
  if (!MEMS_STICTION_HAS_GWYDDION) GTEST_SKIP() << "built without Gwyddion's libraries";
  const ScratchFolder folder;
  const HeightMap surface = readScanFile(folder.write("height.nc", gxsm("nm")));
  EXPECT_NEAR(surface.pitchX(), 150e-10, 1e-18);
  EXPECT_NEAR(surface.pitchY(), 200e-10, 1e-18);
  EXPECT_NEAR(surface.height(1, 2) - surface.height(0, 0), 12 * 0.5e-10, 1e-18);
  EXPECT_TRUE(
      mentions(refusal([&] { readScanFile(folder.write("current.nc", gxsm("nA"))); }), "[nA]"));
}

// ---- NumPy

TEST(NpyFile, EveryNumberTypeAndOrderIsRead) {
  std::string doubles, bigs, floats, halves, shorts, transposed;
  for (const int value : {1, 2, 3, 4, 5, 6}) {
    doubles += littleBytes(static_cast<double>(value));
    bigs += bigBytes(static_cast<double>(value));
    floats += littleBytes(static_cast<float>(value));
    shorts += littleBytes(static_cast<std::int16_t>(value));
  }
  for (const int half : {0x3C00, 0x4000, 0x4200, 0x4400, 0x4500, 0x4600})
    halves += littleBytes(static_cast<std::uint16_t>(half));
  for (const double value : {1.0, 4.0, 2.0, 5.0, 3.0, 6.0}) transposed += littleBytes(value);
  for (const std::string& bytes :
       {npy("<f8", doubles), npy(">f8", bigs), npy("<f4", floats), npy("<f2", halves),
        npy("<i2", shorts), npy("<f8", transposed, "(2, 3)", true)}) {
    const cv::Mat values = parseNpy(bytes).values;
    ASSERT_EQ(values.size(), cv::Size(3, 2));
    for (int i = 0; i < 6; ++i)
      EXPECT_EQ(values.at<double>(i / 3, i % 3), i + 1.0) << bytes.substr(10, 60);
  }
}

TEST(NpyFile, WhatIsNoMatrixOfNumbersIsRefused) {
  EXPECT_TRUE(mentions(refusal([] { parseNpy(npy("<f8", std::string(48, '\0'), "(6,)")); }),
                       "two dimensions"));
  EXPECT_TRUE(mentions(refusal([] { parseNpy(npy("<f8", std::string(48, '\0'), "(1, 2, 3)")); }),
                       "two dimensions"));
  EXPECT_TRUE(mentions(refusal([] { parseNpy(npy("<c16", std::string(96, '\0'))); }),
                       "integers or floating-point"));
  EXPECT_TRUE(mentions(refusal([] { parseNpy(npy("|O", std::string(48, '\0'))); }),
                       "integers or floating-point"));
  EXPECT_TRUE(mentions(refusal([] { parseNpy(npy("<f8", std::string(47, '\0'))); }),
                       "47 bytes of numbers"));
  EXPECT_TRUE(mentions(refusal([] { parseNpy(npy("<f8", "", "(30000, 30000)")); }),
                       "30000 x 30000 pixels are more"));
  const std::string many(40, '9');
  EXPECT_TRUE(
      mentions(refusal([&] { parseNpy(npy("<f8", "", "(2, " + many + ")")); }), "is no scan"));
}

TEST(NpyFile, AHeaderThatNumpyReadsOtherwiseOrNotIsRefused) {
  const std::string data(48, '\0');
  const auto with = [&data](const std::string& from, const std::string& to) {
    std::string bytes = npy("<f8", data);
    bytes.replace(bytes.find(from), from.size(), to);
    const auto header = static_cast<std::uint16_t>(bytes.size() - data.size() - 10);
    return bytes.replace(8, 2, littleBytes(header));
  };
  const std::string shape = "'shape': (2, 3)";
  EXPECT_EQ(parseNpy(with(shape, "'shape': (2L, 3L)")).values.size(), cv::Size(3, 2)) << "Python 2";
  EXPECT_TRUE(mentions(refusal([&] { parseNpy(with(shape, "'shape': (3, 2), " + shape)); }),
                       "states 'shape' twice"));
  EXPECT_TRUE(mentions(refusal([&] { parseNpy(with(shape, "'descr': '<f4', " + shape)); }),
                       "states 'descr' twice"));
  for (const char* wrong : {"'shape': (2.0, 3)", "'shape': (2, 3.0)", "'shape': (2, 0x3)",
                            "'shape': (-2, 3)", "'shape': (2 + 0, 3)"}) {
    EXPECT_TRUE(mentions(refusal([&] { parseNpy(with(shape, wrong)); }), "two whole numbers"))
        << wrong;
  }
  EXPECT_TRUE(mentions(refusal([&] { parseNpy(with("False", "Wrong")); }), "True or False"));
  for (const char* version : {"\x09", "\x04"}) {
    std::string bytes = npy("<f8", data);
    bytes.replace(6, 1, version);
    EXPECT_TRUE(mentions(refusal([&] { parseNpy(bytes); }), "must be 1.0, 2.0 or 3.0"));
  }
}

// ---- Createc

/// Compressed, one channel of heights; @p is_filled: with the header up to byte 16384, as older
/// programs write it.
std::string createcHeights(bool is_filled) {
  const std::string header =
      "[Paramco32]\r\nDAC-Type=20bit\r\nNum.X / Num.X=4\r\nNum.Y / Num.Y=3\r\nChannels / "
      "Channels=1\r\n"
      "Delta X / Delta X [Dac]=8\r\nDelta Y / Delta Y [Dac]=8\r\nGainX / GainX=10\r\nGainY / "
      "GainY=10\r\n"
      "GainZ / GainZ=10\r\nXpiezoconst=48\r\nYPiezoconst=48\r\nZPiezoconst=19\r\n";
  std::string numbers = littleBytes(0.0F);
  for (int i = 0; i < 12; ++i) numbers += littleBytes(static_cast<float>(i * i));
  std::string packed(1000, '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(numbers.data()), numbers.size());
  const std::string filler(is_filled ? 16380 - header.size() : 0, '\0');
  return header + filler + "DATA" + packed.substr(0, size);
}

TEST(Createc, DataRightBehindTheHeaderAreReadAsThoseBehindAFilledOne) {
  if (!MEMS_STICTION_HAS_GWYDDION) GTEST_SKIP() << "built without Gwyddion's libraries";
  const ScratchFolder folder;
  const ScanFile old = openScanFile(folder.write("old.dat", createcHeights(true)));
  const ScanFile newer = openScanFile(folder.write("newer.dat", createcHeights(false)));
  EXPECT_EQ(old.surface.rows(), 3);
  EXPECT_GT(cv::norm(old.surface.heights(), cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(old.surface.heights(), newer.surface.heights(), cv::NORM_INF), 0.0);
  EXPECT_EQ(old.surface.pitchX(), newer.surface.pitchX());
  const std::string bytes = createcHeights(false);
  const std::string cut = folder.write("cut.dat", bytes.substr(0, bytes.size() - 3));
  const std::string said = refusal([&] { openScanFile(cut); });
  EXPECT_TRUE(mentions(said, cut) && mentions(said, "cut off")) << said;
}

}  // namespace
}  // namespace mems_stiction
