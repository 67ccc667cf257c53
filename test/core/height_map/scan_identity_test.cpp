#include "mems_stiction/height_map/scan_identity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace mems_stiction {
namespace {

using Lines = std::vector<std::string>;

TEST(ScanIdentity, HalfASiteIsNamed) {
  ScanIdentity identity;
  EXPECT_EQ(identityComplaints(identity, ""), Lines());
  identity.site_x = 0.01;
  EXPECT_EQ(identityComplaints(identity, "scan/"),
            Lines{"scan/site_x: 0.01 is stated without site_y: state both, or none"});
  identity.site_y = 0.0;
  EXPECT_EQ(identityComplaints(identity, ""), Lines());
  identity.site_x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(identityComplaints(identity, ""),
            Lines{"site_y: 0 is stated without site_x: state both, or none"});
}

TEST(ScanIdentity, InfinitePlacesAndTextsThatNobodyReadsAreNamed) {
  ScanIdentity identity;
  identity.site_x = std::numeric_limits<double>::infinity();
  identity.site_y = 0.0;
  identity.wafer_id = std::string(kLongestName, 'a');
  identity.operator_name = std::string(kLongestName + 1, 'a');
  EXPECT_EQ(identityComplaints(identity, ""),
            (Lines{"site_x: inf is not allowed, must be a finite number, or nan for none",
                   "operator_name: a name of 1001 bytes is not allowed, must have at most 1000"}));
}

TEST(ScanIdentity, OfSeveralScansIsWhatAllStateAlike) {
  ScanIdentity one;
  one.scan_name = one.part_id = one.checksum = one.wafer_id = one.instrument = "same";
  one.site_x = one.site_y = 1.0;
  ScanIdentity other = one;
  other.wafer_id = "other";
  const ScanIdentity common = commonIdentity(one, other);
  EXPECT_EQ(common.part_id, "same");
  EXPECT_EQ(common.instrument, "same");
  EXPECT_EQ(common.wafer_id, "");
  EXPECT_EQ(common.scan_name + common.checksum, "") << "of one scan";
  EXPECT_TRUE(std::isnan(common.site_x));
}

}  // namespace
}  // namespace mems_stiction
