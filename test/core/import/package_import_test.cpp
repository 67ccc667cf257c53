/// Files that neither this project nor Gwyddion reads: by SurfaceTopography, or AFMReader. A
/// package of the same calls stands in for each, so that the tests do not hang on what is
/// installed.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "import/format_readers.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

bool hasNumpy() { return std::system("/usr/bin/python3 -c 'import numpy' >/dev/null 2>&1") == 0; }

constexpr const char* kTopographies = R"(
import numpy
class Channel:
    def __init__(self, name, unit, dim=2):
        self.name, self.unit, self.dim, self.physical_sizes = name, unit, dim, (6.0, 2.0)
    def topography(self):
        return self
    def heights(self):
        return numpy.ma.masked_equal(numpy.arange(6.0).reshape(3, 2), 4.0)
class Reader:
    def __init__(self, path):
        self.content = open(path).read()
        self.channels = [Channel("Line", "um", 1), Channel("Phase", ("um", "deg")), Channel("Height", "um")]
        if "damaged" in self.content:
            raise ValueError("cannot be read")
    def format(self):
        return "hgt" if "anything" in self.content else "new"
def open_topography(path):
    return Reader(path)
)";

constexpr const char* kFrames = R"(
import numpy
def load_asd(path, channel):
    assert channel == "TP"
    return numpy.arange(12.0).reshape(2, 2, 3), 2.0, {"x_nm": 6.0, "y_nm": 2.0}
)";

class Packages : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!hasNumpy()) GTEST_SKIP() << "needs python3-numpy";
    folder_.write("SurfaceTopography.py", kTopographies);
    std::filesystem::create_directory(folder_.file("AFMReader"));
    folder_.write("AFMReader/__init__.py", "");
    folder_.write("AFMReader/asd.py", kFrames);
    const char* before = std::getenv("PYTHONPATH");
    before_ = before == nullptr ? "" : before;
    setenv("PYTHONPATH", (folder_.file("") + ":" + before_).c_str(), 1);
    options_.import.gwyddion_reader = "no-such-program";
  }
  void TearDown() override { setenv("PYTHONPATH", before_.c_str(), 1); }

  std::string refusalOf(const std::string& name, const std::string& content) {
    try {
      openScanFile(folder_.write(name, content), {}, options_);
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  }

  ScratchFolder folder_;
  ScanFileOptions options_;
  std::string before_;
};

TEST_F(Packages, SurfaceTopographyReadsWhatNobodyElseDoesAndIsNamed) {
  const ScanFile scan =
      openScanFile(folder_.write("scan.new", "a format of its own"), {}, options_);
  EXPECT_EQ(scan.channel, "1: Height");  // lines are no channels
  ASSERT_FALSE(scan.notes.empty());
  EXPECT_EQ(scan.notes[0], "read by SurfaceTopography");  // the stand-in states no version
  ASSERT_EQ(scan.surface.cols(), 3);                      // its first index is x
  ASSERT_EQ(scan.surface.rows(), 2);
  EXPECT_DOUBLE_EQ(scan.surface.pitchX(), 2e-6);
  EXPECT_DOUBLE_EQ(scan.surface.pitchY(), 1e-6);
  EXPECT_NEAR(scan.surface.height(1, 2), 5e-6, 1e-18);
  EXPECT_FALSE(std::isfinite(scan.surface.height(0, 2)));
  EXPECT_FALSE(scan.identity.checksum.empty());
}

TEST_F(Packages, AfmReaderReadsTheFirstFrameOfAsd) {
  folder_.write("SurfaceTopography.py", "raise ImportError\n");
  const ScanFile scan = openScanFile(folder_.write("scan.asd", "frames"), {}, options_);
  ASSERT_FALSE(scan.notes.empty());
  EXPECT_EQ(scan.notes[0], "read by AFMReader, the first of 2 frames");
  ASSERT_EQ(scan.surface.cols(), 3);
  EXPECT_DOUBLE_EQ(scan.surface.pitchX(), 2e-9);
  EXPECT_DOUBLE_EQ(scan.surface.pitchY(), 1e-9);
  EXPECT_NEAR(scan.surface.height(1, 2), 5e-9, 1e-21);
}

TEST_F(Packages, WhatTheyDoNotReadIsRefusedInTheWordsOfBefore) {
  for (const char* content : {"damaged", "anything is of this format"}) {
    EXPECT_NE(refusalOf("scan.new", content).find("needs Gwyddion's readers to be read"),
              std::string::npos)
        << content;
  }
  folder_.write("SurfaceTopography.py", "raise ImportError\n");
  EXPECT_NE(refusalOf("scan.new", "a format of its own").find("needs Gwyddion's readers"),
            std::string::npos);
}

TEST_F(Packages, AFormatThatOnlyOneOfThemReadsSaysWhich) {
  folder_.write("SurfaceTopography.py", "raise ImportError\n");
  folder_.write("AFMReader/asd.py", "raise ImportError\n");
  EXPECT_NE(
      refusalOf("scan.mnt", "a format of its own").find("by the Python package SurfaceTopography"),
      std::string::npos);
  EXPECT_NE(refusalOf("scan.asd", "frames").find("by the Python package AFMReader"),
            std::string::npos);
  EXPECT_EQ(refusalOf("scan.new", "a format of its own").find("Python package"), std::string::npos);
}

TEST_F(Packages, DamagedFilesOfKnownFormatsAreNotGivenToThem) {
  EXPECT_NE(refusalOf("scan.x3p", "PK\3\4 cut off").find("zip archive"), std::string::npos);
  // Knows the format, or calls itself so, and has failed.
  options_.import.gwyddion_reader = "false";
  EXPECT_NE(refusalOf("scan.new", "a format of its own").find("gwyddion cannot read it"),
            std::string::npos);
}

}  // namespace
}  // namespace mems_stiction
