#include "mems_stiction/import/scan_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "files/child_process.hpp"
#include "import/format_readers.hpp"
#include "import/scan_writer.hpp"
#include "import/tiff_tags.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "support/binary_writer.hpp"
#include "support/gwy_bytes.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

ScanOptions withPitch(double pitch_x = 2e-9, double pitch_y = 3e-9) {
  ScanOptions options;
  options.pitch_x = pitch_x;
  options.pitch_y = pitch_y;
  return options;
}

/// Heights that differ in every pixel, all of them float32 numbers.
cv::Mat example(int type) {
  cv::Mat heights(5, 7, CV_64FC1);
  for (int row = 0; row < 5; ++row) {
    for (int col = 0; col < 7; ++col) heights.at<double>(row, col) = 10 * row + col;
  }
  heights.convertTo(heights, type);
  return heights;
}

void expectExample(const HeightMap& surface, double scale = 1.0) {
  ASSERT_EQ(surface.rows(), 5);
  ASSERT_EQ(surface.cols(), 7);
  for (int row = 0; row < 5; ++row) {
    for (int col = 0; col < 7; ++col) EXPECT_EQ(surface.height(row, col), (10 * row + col) * scale);
  }
}

/// What reading the file complains about.
std::string refusal(const std::string& path, const ScanOptions& options = withPitch()) {
  try {
    readScanFile(path, options);
  } catch (const FileError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(path), std::string::npos) << "the file is not named: " << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << "more than one line: " << text;
    return text;
  }
  return "";
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(ScanFile, ReadsTiffOfEveryPixelType) {
  const ScratchFolder folder;
  for (const int type : {CV_32FC1, CV_64FC1, CV_32SC1, CV_16UC1, CV_8UC1}) {
    if (type == CV_32SC1 && CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR < 6)
      continue;  // OpenCV cannot write it
    const std::string path = folder.file("scan" + std::to_string(type) + ".tiff");
    ASSERT_TRUE(cv::imwrite(path, example(type)));
    const HeightMap surface = readScanFile(path, withPitch());
    expectExample(surface);
    EXPECT_EQ(surface.pitchX(), 2e-9);
    EXPECT_EQ(surface.pitchY(), 3e-9);
    ScanOptions nanometres = withPitch();
    nanometres.height_scale = 1e-9;
    expectExample(readScanFile(path, nanometres), 1e-9);
  }
}

TEST(ScanFile, ReadsPngAndExr) {
  const ScratchFolder folder;
  ASSERT_TRUE(cv::imwrite(folder.file("scan.png"), example(CV_16UC1)));
  expectExample(readScanFile(folder.file("scan.png"), withPitch()));
  // An OpenEXR file by its definition would need its library; OpenCV writes one where it has it.
  setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 1);
  try {
    ASSERT_TRUE(cv::imwrite(folder.file("scan.exr"), example(CV_32FC1)));
  } catch (const cv::Exception& error) {
    GTEST_SKIP() << "this OpenCV has no OpenEXR: " << error.err;
  }
  expectExample(readScanFile(folder.file("scan.exr"), withPitch()));
}

TEST(ScanFile, ReadsTextWithEverySeparator) {
  const ScratchFolder folder;
  for (const std::string separator : {" ", ",", ";", "\t", ", ", "   "}) {
    std::string text = "# a comment\n\n";
    for (int row = 0; row < 5; ++row) {
      for (int col = 0; col < 7; ++col)
        text += (col == 0 ? "" : separator) + std::to_string(10 * row + col);
      text += row == 2 ? " # remark\r\n" : "\n";
    }
    for (const char* name : {"scan.txt", "scan.ASC", "scan.csv"}) {
      expectExample(readScanFile(folder.write(name, text), withPitch()));
    }
  }
}

TEST(TextGrid, CellsThatAreNotMeasuredAreNaN) {
  const ScratchFolder folder;
  const cv::Mat grid = parseTextGrid("1e-9,nan,3\n,NaN,6\n7,,9\n").values;
  ASSERT_EQ(grid.size(), cv::Size(3, 3));
  EXPECT_EQ(grid.at<double>(0, 0), 1e-9);
  EXPECT_TRUE(std::isnan(grid.at<double>(0, 1)));
  EXPECT_TRUE(std::isnan(grid.at<double>(1, 0)));
  EXPECT_TRUE(std::isnan(grid.at<double>(2, 1)));
  EXPECT_EQ(grid.at<double>(2, 2), 9.0);
}

