#include "import/format_readers.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>

#include "import/file_bytes.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

/// A rough surface of 5 x 4 heights, each written with three decimals.
const std::vector<std::vector<std::string>> kNumbers = {{"0.437", "1.041", "-0.250", "0.900"},
                                                        {"1.500", "0.125", "2.333", "0.700"},
                                                        {"0.010", "3.141", "0.600", "-1.700"},
                                                        {"2.718", "0.500", "0.333", "1.250"},
                                                        {"0.999", "-0.100", "1.800", "0.050"}};

std::string written(const std::string& separator, char decimal = '.',
                    const std::string& line_end = "\n", const std::string& quote = "") {
  std::string text;
  for (const auto& line : kNumbers) {
    for (std::size_t col = 0; col < line.size(); ++col) {
      std::string number = line[col];
      number[number.find('.')] = decimal;
      text += (col == 0 ? "" : separator) + quote + number + quote;
    }
    text += line_end;
  }
  return text;
}

void expectNumbers(const FileChannel& channel, double unit = 1.0) {
  ASSERT_EQ(channel.values.size(), cv::Size(4, 5));
  for (int row = 0; row < 5; ++row) {
    for (int col = 0; col < 4; ++col) {
      const double expected =
          std::stod(kNumbers[static_cast<std::size_t>(row)][static_cast<std::size_t>(col)]);
      EXPECT_DOUBLE_EQ(channel.values.at<double>(row, col), expected * unit) << row << ", " << col;
    }
  }
}

