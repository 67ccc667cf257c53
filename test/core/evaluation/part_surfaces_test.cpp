#include "evaluation/part_surfaces.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

const PartName kPart{"lot 3", "0012"};
const PartName kOther{"lot 3", "0013"};
const PartName kNone;
constexpr SurfaceLimits kPlenty{100, 1000000000};
constexpr int kSide = 8;
constexpr std::size_t kBytes = kSide * kSide * sizeof(double);

PreparedScan surfaceOf(double height, double pitch = 1e-8) {
  PreparedScan scan;
  scan.surfaces = HeightMap(cv::Mat(kSide, kSide, CV_64FC1, cv::Scalar(height)), pitch, pitch);
  scan.model_surfaces = scan.surfaces;
  return scan;
}

ScanStatement named(const std::string& name) {
  ScanStatement statement;
  statement.scan_name = name;
  return statement;
}

/// Heights of the scans in their order.
std::vector<double> heightsOf(const PartSurfaces& parts, const PartName& part) {
  std::vector<double> heights;
  const ScannedPart found = parts.of(part).value();  // lives as long as the loop
  for (const ScannedSurface& scan : found.scans)
    heights.push_back(scan.scan.surfaces.lower.height(0, 0));
  return heights;
}

TEST(PartSurfaces, HoldsWhatStatesTheSamePart) {
  PartSurfaces parts(kPlenty);
  EXPECT_FALSE(parts.of(kPart));
  parts.add(kPart, 1, named("a"), surfaceOf(1.0));
  parts.add(kOther, 2, named("b"), surfaceOf(2.0));
  parts.add(kPart, 3, named("a"), surfaceOf(3.0));
  parts.add(kPart, 4, named(""), surfaceOf(4.0));
  EXPECT_EQ(heightsOf(parts, kPart), (std::vector<double>{1.0, 3.0, 4.0}));
  EXPECT_EQ(heightsOf(parts, kOther), std::vector<double>{2.0});
  std::vector<std::string> names;
  for (const ScanStatement& statement : parts.of(kPart)->statements())
    names.push_back(statement.scan_name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "a 2", "scan 3"}));
  EXPECT_EQ(parts.scans(), 4U);
  EXPECT_EQ(parts.bytes(), 4 * kBytes);
}

/// Its flags depend on more than its surfaces.
TEST(PartSurfaces, AScanIsPredictedAgainAsItCame) {
  PartSurfaces parts(kPlenty);
  PreparedScan scan = surfaceOf(1.0);
  scan.refinement = 2;
  scan.tip_limit = 3e-9;
  scan.outside = cv::Mat(kSide, kSide, CV_8UC1, cv::Scalar(255));
  parts.add(kPart, 1, named("a"), scan);
  const ScannedPart found = parts.of(kPart).value();
  const PreparedScan& again = found.scans.front().scan;
  EXPECT_EQ(again.refinement, 2);
  EXPECT_EQ(again.tip_limit, 3e-9);
  EXPECT_EQ(again.outside.data, scan.outside.data);
  EXPECT_EQ(parts.bytes(), kBytes + kSide * kSide);
}

TEST(PartSurfaces, HoldsOneScanWithoutAPart) {
  PartSurfaces parts(kPlenty);
  parts.add(kNone, 1, named("a"), surfaceOf(1.0));
  parts.add(kNone, 2, named("b"), surfaceOf(2.0));
  EXPECT_EQ(heightsOf(parts, kNone), std::vector<double>{2.0});
  EXPECT_EQ(parts.of(kNone)->taken, 1U);
  EXPECT_EQ(parts.bytes(), kBytes);
}