TEST(TextGrid, WhatIsNotAGridIsRefusedWithTheLine) {
  const ScratchFolder folder;
  EXPECT_TRUE(
      mentions(refusal(folder.write("a.txt", "1 2\n3 x4\n")), "line 2: 'x4' is not a number"));
  EXPECT_TRUE(mentions(refusal(folder.write("b.txt", "1 2 3\n4 5 6\n7 8\n")), "line 3: 2 cells"));
  EXPECT_TRUE(mentions(refusal(folder.write("c.txt", "# nothing\n")), "at least 2 x 2"));
  EXPECT_TRUE(mentions(refusal(folder.write("d.txt", "1 2 3\n")), "at least 2 x 2"));
  EXPECT_TRUE(
      mentions(refusal(folder.write("e.txt", std::string("1 2\n3 \0 4\n", 10))), "line 2: binary"));
  EXPECT_TRUE(mentions(refusal(folder.write("f.csv", "1,2\n3,4e\n")), "'4e' is not a number"));
}

TEST(ScanFile, MissingPitchSaysHowToGiveIt) {
  const ScratchFolder folder;
  const std::string path = folder.write("scan.txt", "1 2\n3 4\n");
  EXPECT_TRUE(mentions(refusal(path, {}),
                       "its pixel pitch is not stated: give scan/pitch_x and scan/pitch_y in the "
                       "configuration or in scan.txt.yaml"));
  ScanFileOptions with_option;
  with_option.pitch_option = "--pitch";
  try {
    readScanFile(path, {}, with_option);
    FAIL() << "its program has the option, which is advised";
  } catch (const FileError& error) {
    EXPECT_TRUE(mentions(error.what(), "is not stated: give --pitch, or scan/pitch_x"));
  }
}

TEST(ScanFile, PitchByOptionGoesBeforeSidecarBeforeConfiguration) {
  const ScratchFolder folder;
  const std::string path = folder.write("scan.txt", "1 2\n3 4\n");
  folder.write("scan.txt.yaml", "pitch_x: 5e-9\npitch_y: 6e-9\nheight_scale: 1e-9\n");
  HeightMap surface = readScanFile(path, withPitch());
  EXPECT_EQ(surface.pitchX(), 5e-9);
  EXPECT_EQ(surface.pitchY(), 6e-9);
  EXPECT_EQ(surface.height(1, 1), 4e-9);
  ScanFileOptions options;
  options.pitch_x = options.pitch_y = 7e-9;
  surface = readScanFile(path, withPitch(), options);
  EXPECT_EQ(surface.pitchX(), 7e-9);
  EXPECT_EQ(surface.height(1, 1), 4e-9);
}

TEST(ScanFile, SidecarMayBeSpelledLikeAConfiguration) {
  const ScratchFolder folder;
  const std::string path = folder.write("scan.txt", "1 2\n3 4\n");
  folder.write("scan.yaml", "scan: {pitch_x: 5e-9, pitch_y: 6e-9}\nscan/invalid_value: 4\n");
  const HeightMap surface = readScanFile(path);
  EXPECT_EQ(surface.pitchY(), 6e-9);
  EXPECT_TRUE(std::isnan(surface.height(1, 1)));
}

TEST(ScanFile, SidecarErrorsNameTheSidecar) {
  const ScratchFolder folder;
  const std::string path = folder.write("scan.txt", "1 2\n3 4\n");
  const std::string sidecar = folder.write("scan.txt.yaml", "pitch: 5e-9\nheight_scale: 0\n");
  try {
    readScanFile(path);
    FAIL();
  } catch (const OptionsError& error) {
    ASSERT_EQ(error.violations().size(), 2u);
    for (const std::string& line : error.violations())
      EXPECT_EQ(line.find(sidecar + ": scan/"), 0u) << line;
  }
  folder.write("scan.txt.yaml", "a: [1, 2");
  EXPECT_THROW(readScanFile(path), FileError);
}

