/// The hash of the settings: the same for the same figures, another for others.

#include "mems_stiction/configuration/provenance.hpp"

#include <gtest/gtest.h>

#include <string>

#include "configuration/named_files.hpp"
#include "mems_stiction/configuration/configuration.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

TEST(Provenance, AnotherSettingIsAnotherHash) {
  const std::string hash = settingsHash(Configuration());
  EXPECT_EQ(hash.size(), 16u);
  EXPECT_EQ(settingsHash(Configuration()), hash);
  Configuration changed;
  changed.model.load.voltage = 1e-9;
  EXPECT_NE(settingsHash(changed), hash);
  changed = Configuration();
  changed.preprocessing.level.shape = LevelShape::kPlane;
  EXPECT_NE(settingsHash(changed), hash);
  changed = Configuration();
  changed.preprocessing.region.mask_file = "mask.png";
  EXPECT_NE(settingsHash(changed), hash);
  changed = Configuration();
  changed.half_space.enabled = HalfSpaceUse::kAlways;  // another judge
  EXPECT_NE(settingsHash(changed), hash);
}

TEST(Provenance, FilesCountByWhatTheyContain) {
  const ScratchFolder folder;
  Configuration named;
  named.preprocessing.region.mask_file = folder.write("mask.png", "one");
  const std::string hash = settingsHash(named);
  EXPECT_EQ(settingsHash(named), hash);
  Configuration elsewhere;
  elsewhere.preprocessing.region.mask_file = folder.write("copy.png", "one");
  EXPECT_EQ(settingsHash(elsewhere), hash);
  Configuration polygon;
  polygon.preprocessing.region.polygon_file = folder.file("copy.png");
  EXPECT_NE(settingsHash(polygon), hash);

  const Configuration read = withFilesOfNow(named);
  folder.write("mask.png", "two");
  EXPECT_NE(settingsHash(named), hash);
  EXPECT_EQ(settingsHash(read), hash);  // of what was read
  EXPECT_NE(settingsHash(withFilesOfNow(read)), hash);
}

TEST(Provenance, TheSidecarOfACounterSurfaceCountsAndAFileThatIsNotUsedDoesNot) {
  const ScratchFolder folder;
  Configuration named;
  named.counter_surface.file = folder.write("upper.txt", "1 2\n3 4\n");
  EXPECT_EQ(settingsHash(named), settingsHash(Configuration()));
  named.counter_surface.type = CounterSurfaceType::kFile;
  const std::string hash = settingsHash(named);
  folder.write("upper.txt.yaml", "pitch_x: 1e-9\npitch_y: 1e-9\n");
  EXPECT_NE(settingsHash(named), hash);
}

TEST(Provenance, WhoTheScanIsOfAndWhatIsAskedForDoNotCount) {
  Configuration changed;
  changed.part.id = "17";
  changed.model.output.contact_map = false;
  changed.half_space.threads = 2;
  changed.limits.max_time = 1.0;
  EXPECT_EQ(settingsHash(changed), settingsHash(Configuration()));
}

TEST(Provenance, WhatTheScanSaysGoesBeforeTheSettings) {
  Configuration configuration;
  configuration.part = {"lot 3", "0012", "L7", "W3"};
  const Provenance of_settings = provenanceOf({"scan"}, configuration);
  EXPECT_EQ(of_settings.scan_name, "scan");
  EXPECT_EQ(of_settings.part_id, "lot 3");
  EXPECT_EQ(of_settings.serial_id, "0012");
  EXPECT_EQ(of_settings.lot_id, "L7");
  EXPECT_EQ(of_settings.wafer_id, "W3");
  EXPECT_FALSE(of_settings.version.empty());
  ScanIdentity scan;
  scan.part_id = "lot 4";
  scan.wafer_id = "W4";
  EXPECT_EQ(provenanceOf(scan, configuration).part_id, "lot 4");
  EXPECT_EQ(provenanceOf(scan, configuration).wafer_id, "W4");
  EXPECT_EQ(provenanceOf(scan, configuration).lot_id, "L7");
}

TEST(Provenance, OfItTheStatedFieldsAlone) {
  ScanIdentity scan;
  scan.part_id = "lot 4";
  scan.site_x = 0.0;
  scan.site_y = -1e-3;
  std::string names;
  visitStatedProvenance(provenanceOf(scan, {}), [&](const Figure& figure, const auto&) {
    names += std::string(figure.name) + " ";
  });
  EXPECT_EQ(names, "version settings_hash part_id site_x site_y ");
}

}  // namespace
}  // namespace mems_stiction