TEST(PartSurfaces, AScanThatComesAgainCountsOnce) {
  PartSurfaces parts(kPlenty);
  const PreparedScan first = surfaceOf(1.0);
  parts.add(kPart, 1, named("a"), first);
  parts.add(kPart, 2, named("b"), surfaceOf(2.0));
  const std::vector<std::uint64_t> numbers = parts.of(kPart)->numbers();
  ScanStatement again = named("a");
  again.contacts = 7;
  parts.add(kPart, 1, again, first);  // under other settings
  EXPECT_EQ(parts.of(kPart)->numbers(), numbers);
  EXPECT_EQ(parts.of(kPart)->statements()[0].contacts, 7);
  parts.add(kPart, 1, named("a"), surfaceOf(5.0));  // replayed, or worn
  EXPECT_NE(parts.of(kPart)->numbers(), numbers);
  EXPECT_EQ(heightsOf(parts, kPart), (std::vector<double>{5.0, 2.0}));
  // Without a number its pixels tell.
  const PreparedScan unnumbered = surfaceOf(6.0);
  for (int i = 0; i < 2; ++i) parts.add(kPart, 0, named("c"), unnumbered);
  parts.add(kPart, 0, named("c"), surfaceOf(6.0));
  EXPECT_EQ(heightsOf(parts, kPart), (std::vector<double>{5.0, 2.0, 6.0, 6.0}));
}

TEST(PartSurfaces, OfTooManyTheOldestOfTheCommonestGridGoes) {
  PartSurfaces parts({3, kPlenty.bytes});
  parts.add(kPart, 1, named("wide"), surfaceOf(0.0, 1e-7));
  for (int scan = 1; scan <= 5; ++scan) {
    parts.add(kPart, static_cast<std::uint64_t>(scan) + 1, named("fine"), surfaceOf(scan));
  }
  EXPECT_EQ(heightsOf(parts, kPart), (std::vector<double>{0.0, 4.0, 5.0}));
  EXPECT_EQ(parts.of(kPart)->taken, 6U);
  EXPECT_EQ(parts.bytes(), 3 * kBytes);
}

TEST(PartSurfaces, MemoryIsThatOfThePartsThatHadAScanLast) {
  PartSurfaces parts({100, 3 * kBytes});
  parts.add(kPart, 1, named("a"), surfaceOf(1.0));
  parts.add(kOther, 2, named("b"), surfaceOf(2.0));
  EXPECT_TRUE(parts.add(kPart, 3, named("c"), surfaceOf(3.0)).empty());
  EXPECT_EQ(parts.add(kPart, 4, named("d"), surfaceOf(4.0)), std::vector<PartName>{kOther});
  EXPECT_FALSE(parts.of(kOther));
  EXPECT_TRUE(parts.add(kPart, 5, named("e"), surfaceOf(5.0)).empty());
  EXPECT_EQ(heightsOf(parts, kPart), (std::vector<double>{3.0, 4.0, 5.0}));
  EXPECT_EQ(parts.bytes(), 3 * kBytes);
  PartSurfaces tight({100, 1});
  tight.add(kPart, 1, named("a"), surfaceOf(1.0));
  EXPECT_EQ(heightsOf(tight, kPart), std::vector<double>{1.0});  // the newest stays
}

TEST(PartSurfaces, MemoryIsThatOfUpperAndRefinedSurfacesToo) {
  PartSurfaces parts(kPlenty);
  PreparedScan scan = surfaceOf(1.0);
  scan.surfaces.upper = scan.model_surfaces.upper = surfaceOf(7.0).surfaces.lower;
  parts.add(kPart, 1, named("a"), scan);
  EXPECT_EQ(parts.bytes(), 2 * kBytes);
  scan = surfaceOf(2.0);
  scan.model_surfaces = HeightMap(cv::Mat::zeros(2 * kSide, 2 * kSide, CV_64FC1), 5e-9, 5e-9);
  parts.add(kPart, 2, named("b"), scan);
  EXPECT_EQ(parts.bytes(), 7 * kBytes);
}

/// Pixels of which none knows its neighbour are not believed because a part holds them.
TEST(PartSurfaces, ADeviceKnowsWhatItsScansDoNotShow) {
  Configuration configuration;
  configuration.device.contact_area = 4e-12;
  configuration.device_force.realisations = 3;
  configuration.device_force.max_cells = 1e4;
  cv::Mat heights(64, 64, CV_64FC1);
  cv::RNG(8).fill(heights, cv::RNG::NORMAL, 0.0, 5e-9);
  ScanPreparer preparer(configuration);
  PartSurfaces parts(kPlenty);
  parts.add(kPart, 1, named("a"), preparer.prepare(HeightMap(heights, 1e-8, 1e-8)));
  const DeviceForce force = parts.of(kPart)->together(configuration).force();
  EXPECT_NE(force.missing_scan.find("missing is AFM"), std::string::npos) << force.missing_scan;
}

}  // namespace
}  // namespace mems_stiction