/// What is said of the file, in one text.
std::string notesOn(const std::string& path, const ScanOptions& options = {},
                    const ScanFileOptions& file_options = {}) {
  std::string text;
  for (const std::string& note : openScanFile(path, options, file_options).notes)
    text += note + "\n";
  return text;
}

TEST(ScanFile, WhatAMakersFileGoesBeforeIsSaid) {
  const ScratchFolder folder;
  const std::string path = folder.write("scan.gwy", gwy_bytes::example());  // 1 x 2 um a pixel
  const std::string silent = notesOn(path);
  EXPECT_EQ(notesOn(path, withPitch(1e-6, 2e-6)), silent);
  EXPECT_TRUE(mentions(notesOn(path, withPitch()),
                       "the file states a pitch of 1e-06 x 2e-06 m, which is taken, 2e-09 x "
                       "3e-09 m of the configuration is not"));
  const std::string sidecar =
      folder.write("scan.gwy.yaml", "pitch_x: 5e-9\npitch_y: 6e-9\nheight_scale: 1e-9\n");
  const std::string notes = notesOn(path);
  EXPECT_TRUE(mentions(notes, "5e-09 x 6e-09 m of " + sidecar + " is not\n")) << notes;
  ScanFileOptions with_option;
  with_option.pitch_option = "--pitch";
  EXPECT_TRUE(mentions(notesOn(path, {}, with_option), " is not; --pitch goes before both\n"));
  EXPECT_TRUE(mentions(notes, "scan/height_scale 1e-09 of " + sidecar + " is not applied"))
      << notes;
  ScanFileOptions by_option;
  by_option.pitch_x = by_option.pitch_y = 7e-9;
  EXPECT_FALSE(mentions(notesOn(path, {}, by_option), "5e-09"));
  folder.write("scan.gwy.yaml", "part_id: 17\n");
  EXPECT_EQ(notesOn(path), silent);
  ScanOptions scaled;
  scaled.height_offset = 1e-6;
  scaled.invalid_value = 0.0;
  const std::string all = notesOn(path, scaled);
  EXPECT_TRUE(mentions(all, "scan/height_offset 1e-06 of the configuration is not applied")) << all;
  EXPECT_TRUE(mentions(all, "scan/invalid_value 0 of the configuration is not applied")) << all;
}

TEST(ScanFile, WhatAHeadingGoesBeforeIsSaidToo) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "scan.txt", "# Width: 2 um\n# Height: 2 um\n# Value units: m\n1e-9 2e-9\n3e-9 4e-9\n");
  EXPECT_EQ(notesOn(path), "");
  ScanOptions options = withPitch();
  options.height_scale = 1e-9;
  const std::string notes = notesOn(path, options);
  EXPECT_TRUE(mentions(notes, "2e-09 x 3e-09 m of the configuration is not")) << notes;
  EXPECT_TRUE(mentions(notes, "scan/height_scale 1e-09 of the configuration is not applied"))
      << notes;
}

TEST(ScanFile, ASidecarThatIsNoFileIsNamed) {
  const ScratchFolder folder;
  const std::string path = folder.write("scan.txt", "1 2\n3 4\n");
  const std::string sidecar = folder.file("scan.txt.yaml");
  std::filesystem::create_symlink(folder.file("gone.yaml"), sidecar);
  EXPECT_TRUE(mentions(refusal(path), sidecar + ": is a link that leads nowhere"));
  std::filesystem::remove(sidecar);
  std::filesystem::create_directory(sidecar);
  EXPECT_TRUE(mentions(refusal(path), sidecar + ": is a folder"));
  std::filesystem::remove(sidecar);
  ASSERT_EQ(mkfifo(sidecar.c_str(), 0600), 0);
  EXPECT_TRUE(mentions(refusal(path), sidecar + ": is a pipe"));
}

TEST(ScanFile, ASidecarThatStatesNothingIsSaid) {
  const ScratchFolder folder;
  const std::string path = folder.write("scan.txt", "1 2\n3 4\n");
  const std::string sidecar = folder.write("scan.txt.yaml", "# pitch_x: 5e-9\n");
  EXPECT_EQ(notesOn(path, withPitch()), sidecar + ": states nothing, the defaults hold\n");
  folder.write("scan.txt.yaml", "scan:\npart_id: A\n");
  EXPECT_EQ(notesOn(path, withPitch()),
            sidecar + ": scan: has nothing below it, the defaults hold\n");
}

