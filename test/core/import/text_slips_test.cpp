/// Slips that text exports of instruments and spreadsheets bring along: each is read as what it
/// means, or refused with a sentence that says what to write. None is read as something else.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "import/format_readers.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

using Rows = std::vector<std::vector<double>>;

/// A text with what it means: heights and pitch, or a part of the sentence that refuses it.
struct Slip {
  const char* name;
  std::string text;
  Rows heights;
  std::string refusal;
  double pitch_x = 0.0;  ///< [m]; 0 = not stated
  TextOptions options = {};
};

TextOptions with(DecimalMark mark) { return {mark, YAxis::kAuto}; }
TextOptions with(YAxis axis) { return {DecimalMark::kAuto, axis}; }

std::string utf16(const std::string& text) {
  std::string wide("\xFF\xFE", 2);
  for (const char letter : text) wide += {letter, '\0'};
  return wide;
}

const std::string kPlain = "0.5 0.25 0.75\n1.5 0.125 0.375\n";
const Rows kHeights = {{0.5, 0.25, 0.75}, {1.5, 0.125, 0.375}};

/// 3 x 2 points, y from the bottom upward or from the top downward.
std::string list(const std::string& heading, bool is_from_top, const std::string& more = "") {
  std::string text = heading;
  for (int line = 0; line < 2; ++line) {
    const int row = is_from_top ? line : 1 - line;
    for (int col = 0; col < 3; ++col) {
      text +=
          std::to_string(2 * col) + "\t" + std::to_string(2 * (1 - row)) + "\t" +
          std::to_string(kHeights[static_cast<std::size_t>(row)][static_cast<std::size_t>(col)]) +
          more + "\n";
    }
  }
  return text;
}

std::string pairOf(const std::string& key, const std::string& first, const std::string& second) {
  return "# " + key + ": " + first + "\n# " + key + ": " + second + "\n" + kPlain;
}

std::string sized(const std::string& width, const std::string& height) {
  return "# Width: " + width + "\n# Height: " + height + "\n" + kPlain;
}

