#include "evaluation/part_surfaces.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

const PartName kPart{"lot 3", "0012"};
const PartName kOther{"lot 3", "0013"};
const PartName kNone;
constexpr KeptSurfaces kPlenty{100, 1000000000};
constexpr int kSide = 8;
constexpr std::size_t kBytes = kSide * kSide * sizeof(double);

HeightMap surfaceOf(double height, double pitch = 1e-8) {
  return {cv::Mat(kSide, kSide, CV_64FC1, cv::Scalar(height)), pitch, pitch};
}

ScanStatement named(const std::string& name) {
  ScanStatement statement;
  statement.scan_name = name;
  return statement;
}

/// Heights of the scans in their order.
std::vector<double> heightsOf(const PartSurfaces& parts, const PartName& part) {
  std::vector<double> heights;
  for (const NamedScan& scan : parts.of(part)->surfaces().scans) heights.push_back(scan.surface.height(0, 0));
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
  for (const ScanStatement& statement : parts.of(kPart)->statements()) names.push_back(statement.scan_name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "a 2", "scan 3"}));
  EXPECT_EQ(parts.of(kPart)->surfaces().scans[1].name, "a 2");
  EXPECT_EQ(parts.scans(), 4U);
  EXPECT_EQ(parts.bytes(), 4 * kBytes);
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
  const HeightMap first = surfaceOf(1.0);
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
  const HeightMap unnumbered = surfaceOf(6.0);
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

TEST(PartSurfaces, AnUpperSurfaceThatSeveralScansMetIsThereOnce) {
  PartSurfaces parts(kPlenty);
  parts.add(kPart, 1, named("a"), {surfaceOf(1.0), surfaceOf(7.0)});
  parts.add(kPart, 2, named("b"), {surfaceOf(2.0), surfaceOf(7.0)});
  parts.add(kPart, 3, named("c"), {surfaceOf(3.0), surfaceOf(8.0)});
  parts.add(kPart, 4, named("d"), {surfaceOf(3.0), surfaceOf(8.0, 1e-7)});
  parts.add(kPart, 5, named("e"), surfaceOf(4.0));
  const DeviceSurfaces surfaces = parts.of(kPart)->surfaces();
  EXPECT_EQ(surfaces.scans.size(), 5U);
  ASSERT_EQ(surfaces.counter_surface.size(), 3U);
  EXPECT_EQ(surfaces.counter_surface[1].name, "the counter-surface of c");
  EXPECT_EQ(parts.bytes(), 9 * kBytes);
}

}  // namespace
}  // namespace mems_stiction
