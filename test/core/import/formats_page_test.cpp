/// The table of formats in doc/scans.md: every row of it is read, and keeps its missing data as it
/// says.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>

#include "height_map/validity.hpp"
#include "import/scan_writer.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/gwy_bytes.hpp"
#include "support/scan_bytes.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

using namespace scan_bytes;

/// First column of the table's rows.
std::set<std::string> rowsOfThePage() {
  std::ifstream page(std::string(MEMS_STICTION_DOC_DIR) + "/scans.md");
  std::set<std::string> rows;
  bool is_table = false;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("| format |", 0) == 0) is_table = true;
    if (line.empty()) is_table = false;
    if (is_table && line.rfind("| `", 0) == 0) rows.insert(line.substr(2, line.find(" | ", 2) - 2));
  }
  return rows;
}

/// A file, made in the folder or public, and how many of its pixels are missing.
struct Example {
  std::function<std::string(const ScratchFolder&)>
      make;  ///< the path; empty if it cannot be had here
  int missing = 0;
};

Example written(const std::string& name, const std::string& bytes, int missing) {
  return {[=](const ScratchFolder& folder) { return folder.write(name, bytes); }, missing};
}

Example byGwyddion(const std::string& name, const std::string& bytes, int missing = 0) {
  return {[=](const ScratchFolder& folder) {
            return MEMS_STICTION_HAS_GWYDDION ? folder.write(name, bytes) : std::string();
          },
          missing};
}

Example published(const std::string& name, int missing = 0) {
  return {[=](const ScratchFolder&) {
            const char* scans = std::getenv("MEMS_STICTION_SCANS");
            return scans == nullptr ? std::string() : std::string(scans) + "/" + name;
          },
          missing};
}

Example tiff() {
  return {[](const ScratchFolder& folder) {
            cv::Mat heights = (cv::Mat_<double>(2, 2) << 1.0, std::nan(""), 3.0, 4.0);
            writeHeightTiff(folder.file("a.tif"), heights);
            return folder.file("a.tif");
          },
          1};
}

std::string npyWithNan() {
  std::string data;
  for (const double value : {1.0, 2.0, std::nan(""), 4.0, 5.0, 6.0}) data += littleBytes(value);
  return npy("<f8", data);
}

std::string sdf() {
  return "aISO-1.0\r\nManufacID = maker\r\nCreateDate = 010120260000\r\nModDate = "
         "010120260000\r\nNumPoints = 3\r\n"
         "NumProfiles = 2\r\nXscale = 1e-6\r\nYscale = 2e-6\r\nZscale = 1e-9\r\nZresolution = "
         "-1\r\nCompression = 0\r\n"
         "DataType = 7\r\nCheckType = 0\r\n*\r\n1 2 3\r\n4 5 7\r\n*\r\n";
}

std::string wsxmImage() {
  std::string data;
  for (int i = 0; i < 6; ++i) data += littleBytes(static_cast<double>(i));
  return wsxm("double", "2 nm", "5 nm", data);
}

const std::map<std::string, std::vector<Example>> kRows = {
    {"`.tif`", {tiff()}},
    {"`.png`", {written("a.png", png(4, 2, 4, std::string("\0\x01\x2F\0\xE0\x70", 6)), 0)}},
    {"`.exr`", {written("a.exr", exr({"Z"}, 5, 4), 0)}},
    {"`.npy`", {written("a.npy", npyWithNan(), 1)}},
    {"`.txt` `.asc` `.csv`",
     {written("a.txt", "1.5 nan\n2.5 3.5\n", 1), written("a.asc", "1.5\tinf\n2.5\t3.5\n", 1),
      written("a.csv", "1.5,,2\n4,5,6\n", 1)}},
    {"`.xyz`", {written("a.xyz", "0 0 1.5\n1 0 2.5\n0 1 0.5\n1 1 0.25\n0 2 7.5\n", 1)}},
    {"`.grd`",
     {written("a.grd", "DSAA\n3 2\n0 2e-9\n0 1e-9\n0 1e-9\n0 1e-9 0\n2e-9 1.70141e+38 5e-10\n",
              1)}},
    {"`.gwy`", {written("a.gwy", gwy_bytes::example(), 1)}},
    {"`.stp` `.top`", {written("a.stp", wsxmImage(), 0), published("top-1.top")}},
    {"`.gsf`", {written("a.gsf", gsf("XYUnits = m\nZUnits = m\n", true), 1)}},
    {"`.tmd`", {written("a.tmd", tmd("Created by TrueMap v6\r\n"), 0)}},
    {"`.sur`", {written("a.sur", sur(Sur{}), 1), published("misread/sur-2.sur", 117)}},
    {"`.nc`", {written("a.nc", heights("nm"), 0)}},
    {"`.di`", {published("di-3.di"), published("di-5.di"), published("di-6.di")}},
    {"`.opd`", {published("opd-1.opd", 116)}},
    {"`.x3p`", {published("x3p-2.x3p")}},
    {"`.al3d`", {published("al3d-1.al3d")}},
    {"`.sdf`", {byGwyddion("a.sdf", sdf())}},
    {"`.tiff` of Park", {published("example_ps.tiff")}}};

TEST(FormatsPage, HasARowForEachFormatThatIsTested) {
  std::set<std::string> tested;
  for (const auto& row : kRows) tested.insert(row.first);
  EXPECT_EQ(rowsOfThePage(), tested);
}

TEST(FormatsPage, EveryRowIsReadAndKeepsItsMissingData) {
  ScanOptions options;
  options.pitch_x = options.pitch_y = 1e-9;
  int read = 0;
  for (const auto& [row, examples] : kRows) {
    for (const Example& example : examples) {
      const ScratchFolder folder;
      const std::string path = example.make(folder);
      if (path.empty()) continue;
      SCOPED_TRACE(row + " " + path);
      const HeightMap surface = readScanFile(path, options);
      EXPECT_EQ(surface.rows() * surface.cols() - cv::countNonZero(validMask(surface.heights())),
                example.missing);
      ++read;
    }
  }
  EXPECT_GE(read, 12) << "those that are written here";
}

}  // namespace
}  // namespace mems_stiction