std::vector<Slip> slips() {
  return {
      // ---- Marks that may be decimal or group thousands
      {"commas with tabs", "1,500\t-2,250\n3,125\t4,750\n", {}, "decimal_mark"},
      {"commas with blanks", "1,500 -2,250\n3,125 4,750\n", {}, "decimal_mark"},
      {"commas with semicolons", "1,500;-2,250\n3,125;4,750\n", {}, "decimal_mark"},
      {"points with semicolons", "1.500;-2.250\n3.125;4.750\n", {}, "decimal_mark"},
      {"quoted commas", "\"1,500\",\"2,250\"\n\"3,125\",\"4,750\"\n", {}, "decimal_mark"},
      {"thousands between commas", "1,500,-2,250\n3,125,4,750\n", {}, "separate by semicolons"},
      {"thousands and decimals between commas",
       "1,500.5,2,250.3\n3,125.0,4,750.9\n",
       {},
       "separate by semicolons"},
      {"thousands and loose commas",
       "1,500.5, 2,250.3\n3,125.0, 4,750.9\n",
       {},
       "separate by semicolons"},
      {"one number decides for the comma",
       "1,500\t-2,25\n3,125\t4,750\n",
       {{1.5, -2.25}, {3.125, 4.75}},
       ""},
      {"a leading zero decides for the comma",
       "1,500;0,250\n3,125;4,750\n",
       {{1.5, 0.25}, {3.125, 4.75}},
       ""},
      {"an exponent decides for the comma",
       "1,500E3;2,250E3\n3,125E3;4,750E3\n",
       {{1500, 2250}, {3125, 4750}},
       ""},
      {"two commas group", "1,500,000\t2,250\n3,125\t4,750\n", {{1500000, 2250}, {3125, 4750}}, ""},
      {"two points group", "1.500.000;2.250\n3.125;4.750\n", {{1500000, 2250}, {3125, 4750}}, ""},
      {"the heading decides for the comma",
       "# Width: 2,5 nm\n# Height: 2,5 nm\n1,500\t-2,250\n3,125\t4,750\n",
       {{1.5, -2.25}, {3.125, 4.75}},
       "",
       1.25e-9},
      {"the heading decides for thousands",
       "# Width: 2.5 nm\n# Height: 2.5 nm\n1,500\t-2,250\n3,125\t4,750\n",
       {{1500, -2250}, {3125, 4750}},
       "",
       1.25e-9},
      {"the setting decides for the comma",
       "1,500\t-2,250\n3,125\t4,750\n",
       {{1.5, -2.25}, {3.125, 4.75}},
       "",
       0.0,
       with(DecimalMark::kComma)},
      {"the setting decides for thousands",
       "1,500\t-2,250\n3,125\t4,750\n",
       {{1500, -2250}, {3125, 4750}},
       "",
       0.0,
       with(DecimalMark::kPoint)},
      {"points that group by the setting",
       "1.500;-2.250\n3.125,5;4.750\n",
       {{1500, -2250}, {3125.5, 4750}},
       "",
       0.0,
       with(DecimalMark::kComma)},
      {"a setting that the numbers contradict",
       "0.5;-2.25\n3.125;4.75\n",
       {},
       "decimal comma",
       0.0,
       with(DecimalMark::kComma)},
      {"both marks", "1.234,5;2.000,0\n3,25;4\n", {}, "decimal_mark"},
      {"marks that differ between columns", "1.5;2,5\n3.5;4,5\n", {}, "points and decimal commas"},
      // ---- Groups of thousands by other signs
      {"blanks in cells between tabs",
       "1 500,0\t2 250,5\n3 100,0\t4 750,5\n",
       {{1500, 2250.5}, {3100, 4750.5}},
       ""},
      {"blanks in whole cells between tabs", "1 500\t2 250\n3 100\t4 750\n", {}, "blanks"},
      {"blanks in cells between semicolons",
       "1 500,0;250,5\n3 100,0;4 750,5\n",
       {{1500, 250.5}, {3100, 4750.5}},
       ""},
      {"blanks in cells between blanks", "1 500,0 2 250,5\n3 100,0 4 750,5\n", {}, "blanks"},
      {"blanks and one comma", "1 500,2 250\n3 100,4 750\n", {}, "blanks"},
      {"apostrophes",
       "1'500.25;2'250.5\n3'100.0;1'004'750.5\n",
       {{1500.25, 2250.5}, {3100, 1004750.5}},
       ""},
      {"underscores",
       "1_500.5 2_250.5\n3_100.5 4_750.5\n",
       {{1500.5, 2250.5}, {3100.5, 4750.5}},
       ""},
      {"blanks that do not break",
       "1\xC2\xA0"
       "500,5\t2\xE2\x80\xAF"
       "250,5\n3\xE2\x80\x89"
       "100,5\t750,5\n",
       {{1500.5, 2250.5}, {3100.5, 750.5}},
       ""},
      {"blanks that do not break, of a code page",
       "1\xA0"
       "500,5;2,5\n3\xA0"
       "100,5;4,5\n",
       {{1500.5, 2.5}, {3100.5, 4.5}},
       ""},
      {"a minus of typography",
       "\xE2\x88\x92"
       "0.5 0.25\n1.5 \xE2\x88\x92"
       "0.125\n",
       {{-0.5, 0.25}, {1.5, -0.125}},
       ""},
      // ---- Lengths in headings
      {"a width with three digits after its comma",
       sized("1,200 nm", "800 nm"),
       {},
       "'1,200' has a mark"},
      {"a width whose comma the other side explains", sized("1,200 \xC2\xB5m", "0,8 \xC2\xB5m"),
       kHeights, "", 4e-7},
      {"a width whose comma groups, by the other side", sized("1,200 nm", "800.5 nm"), kHeights, "",
       4e-7},
      {"a width with both marks", sized("1.200,00 nm", "800,5 nm"), kHeights, "", 4e-7},
      {"an exponent", sized("1.2E-6 m", "8.0E-7 m"), kHeights, "", 4e-7},
      {"an exponent behind a comma", sized("1,2E-06 m", "0,8E-06 m"), kHeights, "", 4e-7},
      {"either micro", sized("1.2 \xCE\xBCm", "0.8 \xC2\xB5m"), kHeights, "", 4e-7},
      {"two widths", pairOf("Width", "1 nm", "2 um"), {}, "width twice"},
      {"two equal widths", pairOf("Width", "3 nm", "0.003 um") + "# Height: 2 nm\n", kHeights, "",
       1e-9},
      {"two units", pairOf("Value units", "nm", "um"), {}, "unit of the heights twice"},
      {"two channels", pairOf("Channel", "Height", "Phase"), {}, "channel twice"},
      {"two counts", "x-pixels = 3\nncols 4\n" + kPlain, {}, "number of columns twice"},
      {"width and pitch that differ", sized("3 nm", "2 nm") + "# Pitch: 2 nm\n", {}, "remove one"},
      {"width and pitch that agree", sized("3 nm", "2 nm") + "# Pitch: 1 nm\n", kHeights, "", 1e-9},
      {"a width that is no length", sized("3 V", "2 V"), {}, "not a unit of length"},
      {"a width without height in a unit of heights",
       "# Width: 3 \xC2\xB5m\n# Value units: m\n" + kPlain, kHeights, ""},
      // ---- Columns that are none of heights
      {"an index column of 4", "0 0.5 0.25\n1 1.5 0.125\n2 0.7 0.3\n3 0.1 0.9\n", {}, "remove it"},
      {"an index column of 3", "1 0.5 0.25\n2 1.5 0.125\n3 0.7 0.3\n", {}, "remove it"},
      {"an index column at the end",
       "0.5 0.25 1\n1.5 0.125 2\n0.7 0.3 3\n0.1 0.9 4\n",
       {},
       "column 3"},
      {"an index line at the end",
       "0.5 0.25 1.5 0.7\n1.5 0.125 2.5 0.2\n0 1 2 3\n",
       {},
       "last line"},
      {"coordinates at both borders",
       "0 0.1 0.2 0.3 0.4\n0.1 5.1 7.2 6.6 5.9\n0.2 8.1 6.2 5.5 7.1\n0.3 6.2 5.0 8.8 5.1\n",
       {},
       "coordinates"},
      {"a column of quality beside a list", list("", true, "\t0.99"), {}, "keep three columns"},
      {"a column of quality beside a list with a gap",
       "0 0 0.5 1\n1 0 0.1 2\n2 0 0.9 1\n3 0 0.4 2\n0 1 0.7 1\n1 1 0.3 1\n3 1 0.2 2\n0 2 0.6 1\n1 "
       "2 0.8 2\n2 2 0.1 "
       "1\n3 2 0.3 2\n",
       {},
       "keep three columns"},
      {"z before x and y",
       "0.5 0 0\n0.25 2 0\n0.75 4 0\n1.5 0 2\n0.125 2 2\n0.375 4 2\n",
       {},
       "columns 2 and 3"},
      {"x, z and y", "0 0.5 0\n2 0.25 0\n0 1.5 2\n2 0.125 2\n", {}, "columns 1 and 3"},
      {"a list with numbered points",
       "1 0 0 0.5\n2 2 0 0.25\n3 4 0 0.75\n4 0 2 1.5\n5 2 2 0.125\n6 4 2 0.375\n",
       {},
       "keep three columns"},
      // ---- Lists of points
      {"y upward from the top", list("x [nm]\ty [nm]\tz [m]\n", true), kHeights, "", 2e-9},
      {"y upward by the setting", list("x [nm]\ty [nm]\tz [m]\n", false), kHeights, "", 2e-9,
       with(YAxis::kUp)},
      {"y upward in a list of WSxM",
       list("WSxM file copyright UAM\nWSxM ASCII XYZ file\nX[nm]\tY[nm]\tZ[m]\n\n", false),
       kHeights, "", 2e-9},
      {"y downward by the setting",
       list("x [nm]\ty [nm]\tz [m]\n", true),
       {kHeights[1], kHeights[0]},
       "",
       2e-9,
       with(YAxis::kDown)},
      {"a list of Gwyddion, y downward",
       "# Channel: Height\n# Lateral units: nm\n# Value units: m\n1 1 1.5\n3 1 0.125\n5 1 0.375\n1 "
       "3 0.5\n3 3 "
       "0.25\n5 3 0.75\n",
       {kHeights[1], kHeights[0]},
       "",
       2e-9},
      {"units behind strokes", list("x/nm\ty/nm\tz/m\n", true), kHeights, "", 2e-9},
      {"units behind underscores", list("x_nm;y_nm;z_m\n", true), kHeights, "", 2e-9},
      {"units of z alone", list("x\ty\tz [nm]\n", true), {}, "write x [nm], y [nm], z [nm]"},
      {"units without that of z",
       list("x [nm]\ty [nm]\tz\n", true),
       {},
       "write x [nm], y [nm], z [nm]"},
      {"y before x", list("y [nm]\tx [nm]\tz [m]\n", true), {}, "in this order"},
      {"a matrix of WSxM", "WSxM file copyright UAM\nWSxM ASCII Matrix file\n" + kPlain, kHeights,
       ""},
      {"a matrix of WSxM of currents",
       "WSxM file copyright UAM\nWSxM ASCII Matrix file\nX Amplitude: 3 bars\n" + kPlain,
       {},
       "'bars' is not a unit of length"},
      {"decimal commas in a list",
       "0,0\t2,0\t0,500\n2,0\t2,0\t0,250\n4,0\t2,0\t0,750\n"
       "0,0\t0,0\t1,500\n2,0\t0,0\t0,125\n4,0\t0,0\t0,375\n",
       kHeights, ""},
      {"a serpentine list", "0 2 0.5\n2 2 0.25\n4 2 0.75\n4 0 0.375\n2 0 0.125\n0 0 1.5\n",
       kHeights, ""},
      {"a point twice",
       list("x [nm]\ty [nm]\tz [m]\n", true) + "0\t0\t1\n",
       {},
       "x and y of another one"},
      {"points on no grid",
       "x [nm] y [nm] z [nm]\n0 0 1\n1 0.3 2\n2.7 1 0\n0.2 5 1\n1 1 3\n4 0.9 2\n",
       {},
       "grid"},
      // ---- Lines, ends, encodings
      {"UTF-16", utf16("# Width: 3 nm\r\n# Height: 2 nm\r\n0,5;0,25;0,75\r\n1,5;0,125;0,375\r\n"),
       kHeights, "", 1e-9},
      {"a mark of the byte order", "\xEF\xBB\xBF" + kPlain, kHeights, ""},
      {"returns alone", "0.5 0.25 0.75\r1.5 0.125 0.375\r", kHeights, ""},
      {"separators at every end", "0,5;0,25;0,75;\n1,5;0,125;0,375;\n", kHeights, ""},
      {"a separator at one end", "0,5;0,25;0,75\n1,5;0,125;0,375;\n", {}, "cells"},
      {"ragged rows", "0.5 0.25 0.75\n1.5 0.125\n", {}, "cells"},
      {"exponents of Fortran", "0.5D0 2.5D-01 7.5d-1\n1.5D+00 1.25D-1 3.75D-1\n", kHeights, ""},
      // ---- Words for none
      {"words for none",
       "BAD;0.25;N/A\n1.5;null;---\n",
       {{kNone, 0.25, kNone}, {1.5, kNone, kNone}},
       ""},
      {"two words for none", "No Data\t0.25\n1.5\t0.75\n", {{kNone, 0.25}, {1.5, 0.75}}, ""},
      {"a spreadsheet's word for none",
       "#N/A\t0.25\n1.5\t#N/A\n0.7\t0.1\n",
       {{kNone, 0.25}, {1.5, kNone}, {0.7, 0.1}},
       ""},
      {"a spreadsheet's mistake", "1.5;#DIV/0!\n0.5;0.25\n", {}, "'#DIV/0!' is not a number"},
  };
}