TEST(ScanFile, AFileOfTheScansStemIsItsSidecarIfItLooksLikeOne) {
  const ScratchFolder folder;
  const std::string path = folder.write("one.txt", "1 2\n3 4\n");
  for (const char* text :
       {"pitch_x: 5e-9\npitch_y: 5e-9\n", "scan: {pitch_x: 5e-9, pitch_y: 5e-9}\n",
        "scan/pitch_x: 5e-9\npitch_y: 5e-9\nwafer_id: W3\n"}) {
    EXPECT_EQ(sidecarOf(path), folder.write("one.yaml", text)) << text;
    EXPECT_EQ(readScanFile(path).pitchX(), 5e-9) << text;
    EXPECT_EQ(notesOn(path), "") << text;
  }
  for (const char* text :
       {"interface: {work_of_adhesion: 0.1}\nscan: {pitch_x: 5e-9, pitch_y: 5e-9}\n", "- 1\n- 2\n",
        "load/voltage: 5\nscan/pitch_x: 5e-9\n", "title: notes of the day\n", "a: [1",
        "\x01\x02"}) {
    const std::string other = folder.write("one.yaml", text);
    EXPECT_EQ(sidecarOf(path), "") << text;
    EXPECT_EQ(readScanFile(path, withPitch()).pitchX(), 2e-9) << text;
    EXPECT_EQ(notesOn(path, withPitch()).find(other + " is not read as its sidecar"), 0u) << text;
  }
  const std::string whole = folder.write("one.txt.yaml", "pitch_x: 6e-9\npitch_y: 6e-9\n");
  EXPECT_EQ(sidecarOf(path), whole);
  EXPECT_EQ(notesOn(path), "");
}

TEST(ScanFile, WhatIsScannedIsStatedByTheSidecarAndTheFilesBytes) {
  const ScratchFolder folder;
  const std::string path = folder.write("place 3.txt", "1 2\n3 4\n");
  EXPECT_EQ(openScanFile(path, withPitch()).identity.scan_name, "place 3");
  folder.write("place 3.txt.yaml",
               "pitch_x: 5e-9\npitch_y: 5e-9\nserial_id: 0012\nscan/lot_id: L7\nscan: {wafer_id: "
               "W3, site_x: -5e-3}\n"
               "site_y: 0.0\noperator_name: ann\ninstrument: AFM 2\nacquisition_time: "
               "2026-03-01T14:05:00+01:00\n");
  const ScanIdentity identity = openScanFile(path).identity;
  EXPECT_EQ(identity.scan_name, "place 3");
  EXPECT_EQ(identity.part_id, "");
  EXPECT_EQ(identity.serial_id, "0012");
  EXPECT_EQ(identity.lot_id, "L7");
  EXPECT_EQ(identity.wafer_id, "W3");
  EXPECT_EQ(identity.site_x, -5e-3);
  EXPECT_EQ(identity.site_y, 0.0);
  EXPECT_EQ(identity.operator_name, "ann");
  EXPECT_EQ(identity.instrument, "AFM 2");
  EXPECT_EQ(identity.acquisition_time, "2026-03-01T14:05:00+01:00");
  EXPECT_EQ(identity.checksum,
            "sha256:871d6e7f463a42c5573203c50db6e52da506d5395af73e09237410dec5eff856");
}

TEST(ScanFile, ASidecarWithHalfASiteOrATextThatNobodyReadsIsRefused) {
  const ScratchFolder folder;
  const std::string path = folder.write("scan.txt", "1 2\n3 4\n");
  const std::string pitch = "pitch_x: 5e-9\npitch_y: 5e-9\n";
  for (const auto& [lines, complaint] : std::vector<std::pair<std::string, std::string>>{
           {"site_x: 0.01\n", "scan/site_x: 0.01 is stated without site_y: state both, or none"},
           {"site_x: .inf\nsite_y: 0\n", "scan/site_x: inf is not allowed"},
           {"checksum: sha256:0\n", "scan/checksum: "},
           {"operator: ann\n", "scan/operator_name"},
           {"wafer_id: " + std::string(1001, 'w') + "\n",
            "scan/wafer_id: a name of 1001 bytes is not allowed"}}) {
    const std::string sidecar = folder.write("scan.txt.yaml", pitch + lines);
    try {
      openScanFile(path);
      ADD_FAILURE() << lines;
    } catch (const OptionsError& error) {
      EXPECT_TRUE(mentions(error.what(), sidecar + ": scan/") && mentions(error.what(), complaint))
          << error.what();
    }
  }
}

