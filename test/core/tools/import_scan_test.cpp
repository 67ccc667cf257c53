/// Scans from the instrument's file to the prediction, as users call it: the real executables,
/// their output, their exit status. Vendor files are those of the folder in the environment
/// variable MEMS_STICTION_SCANS.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "import/scan_writer.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/program_run.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

class ImportScan : public ::testing::Test {
 protected:
  Outcome run(const std::string& command) const { return runProgram(folder_, command); }
  Outcome importScan(const std::string& arguments) const {
    return run(std::string(MEMS_STICTION_IMPORT_SCAN) + " " + arguments);
  }
  Outcome predictScan(const std::string& arguments) const {
    return run(std::string(MEMS_STICTION_PREDICT_SCAN) + " " + arguments);
  }

  static void expectSame(const HeightMap& found, const HeightMap& expected) {
    EXPECT_EQ(found.pitchX(), expected.pitchX());
    EXPECT_EQ(found.pitchY(), expected.pitchY());
    ASSERT_EQ(found.heights().size(), expected.heights().size());
    int different = 0;
    for (int row = 0; row < expected.rows(); ++row) {
      for (int col = 0; col < expected.cols(); ++col) {
        const double a = found.height(row, col);
        const double b = expected.height(row, col);
        if (a != b && !(std::isnan(a) && std::isnan(b))) ++different;
      }
    }
    EXPECT_EQ(different, 0);
  }

  ScratchFolder folder_;
};

TEST_F(ImportScan, WritesTiffAndPitchThatReadBackToTheLastBit) {
  const std::string text =
      folder_.write("grid.csv", "1e-9,2.123456789012e-9,nan\n3e-9,4e-9,5e-9\n");
  const Outcome outcome =
      importScan("--pitch 1.3e-9,2.7e-9 -o " + folder_.file("new/folder") + " " + text);
  ASSERT_EQ(outcome.status, 0);
  ASSERT_EQ(outcome.errors.size(), 1u);
  EXPECT_NE(outcome.errors[0].find("warning: a frame of 3 x 2 pixels says nothing about roughness"),
            std::string::npos)
      << outcome.errors[0];
  EXPECT_NE(outcome.output.find("3 x 2 pixels of 1.3e-09 x 2.7e-09 m, 16.7 % missing"),
            std::string::npos)
      << outcome.output;
  ScanOptions pitch;
  pitch.pitch_x = 1.3e-9;
  pitch.pitch_y = 2.7e-9;
  expectSame(readScanFile(folder_.file("new/folder/grid.tiff")), readScanFile(text, pitch));
}

TEST_F(ImportScan, Float32StaysFloat32AndDoubleKeepsItsDigits) {
  const HeightMap sphere = analytic::paraboloid(21, 31, 20e-9, 30e-9, 2e-6);
  writeScan(folder_.file("double.tiff"), sphere, "a sphere");
  writeScan(folder_.file("single.tiff"), analytic::asSingle(sphere), "a sphere");
  EXPECT_EQ(readScanFile(folder_.file("double.tiff")).heights().depth(), CV_64F);
  EXPECT_EQ(readScanFile(folder_.file("single.tiff")).heights().depth(), CV_32F);
  expectSame(readScanFile(folder_.file("double.tiff")), sphere);
}

TEST_F(ImportScan, WhatIsStatedOfTheScanGoesWithIt) {
  const std::string text = folder_.write("grid.csv", "1e-9,2e-9,nan\n3e-9,4e-9,5e-9\n");
  folder_.write("grid.csv.yaml",
                "pitch_x: 1e-9\npitch_y: 1e-9\nwafer_id: 'W \"3\": #4'\nserial_id: 0012\nsite_x: "
                "-5e-3\nsite_y: 0\n"
                "operator_name: ann\nacquisition_time: 2026-03-01\n");
  const Outcome outcome = importScan("-o " + folder_.file("o") + " " + text);
  ASSERT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.output.find("missing, 2026-03-01, ann\n"), std::string::npos) << outcome.output;
  const ScanIdentity of_text = openScanFile(text).identity;
  const ScanIdentity of_tiff = openScanFile(folder_.file("o/grid.tiff")).identity;
  EXPECT_EQ(of_tiff.wafer_id, "W \"3\": #4");
  EXPECT_EQ(of_tiff.serial_id, "0012");
  EXPECT_EQ(of_tiff.site_x, -5e-3);
  EXPECT_EQ(of_tiff.site_y, 0.0);
  EXPECT_EQ(of_tiff.operator_name, "ann");
  EXPECT_EQ(of_tiff.acquisition_time, "2026-03-01");
  EXPECT_EQ(of_tiff.scan_name, "grid");
  EXPECT_NE(of_tiff.checksum, of_text.checksum) << "of other bytes";
  const std::string sidecar = ScratchFolder::read(folder_.file("o/grid.tiff.yaml"));
  EXPECT_NE(sidecar.find("# grid.csv, " + of_text.checksum + "\n"), std::string::npos) << sidecar;
  EXPECT_EQ(importScan("-o " + folder_.file("o") + " " + text).status, 0)
      << "as it was written, it may be written again";
}