void expectMeaning(const Slip& slip) {
  FileChannel channel;
  try {
    channel = parseTextGrid(slip.text, slip.options);
  } catch (const FileError& error) {
    ASSERT_FALSE(slip.refusal.empty()) << "refused: " << error.what();
    EXPECT_NE(std::string(error.what()).find(slip.refusal), std::string::npos) << error.what();
    return;
  }
  ASSERT_TRUE(slip.refusal.empty()) << "read as\n" << channel.values;
  ASSERT_EQ(channel.values.rows, static_cast<int>(slip.heights.size())) << channel.values;
  ASSERT_EQ(channel.values.cols, static_cast<int>(slip.heights[0].size())) << channel.values;
  for (int row = 0; row < channel.values.rows; ++row) {
    for (int col = 0; col < channel.values.cols; ++col) {
      const double expected =
          slip.heights[static_cast<std::size_t>(row)][static_cast<std::size_t>(col)];
      const double height = channel.values.at<double>(row, col);
      if (std::isnan(expected)) {
        EXPECT_TRUE(std::isnan(height)) << row << ", " << col;
      } else {
        EXPECT_DOUBLE_EQ(height, expected) << row << ", " << col;
      }
    }
  }
  if (slip.pitch_x > 0.0) {
    EXPECT_EQ(channel.unit_xy, "m");
    EXPECT_NEAR(channel.width / channel.values.cols, slip.pitch_x, 1e-9 * slip.pitch_x);
  }
}