TEST(ScanFile, FilesThatAreNoScansAreRefused) {
  const ScratchFolder folder;
  EXPECT_TRUE(mentions(refusal(folder.file("none.tiff")), "no such file"));
  EXPECT_TRUE(mentions(refusal(folder.write("empty.tiff", "")), "is empty"));
  EXPECT_TRUE(mentions(refusal(folder.write("text.tiff", "this is no image")), "not a tiff image"));
  EXPECT_TRUE(mentions(refusal(folder.write("text.png", "this is no image")), "not a png image"));
  std::filesystem::create_directory(folder.file("folder.tiff"));
  EXPECT_TRUE(mentions(refusal(folder.file("folder.tiff")), "is a folder"));
  ASSERT_TRUE(cv::imwrite(folder.file("colour.png"), cv::Mat::zeros(4, 4, CV_8UC3)));
  EXPECT_TRUE(mentions(refusal(folder.file("colour.png")), "3 channels"));
  ASSERT_TRUE(cv::imwrite(folder.file("colour.tiff"), cv::Mat::zeros(4, 4, CV_8UC3)));
  EXPECT_TRUE(mentions(refusal(folder.file("colour.tiff")), "3 channels"));
}

TEST(ScanFile, EveryTruncatedTiffIsRefused) {
  const ScratchFolder folder;
  for (const int type : {CV_32FC1, CV_16UC1}) {
    cv::Mat heights(16, 16, type);
    cv::randu(heights, 1, 200);
    ASSERT_TRUE(cv::imwrite(folder.file("whole.tiff"), heights));
    const std::string whole = ScratchFolder::read(folder.file("whole.tiff"));
    for (std::size_t size = 0; size < whole.size(); size += 13) {
      EXPECT_NE(refusal(folder.write("cut.tiff", whole.substr(0, size))), "")
          << size << " of " << whole.size();
    }
  }
}

TEST(ScanFile, DamagedTiffIsReadOrRefused) {
  const ScratchFolder folder;
  ASSERT_TRUE(cv::imwrite(folder.file("whole.tiff"), example(CV_32FC1)));
  const std::string whole = ScratchFolder::read(folder.file("whole.tiff"));
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0xFF);
    try {
      readScanFile(folder.write("damaged.tiff", damaged), withPitch());
    } catch (const FileError&) {
    }
  }
}

TEST(ScanFile, HeightTiffReadsBack) {
  const ScratchFolder folder;
  cv::Mat heights = example(CV_64FC1) * 1e-9;
  heights.at<double>(2, 3) = std::nan("");
  const std::string path = folder.file("out.any_ending");
  writeHeightTiff(path, heights);
  EXPECT_EQ(cv::imread(path, cv::IMREAD_UNCHANGED).type(), CV_32FC1);
  const HeightMap back = readScanFile(path, withPitch());
  EXPECT_TRUE(std::isnan(back.height(2, 3)));
  EXPECT_FLOAT_EQ(static_cast<float>(back.height(4, 6)), 46e-9F);
}

TEST(ScanFile, HeightTiffKeepsNanometresOnAStageOffset) {
  const ScratchFolder folder;
  const cv::Mat heights =
      example(CV_64FC1) * 1e-9 + 0.076;  // float32 numbers are 7.45 nm apart there
  writeHeightTiff(folder.file("out.tiff"), heights);
  const HeightMap back = readScanFile(folder.file("out.tiff"), withPitch());
  EXPECT_EQ(back.height(4, 6), heights.at<double>(4, 6));
}

TEST(ScanFile, HeightTiffThatCannotBeWrittenIsNamed) {
  const ScratchFolder folder;
  EXPECT_THROW(writeHeightTiff(folder.file("none/out.tiff"), example(CV_32FC1)), FileError);
}

