/// Files as instruments wrote them. The folder is named by the environment variable
/// MEMS_STICTION_SCANS; sizes, pitches and rms heights are those that Gwyddion's library and numpy
/// give for the same files after plane levelling.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "height_map/scan_sanity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "mems_stiction/roughness/areal_parameters.hpp"
#include "preprocess/level.hpp"
#include "support/program_run.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

struct KnownScan {
  const char* file;
  const char* channel;
  int cols, rows;
  double width, height;  // [m]
  int valid_count;
  double sa, sq;    // [m]
  double ssk, sku;  // [-]
  double sdq;       // by central differences [-]
};

const std::vector<KnownScan> kScans = {
    {"di-5.di", "0: ZSensor", 512, 512, 1e-6, 1e-6, 262144, 1.250613e-9, 1.535927e-9, 0.55414,
     2.94158, 0.057388},
    {"di-6.di", "0: Height", 512, 512, 1e-5, 1e-5, 262144, 1.133628e-8, 1.431934e-8, 0.54773,
     3.38856, 0.208644},
    {"di-3.di", "0: ZSensor", 256, 256, 1e-5, 1e-5, 65536, 2.622809e-8, 3.522292e-8, -0.39979,
     5.66170, 0.166662},
    {"example_ps.tiff", "0: Z Height", 512, 512, 1e-6, 1e-6, 262144, 3.076658e-9, 3.933334e-9,
     0.38688, 3.84173, 0.367455},
    {"top-1.top", "0: Topography", 256, 256, 6e-7, 6e-7, 65536, 1.070102e-9, 1.613985e-9, 2.74588,
     12.36915, 0.146434},
    {"opd-1.opd", "0: Topography", 640, 480, 1.25909140e-4, 9.44318553e-5, 307084, 5.201489e-9,
     6.711198e-9, -0.36673, 4.53839, 0.014604},
    {"x3p-2.x3p", "0: Topography", 650, 650, 8.29767314e-5, 2.04478374e-4, 422500, 6.189306e-8,
     7.719303e-8, -0.37867, 2.98460, 0.059571},
    {"al3d-1.al3d", "0: Depth", 200, 296, 8.76054e-5, 1.29655992e-4, 59200, 2.301961e-7,
     2.898221e-7, -0.00498, 3.07128, 0.087390},
};

class VendorScans : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("MEMS_STICTION_SCANS");
    if (folder == nullptr || *folder == '\0') {
      GTEST_SKIP() << "MEMS_STICTION_SCANS is not set to a folder of vendor scans";
    }
    folder_ = folder;
  }

  std::string folder_;
};

TEST_F(VendorScans, SizePitchChannelAndRoughnessAreThoseOfIndependentReaders) {
  for (const KnownScan& known : kScans) {
    SCOPED_TRACE(known.file);
    const ScanFile scan = openScanFile(folder_ + "/" + known.file);
    EXPECT_EQ(scan.channel, known.channel);
    EXPECT_EQ(scan.surface.cols(), known.cols);
    EXPECT_EQ(scan.surface.rows(), known.rows);
    // Nine digits are listed.
    EXPECT_NEAR(scan.surface.cols() * scan.surface.pitchX() / known.width, 1.0, 1e-8);
    EXPECT_NEAR(scan.surface.rows() * scan.surface.pitchY() / known.height, 1.0, 1e-8);
    EXPECT_EQ(heightStatistics(scan.surface).valid_count, known.valid_count);

    const ArealParameters roughness = arealParameters(levelled(scan.surface));
    // Seven digits are listed, five decimals of skewness and kurtosis, six of the slope.
    EXPECT_NEAR(roughness.sa / known.sa, 1.0, 1e-6);
    EXPECT_NEAR(roughness.sq / known.sq, 1.0, 1e-6);
    EXPECT_NEAR(roughness.ssk, known.ssk, 1e-5);
    EXPECT_NEAR(roughness.sku, known.sku, 1e-5);
    EXPECT_NEAR(roughness.sdq, known.sdq, 1e-6);
  }
}

TEST_F(VendorScans, GoodScansGiveNoWarning) {
  for (const KnownScan& known : kScans) {
    for (const std::string& line : scanWarnings(readScanFile(folder_ + "/" + known.file))) {
      ADD_FAILURE() << known.file << ": " << line;
    }
  }
}

