/// Headings as the programs write them, in each of Gwyddion's languages: lengths and heights come
/// out in metres, amperes never do.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "import/format_readers.hpp"
#include "import/heading_words.hpp"
#include "import/length_unit.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/scan_bytes.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

const std::string kExportedGrid = "1 2 3 5\n5 6 7 9\n9 10 11 14\n";

struct Words {
  const char *title, *width, *height, *unit_z;
};

/// As Gwyddion writes them, with the blanks before colons and the wide colons that its translations
/// have.
constexpr Words kGwyddion[] = {
    {"Channel:", "Width:", "Height:", "Value units:"},
    {"Kanál:", "Šířka:", "Výška:", "Jednotky hodnot:"},
    {"Kanal:", "Breite:", "Höhe:", "Einheiten:"},
    {"Canal:", "Anchura:", "Altura:", "Value units:"},
    {"Canal :", "Largeur :", "Hauteur :", "Unités :"},
    {"Canal\xC2\xA0:", "Largeur\xC2\xA0:", "Hauteur\xC2\xA0:", "Unités\xC2\xA0:"},
    {"Canale:", "Larghezza:", "Altezza:", "unità valore:"},
    {"チャネル：", "幅:", "高さ：", "値の単位:"},
    {"채널:", "폭:", "높이:", "값 단위:"},
    {"Canal:", "Largura:", "Altura:", "Unidades de valor:"},
    {"Канал:", "Ширина:", "Высота:", "Единицы измерения:"},
};

std::string gwyddionText(const Words& words, const std::string& unit) {
  return std::string("# ") + words.title + " TUNA\n# " + words.width + " 4,000 µm\n# " +
         words.height + " 3,0 µm\n# " + words.unit_z + " " + unit + "\n" + kExportedGrid;
}