TEST_F(ImportScan, NeverWritesOverAScanOrTwiceToOneFile) {
  writeScan(folder_.file("a.tiff"), analytic::paraboloid(21, 31, 20e-9, 20e-9, 2e-6), "a");
  const std::string before = ScratchFolder::read(folder_.file("a.tiff"));
  folder_.write("a.csv", "1e-9,2e-9\n3e-9,4e-9\n");
  const Outcome onto_itself = importScan("-o " + folder_.file("") + " " + folder_.file("a.tiff"));
  EXPECT_EQ(onto_itself.status, 2);
  ASSERT_EQ(onto_itself.errors.size(), 1u);
  EXPECT_NE(onto_itself.errors[0].find("choose another --output"), std::string::npos)
      << onto_itself.errors[0];
  const Outcome twice = importScan("-p 1e-6 -o " + folder_.file("out_folder") + " " +
                                   folder_.file("a.tiff") + " " + folder_.file("a.csv"));
  EXPECT_EQ(twice.status, 2);
  ASSERT_EQ(twice.errors.size(), 1u);
  EXPECT_NE(twice.errors[0].find("a.csv"), std::string::npos) << twice.errors[0];
  EXPECT_EQ(ScratchFolder::read(folder_.file("a.tiff")), before);
}

TEST_F(ImportScan, BadInputIsOneLineAndTheOthersAreImported) {
  const std::string good = folder_.write("good.csv", "1e-9,2e-9\n3e-9,4e-9\n");
  const std::string bad = folder_.write("bad.csv", "1e-9,2e-9\n3e-9\n");
  const Outcome outcome = importScan("-p 1e-6 -o " + folder_.file("o") + " " + bad + " " + good +
                                     " " + folder_.file("none.di"));
  EXPECT_EQ(outcome.status, 2);
  ASSERT_EQ(outcome.errors.size(), 3u);
  EXPECT_NE(outcome.errors[0].find(bad), std::string::npos);
  EXPECT_NE(outcome.errors[1].find(good + ": warning: a frame of 2 x 2 pixels"), std::string::npos)
      << outcome.errors[1];
  EXPECT_NE(outcome.errors[2].find("none.di: there is no such file"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_.file("o/good.tiff")));
  EXPECT_FALSE(fs::exists(folder_.file("o/bad.tiff")));
  EXPECT_EQ(importScan("--pitch 0 " + good).status, 2);
  EXPECT_EQ(importScan("").status, 2);
}

TEST_F(ImportScan, ListShowsSizePitchAndUnit) {
  writeScan(folder_.file("a.tiff"), analytic::paraboloid(21, 31, 20e-9, 30e-9, 2e-6), "a");
  const Outcome outcome = importScan("--list " + folder_.file("a.tiff"));
  ASSERT_EQ(outcome.status, 0);
  for (const char* part :
       {"* (single channel)", "31 x 21 pixels", "pitch 2e-08 x 3e-08 m", "heights in m"}) {
    EXPECT_NE(outcome.output.find(part), std::string::npos) << part << " in " << outcome.output;
  }
}

class VendorImport : public ImportScan {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("MEMS_STICTION_SCANS");
    if (folder == nullptr || *folder == '\0') {
      GTEST_SKIP() << "MEMS_STICTION_SCANS is not set to a folder of vendor scans";
    }
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.is_regular_file() && entry.path().extension() != ".md")
        scans_.push_back(entry.path());
    }
    for (const auto& entry : fs::directory_iterator(std::string(folder) + "/bad"))
      bad_.push_back(entry.path());
  }

  static std::string joined(const std::vector<fs::path>& paths) {
    std::string text;
    for (const fs::path& path : paths) text += " " + path.string();
    return text;
  }

  std::vector<fs::path> scans_;
  std::vector<fs::path> bad_;
};

