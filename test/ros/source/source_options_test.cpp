/// What scan_source takes of its own parameters, and of the node's configuration.

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "mems_stiction/errors/errors.hpp"
#include "source/source_options.hpp"

namespace mems_stiction {
namespace {

YAML::Node withConfiguration(const std::string& own, const std::string& text) {
  YAML::Node tree = YAML::Load(own);
  tree["config"]["file"] = "device.yaml";
  tree["config"]["text"] = text;
  return tree;
}

TEST(SourceOptions, ScansOfTheNodesConfigurationServeBehindItsOwn) {
  const std::string config =
      "lower: {hardness: 1e9}\nscan: {pitch_x: 2e-8, pitch_y: 3e-8, height_scale: 1e-9}";
  const SourceOptions taken = statedSourceOptions(withConfiguration("folder: /data", config));
  EXPECT_DOUBLE_EQ(taken.scan.pitch_x, 2e-8);
  EXPECT_DOUBLE_EQ(taken.scan.pitch_y, 3e-8);
  EXPECT_DOUBLE_EQ(taken.scan.height_scale, 1e-9);
  const SourceOptions own = statedSourceOptions(
      withConfiguration("{folder: /data, scan: {pitch_x: 5e-8, pitch_y: 5e-8}}", config));
  EXPECT_DOUBLE_EQ(own.scan.pitch_x, 5e-8);
  EXPECT_DOUBLE_EQ(own.scan.height_scale, 1e-9);
  const SourceOptions flat = statedSourceOptions(withConfiguration(
      "{folder: /data, scan: {pitch_x: 5e-8}}", "{scan/pitch_x: 2e-8, scan/pitch_y: 3e-8}"));
  EXPECT_DOUBLE_EQ(flat.scan.pitch_x, 5e-8);
  EXPECT_DOUBLE_EQ(flat.scan.pitch_y, 3e-8);
  for (const char* without : {"", "lower: {hardness: 1e9}", "scan:"}) {
    EXPECT_EQ(statedSourceOptions(withConfiguration("folder: /data", without)).scan.pitch_x, 0.0);
  }
}

TEST(SourceOptions, PointsAreInMetresAndTakeNothingThatIsOfFiles) {
  const std::string config = "scan: {pitch_x: 2e-8, pitch_y: 3e-8, height_scale: 1e-9}";
  EXPECT_NO_THROW(statedSourceOptions(withConfiguration("source: cloud", config)));
  for (const char* stated : {"scan: {height_scale: 1e-3}", "scan/pitch_x: 1e-6"}) {
    EXPECT_THROW(statedSourceOptions(YAML::Load(std::string("source: cloud\n") + stated)),
                 OptionsError)
        << stated;
  }
}

TEST(SourceOptions, AConfigurationThatCannotBeReadIsNamed) {
  try {
    statedSourceOptions(withConfiguration("folder: /data", "scan: {pitch_x"));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("device.yaml"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace mems_stiction