std::string refusal(const std::string& text) {
  try {
    parseTextGrid(text);
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(TextGrid, ReadsHeadingsOfWsxmWykoAndKeyence) {
  FileChannel channel = parseTextGrid(
      "WSxM file copyright UAM\nWSxM ASCII Matrix file\nX Amplitude: 4 \xB5m\nY Amplitude: 500nm\n"
      "Z Amplitude: 4.841 nm\n" +
      written("\t"));
  expectNumbers(channel, 1e-9);
  EXPECT_DOUBLE_EQ(channel.width, 4e-6);
  EXPECT_DOUBLE_EQ(channel.height, 500e-9);

  const std::string wyko =
      "\nX Size\t5\nY Size\t4\nBlock Name\tType\tLength\tValue\nPixel_size\t7\t4\t0.002\n"
      "Wavelength\t7\t4\t632.8\nMult\t7\t4\t2\nRAW_DATA\t3\t80\t\n";
  channel = parseTextGrid("Wyko ASCII Data File Format 0\t0\t1" + wyko + written("\t"));
  expectNumbers(channel, 632.8e-9 / 2.0);
  EXPECT_DOUBLE_EQ(channel.width, 8e-6);
  EXPECT_DOUBLE_EQ(channel.height, 10e-6);
  for (const std::string many : {"1e300", "inf", "99999999999999999999999"}) {
    std::string text = "Wyko ASCII Data File Format 0\t0\t1" + wyko + written("\t");
    text.replace(text.find("X Size\t5") + 7, 1, many);
    EXPECT_THROW(parseTextGrid(text), FileError) << many;
  }
  std::string with_bad = "Wyko ASCII Data File Format 0\t1\t1" + wyko + written("\t");
  with_bad.replace(with_bad.find("0.437"), 5, "Bad");
  channel = parseTextGrid(with_bad);
  EXPECT_TRUE(std::isnan(channel.values.at<double>(0, 0)));
  EXPECT_DOUBLE_EQ(channel.values.at<double>(0, 1), 1.041e-9);

  const std::string keyence =
      "\"Measured date\",\"2024-02-03 10:11:12\"\n\"Model\",\"VK-X3000 Series\"\n"
      "\"XY Calibration\",\"7.413\",\"um\"\n\"Output image "
      "data\",\"Height\"\n\"Horizontal\",\"4\"\n"
      "\"Vertical\",\"5\"\n\"Unit\",\"um\"\n\"Reference data name\",\"\"\n\n\"Height\"\n";
  channel = parseTextGrid(keyence + written(",", '.', "\n", "\""));
  expectNumbers(channel, 1e-6);
  EXPECT_EQ(channel.title, "Height");
  EXPECT_DOUBLE_EQ(channel.width, 4 * 7.413e-6);
  EXPECT_TRUE(channel.notes.empty());
}

TEST(TextGrid, HoldsTheSizesOfTheseHeadingsAgainstTheNumbers) {
  expectNumbers(parseTextGrid("h=5 w=4\n" + written(" ")));
  expectNumbers(parseTextGrid("# w=4 h=5\n" + written(" ")));
  EXPECT_TRUE(
      mentions(refusal("h=5 w=5\n" + written(" ")), "states 5 x 5 numbers, the file has 4 x 5"));
  EXPECT_TRUE(mentions(refusal("Wyko ASCII Data File Format 0\t1\t1\nX Size\t4\n" + written("\t")),
                       "states 0 x 4"));
  EXPECT_TRUE(mentions(refusal("Wyko ASCII Data File Format 0\t0\t1\nX Size\t5\n" + written("\t")),
                       "no wavelength"));
  EXPECT_TRUE(
      mentions(refusal("\"XY Calibration\",\"7\",\"um\"\n\"Horizontal\",\"9\"\n" + written(",")),
               "states 9 x 0"));
}

TEST(TextGrid, ConvertsNumbersByTheFactorThatTheHeadingStates) {
  const std::string size = "h=5 w=4\npixel size=2.5e-007 m\n";
  const std::string factor = "height conversion factor (-> m)=6.25e-008\n";
  const FileChannel channel = parseTextGrid(size + "data unit=rad\n" + factor + written(" "));
  expectNumbers(channel, 6.25e-8);
  EXPECT_EQ(channel.unit_z, "m");
  EXPECT_DOUBLE_EQ(channel.width, 4 * 2.5e-7);
  EXPECT_DOUBLE_EQ(channel.height, 5 * 2.5e-7);
  EXPECT_TRUE(channel.notes.empty());
  expectNumbers(
      parseTextGrid(size + "data unit=rad\nheight conversion factor (-> um)=0.5\n" + written(" ")),
      0.5e-6);
  expectNumbers(parseTextGrid(size + "data unit=nm\n" + written(" ")), 1e-9);
  EXPECT_EQ(parseTextGrid(size + "data unit=rad\n" + written(" ")).unit_z,
            "rad");  // the choice of a channel refuses it
  for (const std::string wrong : {"0", "-1.5", "six", "2x", "nan"}) {
    const std::string text =
        size + "height conversion factor (-> m)=" + wrong + "\n" + written(" ");
    EXPECT_TRUE(mentions(
        refusal(text), "line 3: the height conversion factor '" + wrong + "' is not a number > 0"));
  }
  EXPECT_TRUE(mentions(refusal("height conversion factor (-> V)=2.5\n" + written(" ")),
                       "'v' is not a unit of length"));
  EXPECT_TRUE(mentions(refusal(factor + "height conversion factor (-> m)=2.5\n" + written(" ")),
                       "factor twice"));
}

TEST(TextGrid, SaysOfProfilesThatTheyAreNone) {
  std::string two = "X_(microns),y1\n";
  std::string indexed = "index,x in um,y in um\n";
  std::string stylus = "Scan Parameters\nStylus,Radius: 2.5 um\nLateral um,Raw Micrometer,\n";
  std::string three = "a,b,c\n";
  for (int i = 0; i < 12; ++i) {
    const std::string x = std::to_string(0.25 * i);
    const std::string z = std::to_string(std::sin(i));
    two += x + "," + z + "\n";
    indexed += std::to_string(i) + "," + x + "," + z + "\n";
    stylus += x + "," + z + ",,\n";
    three += z + "," + std::to_string(std::cos(3.0 * i)) + "," + std::to_string(std::cos(5.0 * i)) +
             "\n";
  }
  const std::string advice =
      " columns of 12 lines are a profile, not a surface: export a scan of an area";
  EXPECT_TRUE(mentions(refusal(two), "2" + advice));
  EXPECT_TRUE(mentions(refusal(indexed), "3" + advice));
  EXPECT_TRUE(mentions(refusal(stylus), "3" + advice));
  EXPECT_TRUE(mentions(refusal(three),
                       "line 1: 'a' is not a number, column 1, and begins no known heading"));
}

TEST(TextGrid, EveryWordForNoNumberIsOne) {
  for (const std::string word :
       {"NA", "N/A", "null", "---", "BAD", "No Data", "#N/A", "nan", "-inf"}) {
    for (const std::string separator : {",", ";", "\t"}) {
      std::string text = written(separator);
      text.replace(text.find("0.125"), 5, word);
      const FileChannel channel = parseTextGrid(text);
      ASSERT_EQ(channel.values.size(), cv::Size(4, 5)) << word;
      EXPECT_TRUE(std::isnan(channel.values.at<double>(1, 1))) << word;
      EXPECT_EQ(cv::countNonZero(channel.values == channel.values), 19) << word;
    }
  }
}

TEST(SurferGrid, RowsComeFromTheLowestYOn) {
  const FileChannel channel = parseSurferGrid(
      "DSAA\r\n3 2\r\n10 14\r\n-1 1\r\n0 6\r\n1 2\r\n3\r\n\r\n4 1.70141e+038 6\r\n");
  ASSERT_EQ(channel.values.size(), cv::Size(3, 2));
  EXPECT_EQ(channel.values.at<double>(1, 0), 1.0);
  EXPECT_EQ(channel.values.at<double>(1, 2), 3.0);
  EXPECT_EQ(channel.values.at<double>(0, 0), 4.0);
  EXPECT_TRUE(std::isnan(channel.values.at<double>(0, 1)));
  EXPECT_DOUBLE_EQ(channel.width, 6.0);  // nodes 2 apart
  EXPECT_DOUBLE_EQ(channel.height, 4.0);
  EXPECT_EQ(channel.unit_xy, "");
}

TEST(SurferGrid, WhatIsDamagedIsRefused) {
  for (const char* text :
       {"DSAA\n3 2\n0 1\n0 1\n0 1\n1 2 3\n4 5", "DSAA\n3 2\n0 1\n0 1\n0 1\n1 2 3\n4 5 6 7\n",
        "DSAA\n3 1\n0 1\n0 1\n0 1\n1 2 3\n", "DSAA\n3 2\n1 1\n0 1\n0 1\n1 2 3\n4 5 6\n",
        "DSAA\n3 2\n0 1\n0 1\n0 1\n1 2 x\n4 5 6\n", "DSAA\n", "DSAA\n900000 900000\n0 1\n"}) {
    EXPECT_THROW(parseSurferGrid(text), FileError) << text;
  }
}

TEST(TextGrid, DecimalCommasAreReadWhereOtherSignsSeparate) {
  for (const std::string separator : {";", "; ", "\t", " ", "   "}) {
    SCOPED_TRACE("'" + separator + "'");
    expectNumbers(parseTextGrid(written(separator, ',')));
  }
  expectNumbers(parseTextGrid(written(",", ',', "\n", "\"")));
}

TEST(TextGrid, DecimalCommasBetweenCommasAreRefused) {
  EXPECT_TRUE(mentions(refusal(written(",", ',')), "decimal commas"));
  EXPECT_TRUE(mentions(refusal(written(", ", ',')), "decimal commas"));
  EXPECT_TRUE(mentions(refusal("437,25,1041,75\n12,50,333,25\n"), "decimal commas"))
      << "no zero leads there";
  EXPECT_TRUE(mentions(refusal("1,234.5;2.0\n3.0;4.0\n"), "points and decimal commas"));
}

TEST(TextGrid, CountsBetweenCommasAreNoDecimals) {
  const cv::Mat counts = parseTextGrid("12,137,9,205\n14,1,77,13\n250,31,8,6\n").values;
  ASSERT_EQ(counts.size(), cv::Size(4, 3));
  EXPECT_EQ(counts.at<double>(0, 1), 137.0);
  EXPECT_EQ(parseTextGrid("-12,137,-9\n14,-1,77\n").values.size(), cv::Size(3, 2));
}

TEST(TextGrid, ASeparatorAtTheEndOfEveryLineBeginsNoCell) {
  for (const std::string separator : {",", ";", "\t"}) {
    expectNumbers(parseTextGrid(written(separator, '.', separator + "\r\n")));
  }
}

TEST(TextGrid, EmptyCellsNeverShiftTheOthers) {
  EXPECT_TRUE(mentions(refusal("1.5\t2.5\t3.5\n4.5\t\t6.5\n"),
                       "line 2: an empty cell between tabs, column 2"));
  EXPECT_TRUE(mentions(refusal("1.5\t2.5\t3.5\n\t5.5\t6.5\n"),
                       "line 2: an empty cell between tabs, column 1"));
  EXPECT_TRUE(mentions(refusal("1.5\t2.5\t3.5\n4.5\t5.5\t\n"),
                       "line 2: an empty cell between tabs, column 3"));
  const cv::Mat grid = parseTextGrid("1.5;2.5;3.5\n4.5;;6.5\n7.5;8.5;\n").values;
  EXPECT_TRUE(std::isnan(grid.at<double>(1, 1)));
  EXPECT_EQ(grid.at<double>(1, 2), 6.5);
  EXPECT_TRUE(std::isnan(grid.at<double>(2, 2)));
}

TEST(TextGrid, WordsThatAreNoNumbersAreRefusedWithLineAndColumn) {
  EXPECT_TRUE(mentions(refusal("1.5 2.5\n3.5 1.#\n"), "line 2: '1.#' is not a number, column 2"));
  EXPECT_TRUE(
      mentions(refusal("1.5 -1.4_\n3.5 4.5\n"), "line 1: '-1.4_' is not a number, column 2"));
  EXPECT_TRUE(mentions(refusal("1.5,2.5\n3.5,1e999\n"), "line 2: '1e999' is too large"));
  EXPECT_TRUE(mentions(refusal("1.5;2.5\n3,5;4 5\n"), "points and decimal commas"));
}

TEST(TextGrid, InfinitiesAreMissing) {
  const cv::Mat grid = parseTextGrid("1.5 inf\n-Infinity +INF\n").values;
  EXPECT_EQ(grid.at<double>(0, 0), 1.5);
  EXPECT_TRUE(std::isnan(grid.at<double>(0, 1)));
  EXPECT_TRUE(std::isnan(grid.at<double>(1, 0)));
  EXPECT_TRUE(std::isnan(grid.at<double>(1, 1)));
}

TEST(TextGrid, ASecondGridIsRefusedWithItsLine) {
  EXPECT_TRUE(
      mentions(refusal(written(" ") + "\n" + written(" ")), "line 7: a second grid begins here"));
  EXPECT_TRUE(mentions(refusal(written(" ") + "# Channel: Phase\n" + written(" ")),
                       "line 7: a second grid"));
  expectNumbers(parseTextGrid("\n\n" + written(" ") + "\n\n# the end\n"));
  expectNumbers(parseTextGrid(written(" ", '.', "\n\n")));
}

TEST(TextGrid, IndexRowsAndColumnsAreRefused) {
  std::string with_column;
  std::string with_both = "0 0 1 2 3 4\n";
  for (int row = 0; row < 6; ++row) {
    const std::string numbers = " 0.3 0.1 0.4" + std::to_string(row * row % 5) + " 0.15 0.9\n";
    with_column += std::to_string(row + 1) + numbers;
    with_both += std::to_string(row) + numbers;
  }
  EXPECT_TRUE(mentions(refusal(with_column), "column 1 holds numbers in equal steps"));
  EXPECT_TRUE(mentions(refusal(with_both), "line 1: numbers in equal steps"));
  EXPECT_TRUE(mentions(refusal("0.0 0.039 0.078 0.117 0.156 0.195\n" +
                               with_column.substr(with_column.find('\n') + 1)),
                       "line 1: numbers in equal steps"));
}

TEST(TextGrid, ATiltedPlaneHasNoIndices) {
  std::string plane;
  for (int row = 0; row < 6; ++row) {
    for (int col = 0; col < 6; ++col) plane += std::to_string(10 * row + col) + " ";
    plane += "\n";
  }
  EXPECT_EQ(parseTextGrid(plane).values.size(), cv::Size(6, 6));
}

TEST(TextGrid, ANumberThatWasCutOffIsRefused) {
  const std::string whole = written(" ");
  EXPECT_TRUE(mentions(refusal(whole.substr(0, whole.size() - 2)),
                       "line 5: the last number, column 4, is shorter"));
  EXPECT_TRUE(mentions(refusal(whole.substr(0, whole.size() - 3)), "is shorter"));
  // Without its line end alone the file is whole, but nobody can know.
  const FileChannel channel = parseTextGrid(whole.substr(0, whole.size() - 1));
  expectNumbers(channel);
  ASSERT_EQ(channel.notes.size(), 1u);
  EXPECT_TRUE(mentions(channel.notes[0], "has no line end"));
  EXPECT_TRUE(parseTextGrid(whole).notes.empty());
}

TEST(TextGrid, EveryEncodingOfTheSameTextIsRead) {
  const std::string text = "# Width: 4 \xC2\xB5m\n# Height: 5 \xC2\xB5m\n" + written("\t");
  std::string little("\xFF\xFE", 2);
  std::string big("\xFE\xFF", 2);
  std::string latin;
  for (const char letter : text) {
    if (letter == '\xC2') continue;  // the micro sign is 0xB5 in Latin-1 and in Unicode
    little += {letter, '\0'};
    big += {'\0', letter};
    latin += letter;
  }
  for (const std::string& bytes :
       {text, "\xEF\xBB\xBF" + text, latin, little, big, little.substr(2)}) {
    const FileChannel channel = parseTextGrid(bytes);
    expectNumbers(channel);
    EXPECT_DOUBLE_EQ(channel.width, 4e-6);
    EXPECT_DOUBLE_EQ(channel.height, 5e-6);
  }
  std::string old = written(" ", '.', "\r");
  expectNumbers(parseTextGrid(old));
}

TEST(TextGrid, PercentSignsBeginComments) {
  expectNumbers(parseTextGrid("% of Matlab\n" + written(" ", '.', " % x\n")));
}

TEST(TextGrid, HeadingsOfOtherProgramsStateSizeAndUnit) {
  const FileChannel gwyddion = parseTextGrid(
      "# Channel: Topography\n# Width: 4.00 \xC2\xB5m\n# Height: 10.00 \xC2\xB5m\n# Value units: "
      "m\n" +
      written("\t"));
  expectNumbers(gwyddion);
  EXPECT_EQ(gwyddion.title, "Topography");
  EXPECT_DOUBLE_EQ(gwyddion.width, 4e-6);
  EXPECT_DOUBLE_EQ(gwyddion.height, 10e-6);
  EXPECT_EQ(gwyddion.unit_z, "m");
  expectNumbers(parseTextGrid("# Value units: nm\n" + written(" ")), 1e-9);
  expectNumbers(parseTextGrid("x-pixels = 4\ny-pixels = 5\nz-unit = um\n" + written(" ")), 1e-6);
  EXPECT_TRUE(
      mentions(refusal("x-pixels = 5\n" + written(" ")), "the heading states 5 x 0 numbers"));
}

TEST(TextGrid, AUnitThatIsNoLengthIsRefused) {
  const ScratchFolder folder;
  ScanOptions options;
  options.pitch_x = options.pitch_y = 1e-9;
  const std::string path = folder.write("volts.txt", "# Value units: V\n" + written(" "));
  try {
    readScanFile(path, options);
    FAIL() << "volts were taken for metres";
  } catch (const FileError& error) {
    EXPECT_TRUE(mentions(error.what(), "V]")) << error.what();
  }
}

TEST(TextGrid, TheStatedWidthGoesBeforeTheConfiguration) {
  const ScratchFolder folder;
  ScanOptions options;
  options.pitch_x = options.pitch_y = 1e-3;
  const std::string path = folder.write("a.txt", "# Width: 4 nm\n# Height: 5 nm\n" + written(" "));
  EXPECT_DOUBLE_EQ(readScanFile(path, options).pitchX(), 1e-9);
  ScanFileOptions by_hand;
  by_hand.pitch_x = by_hand.pitch_y = 2e-9;
  const ScanFile scan = openScanFile(path, options, by_hand);
  EXPECT_EQ(scan.surface.pitchX(), 2e-9);
  ASSERT_EQ(scan.notes.size(), 1u) << "that the file says otherwise must be said";
  EXPECT_TRUE(mentions(scan.notes[0], "the file states a pitch of"));
}

TEST(TextGrid, TheListSaysWhereTheUnitIsNotStated) {
  const ScratchFolder folder;
  EXPECT_TRUE(listScanChannels(folder.write("a.txt", written(" "))).at(0).is_unit_assumed);
  EXPECT_FALSE(listScanChannels(folder.write("b.txt", "# Value units: m\n" + written(" ")))
                   .at(0)
                   .is_unit_assumed);
}

TEST(TextGrid, AUnitThatARemarkMentionsIsAskedFor) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.txt", "# heights in nm\n" + written(" "));
  ScanOptions options;
  options.pitch_x = options.pitch_y = 1e-9;
  try {
    readScanFile(path, options);
    ADD_FAILURE();
  } catch (const FileError& error) {
    EXPECT_TRUE(mentions(error.what(), "line 1: 'nm' is not understood")) << error.what();
  }
  options.height_scale = 1e-9;
  EXPECT_NO_THROW(readScanFile(path, options));
  options.height_scale = 1.0;
  folder.write("a.txt.yaml", "height_scale: 1\n");
  EXPECT_NO_THROW(readScanFile(path, options)) << "the sidecar says that they are metres";
}

TEST(TextGrid, AFileAndASidecarThatBothStateAUnitAreRefused) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.txt", "# Value units: nm\n" + written(" "));
  folder.write("a.txt.yaml", "pitch_x: 1e-9\npitch_y: 1e-9\nheight_scale: 1e-9\n");
  EXPECT_THROW(readScanFile(path), FileError);
}

