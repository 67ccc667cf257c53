#include "evaluation/part_scans.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

const PartKey kPart{"lot 3", "0012", "00ff"};

ScanStatement scanOf(const std::string& name, double margin) {
  ScanStatement scan;
  scan.scan_name = name;
  scan.sticks = Sticks::kNo;
  scan.margin = {margin, 0.8 * margin, margin / 0.8};
  scan.contacts = 50;
  return scan;
}

TEST(PartScans, poolsWhatStatesTheSamePart) {
  PartScans parts(10, 10);
  parts.add(kPart, 1, scanOf("a", 2.0));
  const auto verdict = parts.add(kPart, 2, scanOf("b", 8.0));
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->scan_count, 2);
  EXPECT_NEAR(verdict->margin.value, 4.0, 1e-12);
}

TEST(PartScans, keepsPartsApartThatTakeTurns) {
  PartScans parts(10, 10);
  PartKey serial = kPart, settings = kPart;
  serial.serial_id = "0013";
  settings.settings_hash = "1111";
  for (const PartKey& key : {kPart, serial, settings}) parts.add(key, 1, scanOf("a", 2.0));
  EXPECT_EQ(parts.add(kPart, 2, scanOf("b", 2.0))->scan_count, 2);
  EXPECT_EQ(parts.add(serial, 2, scanOf("b", 2.0))->scan_count, 2);
  EXPECT_EQ(parts.add(settings, 2, scanOf("b", 2.0))->scan_count, 2);
  ASSERT_EQ(parts.verdicts().size(), 3U);
  EXPECT_EQ(parts.verdicts()[0].first.settings_hash, "00ff");  // the first that came
  EXPECT_EQ(parts.verdicts()[1].first.serial_id, "0013");
}

TEST(PartScans, aScanWithoutAnIdIsOfNoPart) {
  PartScans parts(10, 10);
  EXPECT_FALSE(parts.add({"", "", "00ff"}, 1, scanOf("a", 2.0)));
  EXPECT_TRUE(parts.add({"", "0012", "00ff"}, 1, scanOf("a", 2.0)));
  EXPECT_EQ(parts.verdicts().size(), 1U);
}

TEST(PartScans, aScanThatComesAgainCountsOnce) {
  PartScans parts(10, 10);
  parts.add(kPart, 1, scanOf("a", 2.0));
  const auto again = parts.add(kPart, 1, scanOf("a", 3.0));
  EXPECT_EQ(again->scan_count, 1);
  EXPECT_EQ(again->margin.value, 3.0);
  EXPECT_EQ(again->margin.worst_scan, "a");
  parts.add(kPart, 0, scanOf("b", 2.0));
  EXPECT_EQ(parts.add(kPart, 0, scanOf("c", 2.0))->scan_count, 3);  // of no number
}

TEST(PartScans, anotherVerdictOnAScanTakesThePlaceOfTheOneBefore) {
  PartScans parts(10, 2);
  parts.add(kPart, 1, scanOf("a", 2.0));
  parts.add(kPart, 2, scanOf("b", 2.0));
  Verdict by_half_space;
  by_half_space.sticks = Sticks::kNo;
  by_half_space.judge = Judge::kHalfSpace;
  by_half_space.margin = 2.2;
  by_half_space.margin_lower = 1.8;
  by_half_space.margin_upper = 2.7;
  const auto verdict = parts.judgeAgain(kPart, 1, by_half_space);
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->scan_count, 2);
  EXPECT_NEAR(verdict->margin.value, std::sqrt(4.4), 1e-12);
  EXPECT_EQ(verdict->margin.worst_scan, "b");
  EXPECT_EQ(verdict->verdict_by, "prediction and half_space");
  EXPECT_EQ(verdict->sticks, Sticks::kNo);  // its contacts are those of before: enough

  EXPECT_FALSE(parts.judgeAgain(kPart, 3, by_half_space));              // never came
  EXPECT_FALSE(parts.judgeAgain({"lot 4", "", ""}, 1, by_half_space));  // no scan of it
  parts.add(kPart, 3, scanOf("c", 2.0));
  EXPECT_FALSE(parts.judgeAgain(kPart, 1, by_half_space));  // forgotten since
  EXPECT_EQ(parts.judgeAgain(kPart, 3, by_half_space)->scan_count, 2);
}

TEST(PartScans, namesScansApartThatAreCalledTheSame) {
  PartScans parts(10, 10);
  parts.add(kPart, 1, scanOf("scan", 3.0));
  EXPECT_EQ(parts.add(kPart, 2, scanOf("scan", 2.0))->margin.worst_scan, "scan 2");
}

TEST(PartScans, isBoundedAndSaysWhatItForgets) {
  PartScans parts(2, 3);
  for (std::uint64_t i = 1; i <= 3; ++i) parts.add(kPart, i, scanOf("low", 2.0));
  EXPECT_TRUE(parts.add(kPart, 3, scanOf("low", 2.0))->warnings.empty());
  const auto verdict = parts.add(kPart, 4, scanOf("high", 8.0));
  EXPECT_EQ(verdict->scan_count, 3);
  ASSERT_EQ(verdict->warnings.size(), 1U);
  EXPECT_EQ(verdict->warnings[0], "only the newest 3 of 4 scans are kept");

  parts.add({"second", "", ""}, 1, scanOf("a", 2.0));
  parts.add(kPart, 5, scanOf("a", 2.0));
  parts.add({"third", "", ""}, 1, scanOf("a", 2.0));  // the second has waited longest
  ASSERT_EQ(parts.verdicts().size(), 2U);
  EXPECT_EQ(parts.verdicts()[0].first.part_id, "lot 3");
  EXPECT_EQ(parts.verdicts()[1].first.part_id, "third");
}

}  // namespace
}  // namespace mems_stiction