/// A directory of these entries; texts that they point to follow it.
std::string tiffDirectory(const std::vector<std::pair<std::uint16_t, std::uint32_t>>& entries) {
  std::string bytes = std::string("MM\0*", 4) + bigBytes(std::uint32_t{8}) +
                      bigBytes(static_cast<std::uint16_t>(entries.size()));
  for (const auto& [tag, value] : entries) {
    bytes +=
        bigBytes(tag) + bigBytes(std::uint16_t{4}) + bigBytes(std::uint32_t{1}) + bigBytes(value);
  }
  return bytes + bigBytes(std::uint32_t{0});
}

TEST(TiffTags, PagesOfInstrumentsAreToldByTheirTags) {
  EXPECT_TRUE(hasInstrumentTags(tiffDirectory({{256, 4}, {50432, 0x0E031301}})));
  EXPECT_FALSE(hasInstrumentTags(tiffDirectory({{256, 4}, {50432, 1}})));
  EXPECT_TRUE(hasInstrumentTags(tiffDirectory({{256, 4}, {32768, 2}, {32769, 90}})));
  EXPECT_FALSE(hasInstrumentTags(tiffDirectory({{256, 4}, {32768, 2}})));
  const std::string directory = tiffDirectory({{270, 26}});
  ASSERT_EQ(directory.size(), 26u);
  EXPECT_TRUE(
      hasInstrumentTags(directory + "<?xml version=\"1.0\"?><TiffTagDescData Version=\"1.0\">"));
  EXPECT_FALSE(hasInstrumentTags(directory + "<?xml version=\"1.0\"?><OME>"));
}

TEST(TiffTags, PlainTiffHasNoneOfThem) {
  const ScratchFolder folder;
  ASSERT_TRUE(cv::imwrite(folder.file("plain.tiff"), example(CV_32FC1)));
  EXPECT_FALSE(hasInstrumentTags(ScratchFolder::read(folder.file("plain.tiff"))));
  EXPECT_FALSE(hasInstrumentTags(""));
  EXPECT_FALSE(hasInstrumentTags(std::string("II*\0\xff\xff\xff\x7f", 8)));
}

// ---- The child process: each way that it can end is one clear line.

std::string importRefusal(const std::string& program, double timeout = 120.0) {
  const ScratchFolder folder;
  const std::string path = folder.write("scan.di", "not really");
  ScanFileOptions file_options;
  ImportOptions& options = file_options.import;
  options.gwyddion_reader = program[0] != '#' ? program : folder.write("program", program);
  if (program[0] == '#') {
    std::filesystem::permissions(options.gwyddion_reader, std::filesystem::perms::owner_all);
  }
  options.timeout = timeout;
  try {
    openScanFile(path, {}, file_options);
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()).find(path + ": "), 0u) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

TEST(GwyddionImport, MissingReadersNameTheDebianPackage) {
  EXPECT_TRUE(
      mentions(importRefusal("no_such_program"), "not installed (Debian package: gwyddion)"));
  EXPECT_TRUE(
      mentions(importRefusal("#!/bin/sh\nexit 127\n"), "not installed (Debian package: gwyddion)"));
}

TEST(GwyddionImport, CrashIsNamed) {
  EXPECT_TRUE(mentions(importRefusal("#!/bin/sh\nkill -SEGV $$\n"),
                       "crashed on this file (Segmentation fault)"));
}

TEST(GwyddionImport, FailureQuotesTheLastLineOfTheProgram) {
  EXPECT_TRUE(mentions(
      importRefusal(
          "#!/bin/sh\necho >&2 \"a library's remark\"\necho \"File is cut off.\"\nexit 1\n"),
      "gwyddion cannot read it: File is cut off."));
  EXPECT_TRUE(mentions(importRefusal("#!/bin/sh\nexit 3\n"), "exit status 3"));
  EXPECT_TRUE(mentions(importRefusal("#!/bin/sh\nexit 0\n"), "cannot read it"));
}

TEST(GwyddionImport, WhatGwyddionSaysOfADamagedFileIsTheError) {
  if (!MEMS_STICTION_HAS_GWYDDION) GTEST_SKIP() << "built without Gwyddion's libraries";
  EXPECT_TRUE(
      mentions(importRefusal(""), "gwyddion cannot read it: No module can load this file type."));
}