// ---- Lists of points

std::string points(const std::string& heading = "") {
  std::string text = heading;
  for (int row = 0; row < 5; ++row) {
    for (int col = 0; col < 4; ++col) {
      text += std::to_string(2 * col) + " " + std::to_string(3 * row) + " " +
              kNumbers[static_cast<std::size_t>(row)][static_cast<std::size_t>(col)] + "\n";
    }
  }
  return text;
}

TEST(XyzList, ARegularGridIsReadAsOne) {
  const FileChannel channel = parseTextGrid(points());
  expectNumbers(channel);
  EXPECT_DOUBLE_EQ(channel.width, 8.0);
  EXPECT_DOUBLE_EQ(channel.height, 15.0);
  const FileChannel with_units = parseTextGrid(points("X [nm] Y [nm] Z [pm]\n"));
  expectNumbers(with_units, 1e-12);
  EXPECT_DOUBLE_EQ(with_units.width, 8e-9);
  EXPECT_EQ(with_units.unit_z, "m");
}

TEST(XyzList, TheOrderOfTheLinesIsFreeAndMissingPointsAreNaN) {
  const std::string text = points();
  std::string reversed;
  std::size_t end = text.size() - 1;
  while (end != std::string::npos) {
    const std::size_t start = text.rfind('\n', end - 1);
    reversed += text.substr(start + 1, end - start);
    end = start;
    if (start == std::string::npos) break;
  }
  expectNumbers(parseTextGrid(reversed));
  const FileChannel holed = parseTextGrid(text.substr(text.find('\n') + 1));
  EXPECT_TRUE(std::isnan(holed.values.at<double>(0, 0)));
  EXPECT_EQ(holed.values.at<double>(0, 1), 1.041);
}

