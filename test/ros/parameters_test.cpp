#include "ros/parameters.hpp"

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <ros/time.h>
#include <yaml-cpp/yaml.h>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/paper/paper_options.hpp"
#include "settings/option_yaml.hpp"

namespace mems_stiction {
namespace {

NodeConfiguration nodeConfigurationFromYaml(const YAML::Node& tree) {
  return statedConfiguration(tree).configuration;
}

NodeConfiguration fromText(const std::string& text) {
  return nodeConfigurationFromYaml(YAML::Load(text));
}

std::string violations(const std::string& text) {
  try {
    fromText(text);
  } catch (const OptionsError& error) {
    return error.what();
  }
  return "";
}

TEST(Parameters, AnEmptyNamespaceGivesTheDefaults) {
  const NodeConfiguration configuration =
      nodeConfigurationFromYaml(YAML::Node(YAML::NodeType::Map));
  EXPECT_EQ(configuration.node.queue_size, 10);
  EXPECT_EQ(configuration.node.drop_policy, DropPolicy::kAll);
  EXPECT_TRUE(configuration.node.use_scan_info);
  EXPECT_EQ(configuration.core.model.lower.hardness, Configuration().model.lower.hardness);
}

TEST(Parameters, NodeAndCoreKeysStandSideBySide) {
  const NodeConfiguration configuration = fromText(
      "{queue_size: 3, drop_policy: latest, lower: {hardness: 2.0e9}, load: {mechanical_load: "
      "1e-6}, "
      "display: {max_points: 100}}");
  EXPECT_EQ(configuration.node.queue_size, 3);
  EXPECT_EQ(configuration.node.drop_policy, DropPolicy::kLatest);
  EXPECT_EQ(configuration.node.display.max_points, 100);
  EXPECT_EQ(configuration.core.model.lower.hardness, 2e9);
  EXPECT_EQ(configuration.core.model.load.mechanical_load, 1e-6);
}

TEST(Parameters, EveryBadKeyIsNamedAtOnce) {
  const std::string text = violations(
      "{queue_sise: 3, drop_policy: newest, lower: {hardness: -1}, pairing_timeout: soon, load: "
      "{voltage: 5}}");
  for (const char* key : {"queue_sise", "drop_policy", "lower/hardness", "pairing_timeout",
                          "interface/insulator_thickness"}) {
    EXPECT_NE(text.find(key), std::string::npos) << key << " in\n" << text;
  }
  EXPECT_NE(text.find("newest"), std::string::npos) << text;
}

TEST(Parameters, LongValuesAndNamesAreRefusedInShort) {
  EXPECT_LT(violations("{drop_policy: " + std::string(100000, 'a') + "}").size(), 1000U);
  EXPECT_LT(violations("{queue_size: " + std::string(100000, 'a') + "}").size(), 1000U);
  EXPECT_LT(violations("{" + std::string(1000, 'k') + ": " + std::string(100000, 'a') + "}").size(),
            1000U);
  const std::string longest(1000, 'p');
  for (const std::string key : {"id", "serial", "lot", "wafer"}) {
    EXPECT_EQ(violations("{part: {" + key + ": " + longest + "p}}"),
              "part/" + key + ": a name of 1001 bytes is not allowed, must have at most 1000");
    EXPECT_EQ(violations("{part: {" + key + ": " + longest + "}}"), "");
  }
  EXPECT_EQ(violations("{part: {id: " + std::string(5000000, 'p') + "}}"),
            "part/id: a text of 5000000 bytes is not allowed, must have at most 4096");
}

TEST(Parameters, TheNameOfAConfigurationFileIsNoLongText) {
  const std::string file(5000000, 'f');
  EXPECT_EQ(violations("{config: {file: " + file + ", text: 'queue_sise: 5'}}"),
            "config/file: a text of 5000000 bytes is not allowed, must have at most 4096");
}

TEST(Parameters, TenThousandUnknownOnesAreRefusedWithinASecond) {
  XmlRpc::XmlRpcValue tree;
  for (int number = 0; number < 10000; ++number) tree["unknown_" + std::to_string(number)] = number;
  const ros::SteadyTime begin = ros::SteadyTime::now();
  try {
    statedConfiguration(yamlFromParameters(tree));
    ADD_FAILURE() << "none of them is a setting";
  } catch (const OptionsError& error) {
    EXPECT_NE(error.violations().back().find("9900 more keys"), std::string::npos)
        << error.violations().back();
  }
  // 12 s and more where each key was compared with all before; a tenth of a second else
  EXPECT_LT((ros::SteadyTime::now() - begin).toSec(), 3.0);
}

TEST(Parameters, TenThousandOfNoTypeAreNamedInShort) {
  XmlRpc::XmlRpcValue tree;
  std::tm date = {};
  for (int number = 0; number < 10000; ++number)
    tree["date_" + std::to_string(number)] = XmlRpc::XmlRpcValue(&date);
  try {
    yamlFromParameters(tree);
    ADD_FAILURE() << "a date is no setting";
  } catch (const OptionsError& error) {
    EXPECT_EQ(error.violations().back(), "and 9600 more");
    EXPECT_LT(std::string(error.what()).size(), 100000U);
  }
}

TEST(Parameters, TimersHaveAShortestPeriod) {
  for (const std::string key : {"diagnostic_period", "pairing_timeout"}) {
    EXPECT_NE(violations("{" + key + ": 1.0e-9}").find(key), std::string::npos);
    EXPECT_EQ(violations("{" + key + ": 0.01}"), "");
  }
}

TEST(Parameters, AFormulationOfEarlierVersionsIsRefusedWithWhatServesInstead) {
  const std::string text = violations("{approach: {formulation: corrected}}");
  EXPECT_NE(text.find("approach/formulation: 'corrected' is no longer there"), std::string::npos)
      << text;
  EXPECT_NE(text.find("`paper`"), std::string::npos) << text;
  EXPECT_EQ(violations("{approach: {formulation: paper}}"), "");
}

TEST(Parameters, ImageTransportMayKeepItsOwnKeys) {
  EXPECT_EQ(violations("{image_transport: raw, deformed_height: {disable_pub_plugins: "
                       "[image_transport/theora]}, "
                       "contact_map: {compressed: {format: png}}}"),
            "");
  EXPECT_NE(violations("{contact_map: {color: red}}").find("contact_map/color"), std::string::npos);
  EXPECT_NE(
      violations("{prediction: {disable_pub_plugins: []}}").find("prediction/disable_pub_plugins"),
      std::string::npos);
}

/// Their plugins allocate what a message states: 43 bytes took 4 GB.
TEST(Parameters, HeightsComeRaw) {
  for (const std::string transport : {"compressed", "compressedDepth", "theora", "''", "[raw]"}) {
    const std::string text = violations("{image_transport: " + transport + "}");
    EXPECT_EQ(text.find("image_transport: "), 0U) << text;
    EXPECT_NE(text.find("is not allowed, must be raw"), std::string::npos) << text;
  }
}

TEST(Parameters, TheFrameOfTheCounterSurfaceIsTheNodesAndExcludesAPose) {
  const NodeConfiguration configuration =
      fromText("{counter_surface: {type: flat, frame: chuck, transform_timeout: 2.0}}");
  EXPECT_EQ(configuration.node.transform.frame, "chuck");
  EXPECT_EQ(configuration.node.transform.timeout, 2.0);
  const std::string text = violations("{counter_surface: {frame: chuck, pose: {tilt_x: 0.1}}}");
  EXPECT_NE(text.find("counter_surface/frame"), std::string::npos) << text;
}

YAML::Node withFile(const std::string& text) {
  YAML::Node tree;
  tree["config"]["file"] = "part.yaml";
  tree["config"]["text"] = text;
  return tree;
}

TEST(Parameters, TheTextOfAFileIsReadAsTheCommandLineReadsIt) {
  const StatedConfiguration stated =
      statedConfiguration(withFile("part: {id: 0012}\nload: {mechanical_load: 1e-6}\n"));
  EXPECT_EQ(stated.configuration.core.part.id, "0012");
  EXPECT_EQ(stated.configuration.core.model.load.mechanical_load, 1e-6);
  EXPECT_EQ(stated.from_files, (std::vector<std::string>{"load/mechanical_load", "part/id"}));
  EXPECT_TRUE(stated.overrides.empty());
}

TEST(Parameters, AKeyThatAFileHasTwiceIsRefusedWithFileAndLines) {
  try {
    statedConfiguration(
        withFile("preprocessing: {level: plane}\npreprocessing: {fill: {enabled: true}}\n"));
    ADD_FAILURE();
  } catch (const OptionsError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("part.yaml: preprocessing: given in line 2 and before in line 1"),
              std::string::npos)
        << error.what();
  }
}

TEST(Parameters, WhatIsNoYamlIsNamedByItsFile) {
  try {
    statedConfiguration(withFile("load: [1"));
    ADD_FAILURE();
  } catch (const OptionsError& error) {
    EXPECT_EQ(std::string(error.what()).find("part.yaml: not valid YAML"), 0u) << error.what();
  }
}

TEST(Parameters, RelativePathsOfAFileGoByItsFolder) {
  YAML::Node tree = withFile("counter_surface: {type: file, file: upper.npy, facing: up}\n");
  tree["config"]["file"] = "/data/line 1/part.yaml";
  EXPECT_EQ(statedConfiguration(tree).configuration.core.counter_surface.file,
            "/data/line 1/upper.npy");
  tree["config"]["file"] = "part.yaml";  // which the node's own folder does not hold
  try {
    statedConfiguration(tree);
    ADD_FAILURE();
  } catch (const OptionsError& error) {
    EXPECT_EQ(std::string(error.what())
                  .find("part.yaml: counter_surface/file: 'upper.npy' goes by the folder of this"),
              0u)
        << error.what();
  }
  tree["config"]["text"] = "counter_surface: {type: file, file: /data/upper.npy, facing: up}\n";
  EXPECT_EQ(statedConfiguration(tree).configuration.core.counter_surface.file, "/data/upper.npy");
  const std::string here = std::filesystem::current_path().string();
  EXPECT_EQ(fromText("{preprocessing: {region: {mask_file: mask.png}}}")
                .core.preprocessing.region.mask_file,
            here + "/mask.png");
}

TEST(Parameters, TextsThatContainThemselvesAreRefused) {
  const auto refusal = [](const YAML::Node& tree) {
    try {
      statedConfiguration(tree);
    } catch (const OptionsError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(withFile("scan: &x {b: *x}"))
                .find("part.yaml: line 1: an alias stands inside what it names"),
            0u);
  EXPECT_NE(refusal(withFile("# " + std::string(1000000, 'x'))).find("more than the 1000000 of"),
            std::string::npos);
  YAML::Node taken;
  taken["load"]["max_voltage"] = "5";
  for (const char* text : {"&x {b: *x}", "a: [1"}) {
    taken["taken_at_start"] = text;
    EXPECT_EQ(refusal(taken).find("taken_at_start: "), 0u) << refusal(taken);
  }
}

TEST(Parameters, ParametersBesideAFileGoBeforeItAndAreNamed) {
  YAML::Node tree = withFile("load: {mechanical_load: 1e-6, max_voltage: 20}\n");
  tree["load"]["mechanical_load"] = "2e-6";
  const StatedConfiguration stated = statedConfiguration(tree);
  EXPECT_EQ(stated.configuration.core.model.load.mechanical_load, 2e-6);
  EXPECT_EQ(stated.overrides, std::vector<std::string>{"load/mechanical_load"});
  EXPECT_EQ(stated.from_files, std::vector<std::string>{"load/max_voltage"});
  // What the node itself has put there is the same, and overrides nothing.
  tree["load"]["mechanical_load"] = "1e-6";
  EXPECT_TRUE(statedConfiguration(tree).overrides.empty());
}

TEST(Parameters, WithoutFilesWhatAnEarlierRunHasLeftDoesNotMixWithWhatWasSetSince) {
  YAML::Node tree =
      YAML::Load("{load: {mechanical_load: 1e-6, max_voltage: 5}, lower: {hardness: 2e9}}");
  tree["taken_at_start"] = statedConfiguration(tree).taken;
  EXPECT_NO_THROW(statedConfiguration(tree));  // started again
  tree["load"]["max_voltage"] = "6";
  try {
    statedConfiguration(tree);
    ADD_FAILURE();
  } catch (const OptionsError& error) {
    ASSERT_EQ(error.violations().size(), 2u) << error.what();
    EXPECT_EQ(
        error.violations()[0].find("load/mechanical_load: 1e-6 lies there since an earlier run"),
        0u)
        << error.what();
    EXPECT_EQ(error.violations()[1].find("lower/hardness"), 0u) << error.what();
  }
  const YAML::Node cleared = YAML::Load("{load: {max_voltage: 6}}");
  EXPECT_EQ(statedConfiguration(cleared).configuration.core.model.load.max_voltage, 6.0);
}

TEST(Parameters, TheMirrorOfReconfigureIsNoSetting) {
  EXPECT_EQ(violations("{reconfigure: {voltage: 1.0}}"), "");
  EXPECT_NE(violations("{voltage: 1.0}").find("voltage"), std::string::npos);
}

TEST(Parameters, TheParameterServersTypesArriveUnchanged) {
  XmlRpc::XmlRpcValue tree;
  tree["lower"]["youngs_modulus"] = 1e11 / 3.0;
  tree["load"]["max_voltage"] = 7;            // an integer serves for a number
  tree["paper"]["cutoff_distance"] = "1e-9";  // PyYAML reads this as text
  tree["scan"]["invalid_value"] = std::nan("");
  tree["accumulate_deformation"] = true;
  const NodeConfiguration configuration = nodeConfigurationFromYaml(yamlFromParameters(tree));
  EXPECT_EQ(configuration.core.model.lower.youngs_modulus, 1e11 / 3.0);
  EXPECT_EQ(configuration.core.model.load.max_voltage, 7.0);
  EXPECT_EQ(configuration.core.model.solver.of<PaperOptions>().cutoff_distance, 1e-9);
  EXPECT_TRUE(std::isnan(configuration.core.scan.invalid_value));
  EXPECT_TRUE(configuration.node.accumulate_deformation);
}

/// rosparam has made 15 of `part: {id: 0017}`, roscpp 12 of _part/serial:=0012.
TEST(Parameters, ATextThatArrivesAsANumberIsRefused) {
  XmlRpc::XmlRpcValue tree;
  tree["part"]["id"] = 15;
  tree["part"]["serial"] = 1e5;
  tree["part"]["lot"] = true;
  tree["counter_surface"]["frame"] = 3;
  try {
    nodeConfigurationFromYaml(yamlFromParameters(tree));
    ADD_FAILURE();
  } catch (const OptionsError& error) {
    ASSERT_EQ(error.violations().size(), 4u) << error.what();
    EXPECT_EQ(error.violations()[0].find(
                  "part/id: 15 came as a number or a flag, must be a text: quote it ('15')"),
              0u)
        << error.what();
  }
  tree = XmlRpc::XmlRpcValue();
  tree["part"]["id"] = "0017";
  tree["part"]["serial"] = "'0012'";  // _part/serial:="'0012'"
  const StatedConfiguration stated = statedConfiguration(yamlFromParameters(tree));
  EXPECT_EQ(stated.configuration.core.part.id, "0017");
  EXPECT_EQ(stated.configuration.core.part.serial, "0012");
}

TEST(Parameters, WhatANodeHasTakenIsTheSameWhenItStartsAgain) {
  XmlRpc::XmlRpcValue tree;
  tree["load"]["max_voltage"] = 5;
  tree["lower"]["hardness"] = 2e9;
  tree["part"]["id"] = "0017";
  tree["taken_at_start"] = statedConfiguration(yamlFromParameters(tree)).taken;
  EXPECT_NO_THROW(statedConfiguration(yamlFromParameters(tree)));
  tree["load"]["max_voltage"] = 6;
  EXPECT_THROW(statedConfiguration(yamlFromParameters(tree)), OptionsError);
}

TEST(Parameters, TypesThatAreNoSettingAreNamed) {
  XmlRpc::XmlRpcValue tree;
  char bytes[] = "abc";
  tree["lower"]["hardness"] = XmlRpc::XmlRpcValue(bytes, 3);
  try {
    yamlFromParameters(tree);
    ADD_FAILURE();
  } catch (const OptionsError& error) {
    EXPECT_NE(std::string(error.what()).find("lower/hardness"), std::string::npos) << error.what();
  }
}

/// The file is the documentation of the parameters, so it must show every key with its default.
TEST(Parameters, TheShippedNodeYamlHoldsEveryKeyWithItsDefault) {
  const YAML::Node shipped = YAML::LoadFile(MEMS_STICTION_SOURCE_DIR "/config/node.yaml");
  const YAML::Node defaults =
      YAML::Load(toYaml([](OptionVisitor& visitor) { NodeOptions().describe(visitor); }));
  std::size_t compared = 0;
  const auto compare = [&](const YAML::Node& left, const YAML::Node& right,
                           const std::string& where) {
    ASSERT_EQ(left.size(), right.size()) << where;
    for (const auto& entry : right) {
      const std::string key = entry.first.Scalar();
      ASSERT_TRUE(left[key]) << where << key;
      if (entry.second.IsMap()) continue;
      if (double number = 0.0; YAML::convert<double>::decode(entry.second, number)) {
        EXPECT_EQ(left[key].as<double>(), number) << where << key;
      } else {
        EXPECT_EQ(left[key].Scalar(), entry.second.Scalar()) << where << key;
      }
      ++compared;
    }
  };
  compare(shipped, defaults, "");
  compare(shipped["display"], defaults["display"], "display/");
  compare(shipped["counter_surface"], defaults["counter_surface"], "counter_surface/");
  EXPECT_EQ(compared, 22U);
}

}  // namespace
}  // namespace mems_stiction
