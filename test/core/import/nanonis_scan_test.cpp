/// Scans of Nanonis through Gwyddion, as far as they were measured and under whatever name.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/binary_writer.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

constexpr int kSxmSide = 8;  // [pixels]

/// One channel there and back over a micrometre, heights of whole nanometres; a direction may be
/// empty.
std::string sxmScan(bool has_forward, bool has_backward, const std::string& more = "") {
  std::string bytes =
      ":NANONIS_VERSION:\n2\n:SCANIT_TYPE:\n FLOAT MSBFIRST\n:REC_DATE:\n "
      "01.01.2024\n:REC_TIME:\n12:00:00\n"
      ":ACQ_TIME:\n 10.0\n:SCAN_PIXELS:\n 8 8\n:SCAN_TIME:\n 1.0E+0 1.0E+0\n:SCAN_RANGE:\n 1.0E-6 "
      "1.0E-6\n"
      ":SCAN_OFFSET:\n 0.0E+0 0.0E+0\n:SCAN_ANGLE:\n 0.0E+0\n:SCAN_DIR:\nup\n" +
      more +
      ":DATA_INFO:\n\tChannel\tName\tUnit\tDirection\tCalibration\tOffset\n"
      "\t14\tZ\tm\tboth\t9.000E-9\t0.000E+0\n\n:SCANIT_END:\n\n\n\x1A\x04";
  for (const bool is_measured : {has_forward, has_backward}) {
    for (int i = 0; i < kSxmSide * kSxmSide; ++i) {
      bytes += bigBytes(is_measured ? 1e-9F * static_cast<float>(i * i % 7)
                                    : std::numeric_limits<float>::quiet_NaN());
    }
  }
  return bytes;
}

class NanonisScan : public testing::Test {
 protected:
  void SetUp() override {
    if (!MEMS_STICTION_HAS_GWYDDION) GTEST_SKIP() << "built without Gwyddion's libraries";
  }

  std::string refusalOf(const std::string& bytes) {
    try {
      openScanFile(folder_.write("refused.sxm", bytes));
      return "";
    } catch (const FileError& error) {
      return error.what();
    }
  }

  ScratchFolder folder_;
};

TEST_F(NanonisScan, IsReadUnderTheNameOfAText) {
  for (const char* name : {"scan.sxm", "scan.txt", "scan.asc"}) {
    const ScanFile scan = openScanFile(folder_.write(name, sxmScan(true, true)));
    EXPECT_EQ(scan.channel, "0: Z (Forward)") << name;
    EXPECT_NEAR(scan.surface.pitchX(), 1e-6 / kSxmSide, 1e-15);
  }
}

TEST_F(NanonisScan, ADirectionThatWasNotMeasuredIsPassedOver) {
  const ScanFile scan = openScanFile(folder_.write("scan.sxm", sxmScan(false, true)));
  EXPECT_EQ(scan.channel, "1: Z (Backward)");
  ASSERT_FALSE(scan.notes.empty());
  EXPECT_NE(scan.notes.back().find("0: Z (Forward) has no measured pixel"), std::string::npos)
      << scan.notes.back();
}

TEST_F(NanonisScan, OneThatNeverBeganIsRefused) {
  EXPECT_NE(refusalOf(sxmScan(false, false)).find("has no measured pixel"), std::string::npos);
}

TEST_F(NanonisScan, ASecondRangeIsRefused) {
  const std::string said = refusalOf(sxmScan(true, true, ":SCAN_RANGE:\n 2.0E-6 1.0E-6\n"));
  EXPECT_NE(said.find("'scan_range' twice"), std::string::npos) << said;
  EXPECT_EQ(refusalOf(sxmScan(true, true, ":SCAN_RANGE:\n 1.0E-6   1.0E-6\n")), "");
}

}  // namespace
}  // namespace mems_stiction