TEST(GwyddionImport, AMatrixFileWithoutItsParametersNamesThem) {
  const ScratchFolder folder;
  const std::string path =
      folder.write("default_scan--1_1.Z_mtrx", "ONTMATRX0101 and what follows");
  try {
    openScanFile(path);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_TRUE(
        mentions(error.what(), folder.file("default_scan_0001.mtrx") + ", which is not there"))
        << error.what();
  }
  const auto said = [&folder](const std::string& name, const std::string& bytes) -> std::string {
    try {
      openScanFile(folder.write(name, bytes));
      return "";
    } catch (const FileError& error) {
      return error.what();
    }
  };
  EXPECT_TRUE(mentions(said("renamed.Z_mtrx", "ONTMATRX0101TLKB"), "under another name"));
  EXPECT_TRUE(mentions(said("default_scan_0001.mtrx", "ONTMATRX0101ATEM"),
                       "the parameters of MATRIX scans"));
}

TEST(ScanFile, WithoutOneMeasuredPixelIsRefused) {
  const ScratchFolder folder;
  ScanOptions options;
  options.pitch_x = options.pitch_y = 1e-9;
  for (const char* text : {"nan nan\nnan nan\n", "1e30 nan\ninf 1e38\n"}) {
    try {
      readScanFile(folder.write("scan.txt", text), options);
      ADD_FAILURE() << text;
    } catch (const FileError& error) {
      EXPECT_TRUE(mentions(error.what(), "has no measured pixel")) << error.what();
    }
  }
  EXPECT_NO_THROW(readScanFile(folder.write("one.txt", "1e-9 nan\nnan nan\n"), options));
}

TEST(GwyddionImport, AnHdf5FileThatItDoesNotKnowIsRefusedWithWhatToDo) {
  const ScratchFolder folder;
  ScanFileOptions options;
  options.import.gwyddion_reader = "false";
  try {
    openScanFile(folder.write("scan.h5", "\x89HDF\r\n\x1a\n"), {}, options);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_TRUE(mentions(error.what(), "write its array of heights as .npy and state its pitch"))
        << error.what();
  }
}

TEST(GwyddionImport, HangingProgramAndItsChildrenAreStopped) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(mentions(importRefusal("#!/bin/sh\nsleep 300 &\nsleep 300\n", 0.2),
                       "did not finish within 0.2 s"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(100));
}

TEST(GwyddionImport, GarbageFromTheProgramIsRefused) {
  EXPECT_TRUE(
      mentions(importRefusal("#!/bin/sh\necho garbage > \"$2\"\n"), "cannot be read: not a"));
}

TEST(ScanFile, SidecarsOfGivenScansAreNoScans) {
  using Paths = std::vector<std::string>;
  EXPECT_EQ(withoutSidecars({"a.txt", "a.txt.yaml", "b.tiff", "b.yaml"}),
            (Paths{"a.txt", "b.tiff"}));
  // a file of settings that belongs to none of them stays, so that it is refused by its name
  EXPECT_EQ(withoutSidecars({"part.yaml", "a.txt", "x/a.txt.yaml"}),
            (Paths{"part.yaml", "a.txt", "x/a.txt.yaml"}));
}

TEST(GwyddionImport, TheHomeFolderIsPrivateAndGoesAway) {
  const ScratchFolder folder;
  const std::string told = folder.file("home");
  importRefusal("#!/bin/sh\necho \"$HOME ${DISPLAY-none}\" > " + told + "\nexit 1\n");
  const std::string line = ScratchFolder::read(told);
  const std::string home = line.substr(0, line.find(' '));
  EXPECT_EQ(line, home + " none\n");
  EXPECT_FALSE(home.empty());
  EXPECT_FALSE(std::filesystem::exists(home)) << home;
}

TEST(ChildProcess, ArgumentsReachTheProgramAsTheyAre) {
  const ScratchFolder folder;
  const ChildResult result = runChild({"printf", "%s|", "a b", "$HOME", "*", "'"},
                                      environmentWithout({}, {}), folder.file("log"), 10.0);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(ScratchFolder::read(folder.file("log")), "a b|$HOME|*|'|");
}

}  // namespace
}  // namespace mems_stiction