std::string exportRefusal(const std::string& name, const std::string& text) {
  const ScratchFolder folder;
  ScanOptions pitched;
  pitched.pitch_x = pitched.pitch_y = 1e-7;
  try {
    readScanFile(folder.write(name, text), pitched);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

void expectSides(const FileChannel& channel, double width, double height, double unit_z) {
  EXPECT_DOUBLE_EQ(channel.width, width);
  EXPECT_DOUBLE_EQ(channel.height, height);
  EXPECT_EQ(channel.unit_xy, "m");
  EXPECT_EQ(channel.unit_z, "m");
  ASSERT_EQ(channel.values.size(), cv::Size(4, 3));
  EXPECT_DOUBLE_EQ(channel.values.at<double>(2, 3), 14.0 * unit_z);
}

TEST(TextExports, GwyddionIsReadInEachLanguage) {
  for (const Words& words : kGwyddion) {
    SCOPED_TRACE(words.unit_z);
    const FileChannel channel = parseTextGrid(gwyddionText(words, "m"));
    EXPECT_EQ(channel.title, "TUNA");
    expectSides(channel, 4e-6, 3e-6, 1.0);
    expectSides(parseTextGrid(gwyddionText(words, "nm")), 4e-6, 3e-6, 1e-9);
  }
}

TEST(TextExports, AmperesAreNoMetresInAnyLanguage) {
  for (const Words& words : kGwyddion) {
    for (const char* unit : {"A", "nA", "V", "deg"}) {
      const std::string said = exportRefusal("a.txt", gwyddionText(words, unit));
      EXPECT_NE(said.find(std::string(", ") + unit + "]"), std::string::npos)
          << words.unit_z << ": " << said;
    }
  }
  EXPECT_NE(exportRefusal("spip.asc", "# File Format = ASCII\n# z-unit = A\n" + kExportedGrid), "");
  EXPECT_NE(exportRefusal("list.xyz", "X [nm] Y [nm] Z [A]\n0 0 1\n1 0 2\n0 1 3\n1 1 5\n"), "");
  EXPECT_NE(exportRefusal("matrix.txt", "TUNA_Current(A)\n" + kExportedGrid), "");
  EXPECT_DOUBLE_EQ(lengthUnit("нм").value_or(0.0), 1e-9);
  EXPECT_DOUBLE_EQ(lengthUnit("мкм").value_or(0.0), 1e-6);
  for (const char* word :
       {"Micrometer", "microns", "micrómetros", "Mikrometern", "マイクロメートル"}) {
    EXPECT_DOUBLE_EQ(lengthUnit(word).value_or(0.0), 1e-6) << word;
  }
  for (const char* word : {"Ångström", "Angstroms", "angstrom"})
    EXPECT_DOUBLE_EQ(heightUnit(word).value_or(0.0), 1e-10);
  EXPECT_FALSE(lengthUnit("micrometer-sized"));
  EXPECT_NE(exportRefusal("twice.txt", "# Value units: A\n# Value units: Å\n" + kExportedGrid)
                .find("twice"),
            std::string::npos);
  EXPECT_FALSE(heightUnit("A"));
  EXPECT_FALSE(heightUnit("[A]"));
  for (const char* angstrom : {"Å", "Angstrom", "AA"})
    EXPECT_DOUBLE_EQ(heightUnit(angstrom).value_or(0.0), 1e-10);
}

TEST(TextExports, ATitleWithAUnitIsNoUnitOfTheNumbers) {
  for (const char* title : {"TUNA [A]", "Height (nm)"}) {
    const std::string said =
        exportRefusal("a.txt", std::string("# Channel: ") + title + "\n" + kExportedGrid);
    EXPECT_NE(said.find("states no unit of its numbers"), std::string::npos) << said;
  }
  const FileChannel named = parseTextGrid("# Channel: Z (V)\n# Value units: nm\n" + kExportedGrid);
  EXPECT_DOUBLE_EQ(named.values.at<double>(2, 3), 14e-9);
}

TEST(TextExports, NumbersWithoutAUnitInGwyddionAreRefused) {
  for (const Words& words : kGwyddion) {
    EXPECT_NE(exportRefusal("a.txt", gwyddionText(words, "")).find("numbers have no unit"),
              std::string::npos);
  }
}

TEST(TextExports, AUnitUnderAWordThatIsNotKnownIsRefused) {
  const std::string said = exportRefusal("a.txt", "# Mértékegység: A\n" + kExportedGrid);
  EXPECT_NE(said.find("states a unit and is not understood"), std::string::npos) << said;
  EXPECT_EQ(exportRefusal("a.txt", "# Mértékegység: mV\n# Value units: nm\n" + kExportedGrid), "");
  for (const char* unit : {"[A]", "Ampere", "volts", "(mV)"}) {
    EXPECT_NE(exportRefusal("a.txt", std::string("# Mértékegység: ") + unit + "\n" + kExportedGrid),
              "")
        << unit;
  }
}

TEST(TextExports, TheHintNamesWhatTheLineStates) {
  const FileChannel side = parseTextGrid("# Szélesség: 2 um\n" + kExportedGrid);
  ASSERT_EQ(side.notes.size(), 1U);
  EXPECT_NE(side.notes[0].find("\"# Width: 2 um\""), std::string::npos) << side.notes[0];
  EXPECT_EQ(side.notes[0].find("Value units"), std::string::npos) << side.notes[0];
  EXPECT_EQ(side.unit_doubt, "");
  for (const char* remark : {"# Höhen in Nanometern\n", "# hauteurs en nanomètres\n",
                             "# высота, нанометры\n", "# 高度 纳米\n"}) {
    EXPECT_NE(parseTextGrid(remark + kExportedGrid).unit_doubt, "") << remark;
  }
  for (const char* remark : {"# heights in nm\n", "# \xC3\x89rt\xC3\xA9kek egys\xC3\xA9ge: nm\n"}) {
    const FileChannel heights = parseTextGrid(remark + kExportedGrid);
    EXPECT_TRUE(heights.notes.empty());
    EXPECT_NE(heights.unit_doubt.find("\"# Value units: nm\""), std::string::npos)
        << heights.unit_doubt;
    EXPECT_NE(exportRefusal("a.txt", remark + kExportedGrid).find("scan/height_scale"),
              std::string::npos);
  }
}

std::string spip(const std::string& unit, const std::string& line_end = "\n") {
  std::string text;
  for (const std::string line :
       {"# File Format = ASCII", "# Created by SPIP 6.3.2.0 2014-12-12 11:16", "# x-pixels = 4",
        "# y-pixels = 3", "# x-length = 2000", "# y-length = 1500", "# x-offset = 0",
        "# y-offset = 0", unit.c_str(), "# voidpixels =0", "# Start of Data:", "1 2 3 5", "5 6 7 9",
        "9 10 11 14"}) {
    text += line + line_end;
  }
  return text;
}

TEST(TextExports, LengthsOfSpipAreNanometres) {
  for (const char* line_end : {"\n", "\r\n", "\r"}) {
    expectSides(parseTextGrid(spip("# z-unit = nm", line_end)), 2e-6, 1.5e-6, 1e-9);
    expectSides(parseTextGrid(spip("# z-unit = um", line_end)), 2e-6, 1.5e-6, 1e-6);
    expectSides(parseTextGrid(spip("# Bit2nm = 0.5", line_end)), 2e-6, 1.5e-6, 0.5e-9);
  }
  const ScratchFolder folder;
  ScanFileOptions by_hand;
  by_hand.pitch_x = by_hand.pitch_y = 1e-7;
  const HeightMap surface =
      readScanFile(folder.write("a.asc", spip("# Bit2nm = 1.0")), {}, by_hand);
  EXPECT_DOUBLE_EQ(surface.height(2, 3), 14e-9);
  EXPECT_DOUBLE_EQ(surface.pitchX(), 1e-7);
}

TEST(TextExports, MakersHeadingsWithoutAUnitOfTheHeightsAreRefused) {
  for (const std::string& heading :
       {spip("# y-unit = nm"),
        "# Daisy saved frame\n# x-unit: um\n# x-length: 8\n# y-length: 6\n" + kExportedGrid,
        "Created by Nova\nScale X = 1\nScale Y = 1\nUnit X = um\n" + kExportedGrid}) {
    const std::string said = exportRefusal("a.asc", heading);
    EXPECT_NE(said.find("states no unit of the heights"), std::string::npos) << said;
  }
}

TEST(TextExports, VoidsOfSpipAreMissing) {
  std::string text = spip("# z-unit = nm");
  text.replace(text.find("voidpixels =0"), 13, "voidpixels = 1");
  const FileChannel channel = parseTextGrid(text + "1 1 1 1\n1 0 1 1\n1 1 1 1\n");
  expectSides(channel, 2e-6, 1.5e-6, 1e-9);
  EXPECT_TRUE(std::isnan(channel.values.at<double>(1, 1)));
  EXPECT_DOUBLE_EQ(channel.values.at<double>(1, 2), 7e-9);
  EXPECT_THROW(parseTextGrid(text + "1 1 1 1\n1 0 1 1\n1 1 1 2\n"), FileError);
  EXPECT_THROW(parseTextGrid(text), FileError);
}

TEST(TextExports, AttocubeStatesAUnitForEachAxis) {
  const std::string text =
      "# Daisy frame view snapshot\n# 2009-07-14T10:12:34\n# x-pixels: 4\n# y-pixels: 3\n# "
      "x-length: 8\n"
      "# y-length: 6\n# x-unit: um\n# y-unit: um\n# z-unit: nm\n# scanspeed: 2\n# display: "
      "Topography\n"
      "# Start of Data:\n";
  const FileChannel channel = parseTextGrid(text + kExportedGrid);
  expectSides(channel, 8e-6, 6e-6, 1e-9);
  EXPECT_EQ(channel.title, "Topography");
  std::string volts = text;
  volts.replace(volts.find("z-unit: nm"), 10, "z-unit: V");
  EXPECT_NE(exportRefusal("a.asc", volts + kExportedGrid), "");
  volts.replace(volts.find("x-unit: um"), 10, "x-unit: V");
  EXPECT_NE(exportRefusal("a.asc", volts + kExportedGrid).find("'V' is not a unit of length"),
            std::string::npos);
}

TEST(TextExports, NovaStatesThePixelInAUnitOfItsOwn) {
  const std::string text =
      "File Format = ASCII\nCreated by Nova\nNX = 4\nNY = 3\nScale X = 0,5\nScale Y = 0.25\nUnit X "
      "= um\n"
      "Unit Data = nm\nScale Data = 2\nDataScaleNeeded = ";
  const std::string data = "\nStart of Data :\n" + kExportedGrid;
  expectSides(parseTextGrid(text + "no" + data), 2e-6, 0.75e-6, 1e-9);
  expectSides(parseTextGrid(text + "Yes" + data), 2e-6, 0.75e-6, 2e-9);
  EXPECT_NE(exportRefusal("a.txt", text + data).find("DataScaleNeeded"), std::string::npos);
}

TEST(TextExports, KeyenceHasCommasSemicolonsOrNoQuotes) {
  const std::string commas =
      "\"Model\",\"VR-6000\"\n\"XY Calibration\",\"7.5\",\"um\"\n\"Output image "
      "data\",\"Height\"\n\"Horizontal\",\"4\"\n"
      "\"Vertical\",\"3\"\n\"Unit\",\"mm\"\n\n\"Height\"\n\"1\",\"2\",\"3\",\"5\"\n\"5\",\"6\","
      "\"7\",\"9\"\n"
      "\"9\",\"10\",\"11\",\"14\"\n";
  std::string semicolons = commas;
  std::replace(semicolons.begin(), semicolons.end(), ',', ';');
  std::string german = semicolons;
  german.replace(german.find("7.5"), 3, "7,5");
  std::string bare = semicolons;
  bare.erase(std::remove(bare.begin(), bare.end(), '"'), bare.end());
  for (const std::string& text : {commas, semicolons, german, bare}) {
    expectSides(parseTextGrid(text), 3e-5, 2.25e-5, 1e-3);
  }
  std::string without = semicolons;
  without.erase(without.find("\"Unit\""), 12);
  EXPECT_NE(exportRefusal("a.csv", without).find("states no unit of the heights"),
            std::string::npos);
}

TEST(TextExports, ANameWithAUnitIsThatOfTheMatrix) {
  const FileChannel channel = parseTextGrid("Height_Sensor(nm)\n" + kExportedGrid);
  EXPECT_EQ(channel.title, "Height Sensor");
  EXPECT_DOUBLE_EQ(channel.values.at<double>(2, 3), 14e-9);
}

TEST(TextExports, WhatWindowsPrintsForNoNumberIsMissing) {
  for (const char* word : {"-nan(ind)", "nan(ind)", "nan(snan)", "1.#QNAN", "-1.#IND", "1.#INF",
                           "1.#QNAN0", "-1.#IND00"}) {
    for (const char* separator : {"\t", ",", ";", " "}) {
      const std::string between = separator;
      const FileChannel channel =
          parseTextGrid("1.5" + between + word + "\n2.5" + between + "3.25\n");
      EXPECT_TRUE(std::isnan(channel.values.at<double>(0, 1))) << word << between;
      EXPECT_DOUBLE_EQ(channel.values.at<double>(1, 1), 3.25) << word << between;
    }
  }
  EXPECT_TRUE(std::isnan(parseTextGrid("1,5\t-1,#IND\n2,5\t3,25\n").values.at<double>(0, 1)));
  EXPECT_TRUE(std::isnan(parseTextGrid("1,5\t-1.#IND\n2,5\t3,25\n").values.at<double>(0, 1)));
  EXPECT_TRUE(std::isnan(parseTextGrid("-nan(ind)\t1\n2\t3.5\n").values.at<double>(0, 0)));
  EXPECT_THROW(parseTextGrid("1.5\t1.#\n2.5\t3.25\n"), FileError);
}

TEST(GsfFile, IsReadInMetresAlone) {
  const ScratchFolder folder;
  const HeightMap surface =
      readScanFile(folder.write("a.gsf", scan_bytes::gsf("XYUnits = m\nZUnits = m\n")));
  EXPECT_DOUBLE_EQ(surface.pitchX(), 2e-6);
  EXPECT_DOUBLE_EQ(surface.pitchY(), 1e-6);
  EXPECT_DOUBLE_EQ(surface.height(1, 1), static_cast<double>(5e-9F));
  for (const char* units : {"XYUnits = um\nZUnits = m\n", "XYUnits = m\nZUnits = nm\n"}) {
    const std::string said = exportRefusal("a.gsf", scan_bytes::gsf(units));
    EXPECT_NE(said.find("units without prefix alone"), std::string::npos) << said;
  }
  EXPECT_NE(exportRefusal("a.gsf", scan_bytes::gsf("XYUnits = m\nZUnits = A\n")).find("A]"),
            std::string::npos);
  EXPECT_NE(exportRefusal("a.gsf", scan_bytes::gsf("XYUnits = m\nXYUnits = m\n")).find("twice"),
            std::string::npos);
  EXPECT_NE(
      exportRefusal("a.gsf", scan_bytes::gsf("ZUnits = m\n") + "1234").find("cut off or damaged"),
      std::string::npos);
}

TEST(TmdFile, IsInMillimetres) {
  const ScratchFolder folder;
  for (const char* comment : {"Created by TrueMap v6\r\n", ""}) {
    const HeightMap surface = readScanFile(folder.write("a.tmd", scan_bytes::tmd(comment)));
    EXPECT_DOUBLE_EQ(surface.pitchX(), 2e-3);
    EXPECT_DOUBLE_EQ(surface.pitchY(), 1e-3);
    EXPECT_DOUBLE_EQ(surface.height(1, 1), 1e-3 * static_cast<double>(0.005F));
  }
  EXPECT_NE(exportRefusal("a.tmd", scan_bytes::tmd("") + "1").find("cut off or damaged"),
            std::string::npos);
  EXPECT_NE(exportRefusal("a.tmd", scan_bytes::tmd("", 0.0F)).find("not > 0"), std::string::npos);
  EXPECT_NE(exportRefusal("a.tmd", scan_bytes::tmd("").substr(0, 40)), "");
}

}  // namespace
}  // namespace mems_stiction