TEST_F(VendorImport, EveryScanIsImportedToTheLastBitAndPredictedAlike) {
  ASSERT_FALSE(scans_.empty());
  const Outcome imported = importScan("-o " + folder_.file("tiff") + joined(scans_) + joined(bad_));
  EXPECT_EQ(imported.status, 2);
  EXPECT_EQ(imported.errors.size(), bad_.size());

  const std::string cleaning = folder_.write(
      "c.yaml", "preprocessing: {offset: {enabled: true}, fill: {enabled: true}, level: plane}\n");
  std::vector<fs::path> tiffs;
  for (const fs::path& scan : scans_) {
    const fs::path tiff = folder_.file("tiff/" + scan.stem().string() + ".tiff");
    expectSame(readScanFile(tiff.string()), readScanFile(scan.string()));
    tiffs.push_back(tiff);
  }
  const Outcome from_vendor =
      predictScan("--json -l 1e-6 -c " + cleaning + joined(scans_) + joined(bad_));
  EXPECT_EQ(from_vendor.status, 2);
  std::vector<std::string> errors;
  std::copy_if(
      from_vendor.errors.begin(), from_vendor.errors.end(), std::back_inserter(errors),
      [](const std::string& line) { return line.find(": warning: ") == std::string::npos; });
  ASSERT_EQ(errors.size(), bad_.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_NE(errors[i].find(bad_[i].string()), std::string::npos) << errors[i];
  }
  const Outcome from_tiff = predictScan("--json -l 1e-6 -c " + cleaning + joined(tiffs));
  EXPECT_EQ(from_tiff.status, 0);
  std::istringstream vendor_lines(from_vendor.output);
  std::istringstream tiff_lines(from_tiff.output);
  std::size_t count = 0;
  for (std::string vendor_line, tiff_line;
       std::getline(vendor_lines, vendor_line) && std::getline(tiff_lines, tiff_line); ++count) {
    const nlohmann::json record = nlohmann::json::parse(vendor_line);
    SCOPED_TRACE(record["file"].get<std::string>());
    EXPECT_EQ(nlohmann::json::parse(tiff_line)["pull_off_force"], record["pull_off_force"]);
    EXPECT_EQ(record["status"], "EQUILIBRIUM");
    EXPECT_GT(record["pull_off_force"].get<double>(), 0.0);
    EXPECT_LT(record["pull_off_force"].get<double>(), 1e-3);
    EXPECT_GE(record["asperity_count"].get<int>(), 1);
    EXPECT_LT(record["contact_fraction"].get<double>(), 0.5);
    EXPECT_EQ(record["invalid_fraction"].get<double>(), 0.0);
    EXPECT_EQ(record["preprocessing"].size(), 3u);
  }
  EXPECT_EQ(count, scans_.size());
}

TEST_F(VendorImport, ListMarksTheChannelThatIsTaken) {
  const std::string folder = std::getenv("MEMS_STICTION_SCANS");
  const Outcome outcome = importScan("--list " + folder + "/di-3.di");
  ASSERT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.output.find("* 0: ZSensor"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("  3: Height"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("256 x 256 pixels"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("heights in V"), std::string::npos) << outcome.output;
  ASSERT_EQ(
      importScan("--channel Height -o " + folder_.file("h") + " " + folder + "/di-3.di").status, 0);
  EXPECT_NEAR(heightStatistics(readScanFile(folder_.file("h/di-3.tiff"))).rms_height,
              264.00285276203158e-9, 1e-15);
}

TEST_F(VendorImport, TooManyMissingPixelsRefuseTheScanWithTheReason) {
  const std::string cleaning =
      folder_.write("c.yaml", "preprocessing: {fill: {enabled: true, max_fraction: 1e-5}}\n");
  const std::string scan = std::string(std::getenv("MEMS_STICTION_SCANS")) + "/opd-1.opd";
  const Outcome outcome = predictScan("-c " + cleaning + " " + scan);
  EXPECT_EQ(outcome.status, 2);
  ASSERT_EQ(outcome.errors.size(), 1u);
  EXPECT_NE(outcome.errors[0].find(scan), std::string::npos) << outcome.errors[0];
  EXPECT_NE(outcome.errors[0].find("max_fraction"), std::string::npos) << outcome.errors[0];
}

}  // namespace
}  // namespace mems_stiction