TEST_F(VendorScans, BadFilesAreRefusedInOneLineThatNamesThem) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ + "/bad")) {
    const std::string path = entry.path().string();
    ++count;
    try {
      readScanFile(path);
      ADD_FAILURE() << path << " was accepted";
    } catch (const FileError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(path), std::string::npos) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
  }
  EXPECT_GT(count, 0);
}

TEST_F(VendorScans, BytesTooManyTooFewOrTakenForTextAreRefused) {
  const ScratchFolder scratch;
  for (const std::string file :
       {"di-3.di", "di-5.di", "top-1.top", "opd-1.opd", "al3d-1.al3d", "misread/sur-2.sur"}) {
    const std::string bytes = ScratchFolder::read(folder_ + "/" + file);
    const std::size_t middle = bytes.size() / 2;
    std::string as_text;
    for (const char c : bytes) as_text += c == '\n' ? std::string("\r\n") : std::string(1, c);
    const std::string name = std::filesystem::path(file).filename().string();
    for (const std::string& damaged : {bytes + "x", bytes.substr(0, bytes.size() - 1), as_text,
                                       bytes.substr(0, middle) + "x" + bytes.substr(middle),
                                       bytes.substr(0, middle) + bytes.substr(middle + 1)}) {
      EXPECT_THROW(readScanFile(scratch.write(name, damaged)), FileError)
          << file << " of " << damaged.size() << " bytes";
    }
    EXPECT_NO_THROW(readScanFile(scratch.write(name, bytes))) << file;
  }
}

/// What the headers say, read by hand with `strings` and `unzip -p`.
TEST_F(VendorScans, SayWhenAndWithWhatTheyWereMeasured) {
  struct Known {
    const char* file;
    const char* time;
    const char* instrument;
  };
  for (const Known& known : std::vector<Known>{
           {"di-3.di", "2014-12-15T13:33:51", "Dim 4000, serial number 1BEC3"},
           {"di-5.di", "2021-06-30T11:38:13", "Dim 4000, serial number 1A03F9"},
           {"di-6.di", "2016-02-03T17:40:34", "Dimension V, serial number Hybrid 306"},
           {"top-1.top", "03/11/2011, 20:23:46.484",
            "AFM, serial number 24"},  // the third of November, or the 11th of March
           {"opd-1.opd", "2015-07-07T16:19:48", ""},
           {"x3p-2.x3p", "",
            "DIGITAL SURF Mountains Map Technology Software"},  // its date is that of no clock
           {"misread/sur-2.sur", "", ""}}) {
    const ScanIdentity identity = openScanFile(folder_ + "/" + known.file).identity;
    EXPECT_EQ(identity.acquisition_time, known.time) << known.file;
    EXPECT_EQ(identity.instrument, known.instrument) << known.file;
    EXPECT_EQ(identity.operator_name, "") << known.file;
    EXPECT_EQ(identity.scan_name, std::filesystem::path(known.file).stem()) << known.file;
    const Outcome summed = runProgram(ScratchFolder(), "sha256sum " + folder_ + "/" + known.file);
    EXPECT_EQ(identity.checksum, "sha256:" + summed.output.substr(0, 64)) << known.file;
  }
}

TEST_F(VendorScans, AChannelMayBeNamed) {
  ScanFileOptions options;
  options.import.channel = "Height";
  // 264.00 nm open loop against 226.43 nm of the sensor, before levelling: figures of another
  // reader's tests.
  const HeightMap open_loop = readScanFile(folder_ + "/di-3.di", {}, options);
  EXPECT_NEAR(heightStatistics(open_loop).rms_height, 264.00285276203158e-9, 1e-15);
  EXPECT_NEAR(heightStatistics(readScanFile(folder_ + "/di-3.di")).rms_height,
              226.42539668457405e-9, 1e-15);
}

TEST_F(VendorScans, PitchByOptionGoesBeforeTheFiles) {
  ScanFileOptions options;
  options.pitch_x = 1e-9;
  const HeightMap surface = readScanFile(folder_ + "/di-5.di", {}, options);
  EXPECT_EQ(surface.pitchX(), 1e-9);
  EXPECT_NEAR(surface.pitchY() / (1e-6 / 512), 1.0, 1e-12);
}

}  // namespace
}  // namespace mems_stiction