TEST(TextSlips, AreReadAsWhatTheyMeanOrRefused) {
  for (const Slip& slip : slips()) {
    SCOPED_TRACE(slip.name);
    expectMeaning(slip);
  }
}

TEST(TextSlips, PointsThatMayGroupThousandsAreSaid) {
  const FileChannel channel = parseTextGrid("1.500\t-2.250\n3.125\t4.750\n");
  EXPECT_EQ(channel.values.at<double>(0, 0), 1.5);
  ASSERT_EQ(channel.notes.size(), 1u);
  EXPECT_NE(channel.notes[0].find("decimal_mark: comma"), std::string::npos);
}

TEST(TextSlips, AListThatLeavesTheDirectionOfYOpenIsSaid) {
  const FileChannel channel = parseTextGrid(list("", false));
  ASSERT_EQ(channel.notes.size(), 1u);
  EXPECT_NE(channel.notes[0].find("y_axis"), std::string::npos);
  EXPECT_TRUE(parseTextGrid(list("", true)).notes.empty());
}

TEST(TextSlips, AWidthAloneDoesNotCountAndIsSaid) {
  const FileChannel channel = parseTextGrid("# Width: 3 \xC2\xB5m\n# Value units: nm\n" + kPlain);
  EXPECT_EQ(channel.width, 0.0);
  ASSERT_EQ(channel.notes.size(), 1u);
  EXPECT_NE(channel.notes[0].find("width alone"), std::string::npos);
}

TEST(TextSlips, SidecarAndSettingsStateWhatTheFileLeavesOpen) {
  const ScratchFolder folder;
  const std::string path = folder.write("part.txt", "1,500\t-2,250\n3,125\t4,750\n");
  ScanOptions settings;
  settings.pitch_x = settings.pitch_y = 1e-9;
  EXPECT_THROW(readScanFile(path, settings), FileError);
  settings.text.decimal_mark = DecimalMark::kComma;
  EXPECT_EQ(readScanFile(path, settings).height(0, 0), 1.5);
  folder.write("part.txt.yaml", "decimal_mark: point\n");
  EXPECT_EQ(readScanFile(path, settings).height(0, 0), 1500.0)
      << "the sidecar goes before the settings";
  const std::string points = folder.write("list.xyz", list("", false));
  folder.write("list.xyz.yaml", "scan/y_axis: up\n");
  EXPECT_EQ(readScanFile(points).height(0, 0), 0.5);
}

}  // namespace
}  // namespace mems_stiction
