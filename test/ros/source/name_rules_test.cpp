/// What names of files say.

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "source/name_rules.hpp"

namespace mems_stiction {
namespace {

TEST(NameRules, WithoutPatternsAllButHiddenTemporaryAndSettingsAreScans) {
  const NameRules rules("", "", 1e-3);
  for (const char* name : {"a.di", "scan.001", "Probe ä 1.spm", "lot/a.txt", "noextension"}) {
    EXPECT_TRUE(rules.isScan(name)) << name;
  }
  for (const char* name : {".a.di.swp", "a.di.tmp", "a.di.part", "a.di~", "~$a.di", "a.di.yaml",
                           "x/.hidden", "A.TMP", "Thumbs.db", "lot/desktop.ini"}) {
    EXPECT_FALSE(rules.isScan(name)) << name;
  }
}

TEST(NameRules, PatternsAreOfNamesWithoutCaseOrOfPathsWithASlash) {
  const NameRules rules("*.di, heights/*.SPM", "", 1e-3);
  EXPECT_TRUE(rules.isScan("a.DI"));
  EXPECT_TRUE(rules.isScan("deep/below/a.di"));
  EXPECT_TRUE(rules.isScan("heights/a.spm"));
  EXPECT_FALSE(rules.isScan("a.spm"));
  EXPECT_FALSE(rules.isScan("a.dim"));
}

TEST(NameRules, NamedGroupsStateThePartUnlessSomebodyDidBefore) {
  const NameRules rules(
      "",
      R"((?<lot_id>L\d+)/W(?P<wafer_id>\d+)_(?<part_id>[A-Z]+)(?<serial_id>\d+)_x(?<site_x>-?[\d.]+)y(?<site_y>-?[\d.]+))",
      1e-3);
  ScanIdentity identity;
  identity.part_id = "of the sidecar";
  EXPECT_EQ(rules.identify("L7/W03_BEAM0042_x-12.5y3.di", identity), "");
  EXPECT_EQ(identity.lot_id, "L7");
  EXPECT_EQ(identity.wafer_id, "03");
  EXPECT_EQ(identity.part_id, "of the sidecar");
  EXPECT_EQ(identity.serial_id, "0042");
  EXPECT_DOUBLE_EQ(identity.site_x, -12.5e-3);
  EXPECT_DOUBLE_EQ(identity.site_y, 3e-3);
}

TEST(NameRules, AGroupThatTookNoPartStatesNothing) {
  const NameRules rules("", R"((?<part_id>[A-Z]+)(?:_(?<serial_id>\d+))?\.)", 1e-3);
  ScanIdentity identity;
  EXPECT_EQ(rules.identify("BEAM.di", identity), "");
  EXPECT_EQ(identity.part_id, "BEAM");
  EXPECT_EQ(identity.serial_id, "");
}

TEST(NameRules, SaysWhyANameStatesNothing) {
  const NameRules rules("", R"(part(?<part_id>\d+)_(?<site_x>[\d.]+)_(?<site_y>[\d.]+))", 1e-3);
  ScanIdentity identity;
  EXPECT_NE(rules.identify("other.di", identity).find("name_pattern"), std::string::npos);
  EXPECT_NE(rules.identify("part1_1.2.3_4.di", identity).find("1.2.3"), std::string::npos);
}

TEST(NameRules, OneOfTwoPlacesStatesNone) {
  const NameRules rules(
      "", R"((?<part_id>[A-Z]+)(?:_x(?<site_x>[\d.]+))?(?:_y(?<site_y>[-\d.]+))?\.di)", 1e-3);
  for (const char* name : {"B_x1.di", "B_y1.di", "B_x1_y-3...di"}) {
    SCOPED_TRACE(name);
    ScanIdentity identity;
    EXPECT_NE(rules.identify(name, identity).find("site"), std::string::npos);
    EXPECT_EQ(identity.part_id, "B");
    EXPECT_TRUE(std::isnan(identity.site_x) && std::isnan(identity.site_y));
  }
}

TEST(NameRules, RefusesExpressionsThatNameNothingKnown) {
  for (const char* pattern : {"[0-9]+", "(?<part>x)", "(?<part_id>[", "(?<=a)b"}) {
    EXPECT_THROW(NameRules("", pattern, 1e-3), OptionsError) << pattern;
  }
}

}  // namespace
}  // namespace mems_stiction