TEST(XyzList, XAndYAreInTheUnitOfTheHeights) {
  const ScratchFolder folder;
  ScanOptions options;
  options.height_scale = 1e-9;
  const HeightMap surface = readScanFile(folder.write("list.xyz", points()), options);
  EXPECT_DOUBLE_EQ(surface.pitchX(), 2e-9);
  EXPECT_DOUBLE_EQ(surface.pitchY(), 3e-9);
  EXPECT_DOUBLE_EQ(surface.height(0, 1), 1.041e-9);
}

TEST(XyzList, WhatIsOnNoGridIsRefused) {
  std::string scattered;
  std::string profile;
  for (int i = 0; i < 40; ++i) {
    scattered += std::to_string(i * 7 % 11 + 0.37 * i) + " " +
                 std::to_string(i * 5 % 13 - 0.11 * i * i) + " 1.5\n";
    profile += std::to_string(i) + " " + std::to_string(i * i % 7) + "\n";
  }
  EXPECT_NE(refusal(scattered), "");
  EXPECT_TRUE(mentions(refusal(profile), "2 columns of 40 lines are a profile"));
  EXPECT_TRUE(mentions(refusal(points() + "2 3 9.000\n"), "has the x and y of another one"));
}

TEST(TextGrid, AQuotationMarkWithoutItsPartnerTakesNoCellsAway) {
  // the separator at the end of the first lines stands inside the quotes: no cell is left of them
  EXPECT_THROW(parseTextGrid("'4,\n'4,\n,,\n"), FileError);
  EXPECT_THROW(parseTextGrid("1,2,\n'4,\n"), FileError);
}

TEST(TextGrid, MoreCellsThanAScanHasAreRefusedWithoutTheirMemory) {
  struct rusage before {};
  getrusage(RUSAGE_SELF, &before);
  for (const char* cell : {",", ";", "1 "}) {
    std::string line;
    line.reserve(240'000'000);
    for (std::uint64_t i = 0; i < kMaxPixels / 2 + 10; ++i) line += cell;
    line += "1\n";
    const std::string size = line + line;
    line = std::string();
    try {
      parseTextGrid(size);
      FAIL() << cell;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find("more than the 100000000 numbers"),
                std::string::npos)
          << error.what();
    }
  }
  struct rusage after {};
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 1'500'000) << "kB for a file of 200 MB";
}

}  // namespace
}  // namespace mems_stiction
