/// YAML that contains itself, or that stands for more than memory holds, is refused wherever the
/// core reads YAML.

#include "settings/yaml_text.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "settings/option_yaml.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

template <typename Function>
std::string errorOf(Function&& function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::string parseError(const std::string& text) {
  return errorOf([&] { parseYaml(text, "a.yaml"); });
}

/// Ten lists, each of ten times the one before, in a map: 1e10 values.
std::string anchorBomb(const std::string& open, const std::string& close, const std::string& key) {
  std::string text = "a0: &a0 " + open + key + "1" + close + "\n";
  for (int level = 1; level < 10; ++level) {
    const std::string before = "*a" + std::to_string(level - 1) + " ";
    text += "a" + std::to_string(level) + ": &a" + std::to_string(level) + " " + open;
    for (int i = 0; i < 10; ++i) {
      text += (i > 0 ? ", " : "") + (key.empty() ? "" : "k" + std::to_string(i) + ": ") + before;
    }
    text += close + "\n";
  }
  return text;
}

TEST(YamlText, WhatContainsItselfIsRefusedWithItsLine) {
  for (const char* text :
       {"scan: &x {b: *x}", "scan: &x [*x]", "&x\na: *x", "scan: &x {b: {c: [1, *x]}}",
        "scan: &x\n  ? *x\n  : 1", "a: &x 1\nscan: &x {b: *x}"}) {
    EXPECT_NE(parseError(text).find("so that the text contains itself; must not"),
              std::string::npos)
        << text;
  }
  EXPECT_EQ(parseError("load:\n  a: &x\n    b: *x\n")
                .rfind("a.yaml: line 3: an alias stands inside what it names", 0),
            0u);
}

TEST(YamlText, AliasesForMoreThanMemoryHoldsAreRefused) {
  EXPECT_NE(parseError(anchorBomb("[", "]", "")).find("values, as aliases stand for many"),
            std::string::npos);
  EXPECT_NE(parseError(anchorBomb("{", "}", "k: ")).find("values, as aliases stand for many"),
            std::string::npos);
  std::string of_text = "a: &a " + std::string(100000, 'x') + "\nb: [";
  for (int i = 0; i < 100; ++i) of_text += "*a, ";
  EXPECT_NE(parseError(of_text + "1]").find("bytes, as aliases stand for many"), std::string::npos);
}

TEST(YamlText, LevelsEndWithAliasesOrWithout) {
  const auto nested = [](int levels) {
    return std::string(levels, '[') + "1" + std::string(levels, ']');
  };
  EXPECT_EQ(parseError(nested(kMaxYamlDepth)), "no error");
  EXPECT_NE(parseError(nested(kMaxYamlDepth + 1)).find("more than 32 levels"), std::string::npos);
  EXPECT_NE(parseError(nested(400000)).find("more than 32 levels"), std::string::npos);
  EXPECT_NE(parseError("a: &a " + nested(20) + "\nb: [[[[[[[[[[[[[*a]]]]]]]]]]]]]")
                .find("more than 32 levels"),
            std::string::npos);
}

TEST(YamlText, AliasesInMeasureServe) {
  const YAML::Node tree =
      parseYaml("lower: &film {hardness: 2e9}\nupper: *film\nx: &y 1\nz: [*y, *y]\n", "a.yaml");
  EXPECT_EQ(tree["upper"]["hardness"].as<double>(), 2e9);
  EXPECT_EQ(tree["z"].size(), 2u);
  EXPECT_TRUE(parseYaml("", "a.yaml").IsNull());
}

TEST(YamlText, WhatIsNoYamlIsSaidInWords) {
  EXPECT_EQ(parseError("a: [1, 2").rfind("a.yaml: not valid YAML: ", 0), 0u);
  EXPECT_EQ(parseError("a: 1\n\tb: 2").rfind("a.yaml: not valid YAML: line 2 begins with a tab", 0),
            0u);
  EXPECT_EQ(parseError("a: [1\x01").rfind("a.yaml: is not a text", 0), 0u);
}

TEST(YamlText, ASecondDocumentIsRefusedWithItsLine) {
  for (const char* text : {"a: 1\n---\nb: 2\n", "---\na: 1\n---\nb: 2\n", "a: 1\n...\nb: 2\n",
                           "a: 1\n...\n---\nb: 2\n", "{a: 1}\nb: 2\n", "---\n---\na: 1\n"}) {
    EXPECT_NE(parseError(text).find("a second document begins, must be one"), std::string::npos)
        << text << parseError(text);
  }
  EXPECT_EQ(parseError("---\na: 1\n---\nb: 2\n").rfind("a.yaml: line 3: a second", 0), 0u);
  for (const char* text : {"---\na: 1\n", "a: 1\n...\n", "%YAML 1.2\n---\na: 1\n...\n# end\n"})
    EXPECT_EQ(parseError(text), "no error") << text;
}

TEST(YamlText, AByte0IsRefusedWithItsLine) {
  using std::string_literals::operator""s;
  EXPECT_EQ(parseError("load:\n  a\0b: 1\n"s),
            "a.yaml: is not a text, so no file of settings: line 2 has a byte 0");
  EXPECT_EQ(parseError("a\0b: 1\n"s).rfind("a.yaml: is not a text", 0), 0u);
  EXPECT_EQ(parseError("# \0\na: 1\n"s).rfind("a.yaml: is not a text", 0), 0u);
  EXPECT_EQ(parseError("a: \"x\\0y\"\n"), "a.yaml: line 1: a text has a byte 0; must not");
  EXPECT_EQ(parseYaml("\xFF\xFE"s + "a\0:\0 \0001\0\n\0"s, "a.yaml")["a"].as<int>(), 1);
}

TEST(YamlText, EveryFileOfSettingsIsReadSo) {
  const ScratchFolder folder;
  for (const std::string& text : {std::string("scan: &x {b: *x}"), anchorBomb("{", "}", "k: ")}) {
    const std::string path = folder.write("part.yaml", text);
    EXPECT_EQ(errorOf([&] { loadConfiguration(path); }).rfind(path + ": line ", 0), 0u);
    const std::string scan = folder.write("scan.csv", "1, 2\n3, 4\n");
    const std::string sidecar = folder.write("scan.csv.yaml", text);
    EXPECT_EQ(errorOf([&] { openScanFile(scan); }).rfind(sidecar + ": line ", 0), 0u);
    EXPECT_EQ(errorOf([&] { listScanChannels(scan); }).rfind(sidecar + ": line ", 0), 0u);
  }
}

TEST(YamlText, ATreeThatContainsItselfIsRefusedWhoeverHasMadeIt) {
  YAML::Node loop;
  loop["b"] = loop;
  const std::string text = errorOf([&] { configurationFromYaml(loop); });
  EXPECT_NE(text.find("more than 32 maps within one another are given"), std::string::npos) << text;
  EXPECT_TRUE(keysOf(loop).empty());
  YAML::Node bomb(YAML::NodeType::Map);
  bomb["k"] = "1";
  for (int level = 0; level < 12; ++level) {
    YAML::Node above(YAML::NodeType::Map);
    for (int i = 0; i < 10; ++i) above["k" + std::to_string(i)] = bomb;
    bomb = above;
  }
  EXPECT_NE(errorOf([&] { configurationFromYaml(bomb); }).find("more than 100000 keys are given"),
            std::string::npos);
}

TEST(YamlText, ManyComplaintsAreAFew) {
  std::string twice;
  for (int i = 0; i < 20000; ++i) twice += "a: 1\n";
  EXPECT_LT(errorOf([&] { configurationFromYaml(parseYaml(twice, "a")); }).size(), 20000u);
  const std::string long_key(500000, 'k');
  EXPECT_LT(
      errorOf([&] { configurationFromYaml(parseYaml(long_key + ": {a: 1, b: 1}", "a")); }).size(),
      20000u);
}

}  // namespace
}  // namespace mems_stiction
