#include "mems_stiction/configuration/configuration.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <set>

#include "evaluation/plausibility.hpp"
#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/paper/paper_options.hpp"
#include "settings/option_yaml.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

Configuration read(const std::string& yaml) { return configurationFromYaml(YAML::Load(yaml)); }

/// The lines of the error that reading `yaml` gives, as one text; empty if it gives none.
std::string refusal(const std::string& yaml) {
  try {
    read(yaml);
  } catch (const OptionsError& error) {
    return error.what();
  }
  return "";
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The keys that a configuration describes.
class KeyCollector : public OptionVisitor {
 public:
  void number(const std::string& key, double&, const std::string&, const Range&,
              const std::string& meaning) override {
    add(key, meaning);
  }
  void integer(const std::string& key, int&, const Range&, const std::string& meaning) override {
    add(key, meaning);
  }
  void flag(const std::string& key, bool&, const std::string& meaning) override {
    add(key, meaning);
  }
  void text(const std::string& key, std::string&, const std::string& meaning) override {
    add(key, meaning);
  }
  void choice(const std::string& key, std::string&, const std::vector<std::string>&,
              const std::string& meaning) override {
    add(key, meaning);
  }
  std::set<std::string> keys;

 private:
  void add(const std::string& key, const std::string& meaning) {
    EXPECT_TRUE(keys.insert(key).second) << key << " is described twice";
    EXPECT_FALSE(meaning.empty()) << key;
  }
};

/// Keys of the leaves of a tree, with slashes.
void addKeys(const YAML::Node& tree, const std::string& prefix, std::set<std::string>& keys) {
  for (const auto& entry : tree) {
    const std::string key = prefix + entry.first.Scalar();
    if (entry.second.IsMap()) {
      addKeys(entry.second, key + "/", keys);
    } else {
      keys.insert(key);
    }
  }
}

TEST(Configuration, DefaultsAreValid) { EXPECT_TRUE(Configuration().validate().empty()); }

TEST(Configuration, NestedMapsAndFlatKeysAreTheSame) {
  EXPECT_EQ(read("lower: {youngs_modulus: 78e9}").model.lower.youngs_modulus, 78e9);
  EXPECT_EQ(read("lower/youngs_modulus: 78e9").model.lower.youngs_modulus, 78e9);
  EXPECT_EQ(read("/lower/youngs_modulus/: 78e9").model.lower.youngs_modulus, 78e9);
}

TEST(Configuration, NothingGivenKeepsTheDefaults) {
  EXPECT_EQ(toYaml(read("")), toYaml(Configuration()));
  EXPECT_EQ(toYaml(read("{}")), toYaml(Configuration()));
  EXPECT_EQ(toYaml(read("lower:\nload: {}")), toYaml(Configuration()));
}

TEST(Configuration, GivenDefaultsAreKept) {
  Configuration defaults;
  defaults.model.load.mechanical_load = 1e-6;
  const Configuration configuration =
      configurationFromYaml(YAML::Load("paper/step: 1e-10"), defaults);
  EXPECT_EQ(configuration.model.load.mechanical_load, 1e-6);
  EXPECT_EQ(configuration.model.solver.of<PaperOptions>().step, 1e-10);
}

TEST(Configuration, FormerNamesAreRefusedWithThoseOfNow) {
  EXPECT_EQ(refusal("approach: {step: 1e-10}"),
            "approach/step: '1e-10' is given, but its name is paper/step now");
  EXPECT_EQ(
      refusal("interface/cutoff_distance: 2e-10"),
      "interface/cutoff_distance: '2e-10' is given, but its name is paper/cutoff_distance now");
}

TEST(Configuration, NumbersMayBeQuotedAsPythonDoes) {
  // PyYAML writes and reads 1e-9 as a string, since it has no decimal point.
  EXPECT_EQ(read("scan: {pitch_x: '1e-9', pitch_y: \"2E-9\"}").scan.pitch_y, 2e-9);
  EXPECT_EQ(read("approach/max_steps: '500'").model.approach.max_steps, 500);
  EXPECT_EQ(read("approach/max_steps: 500.0").model.approach.max_steps, 500);
  EXPECT_TRUE(std::isnan(read("scan/invalid_value: .nan").scan.invalid_value));
  EXPECT_TRUE(std::isnan(read("scan/invalid_value: nan").scan.invalid_value));
  EXPECT_EQ(read("scan/invalid_value: -9999").scan.invalid_value, -9999.0);
}

TEST(Configuration, ChoicesAndFlagsAreRead) {
  const Configuration configuration = read(
      "approach: {connectivity: 8, formulation: printed}\npreprocessing/level: plane\n"
      "counter_surface: {type: topic, facing: up}\noutput/energy_curve: yes\noutput/asperities: "
      "False");
  EXPECT_EQ(configuration.model.approach.connectivity, Connectivity::kEight);
  EXPECT_EQ(configuration.model.formulation, "printed");
  EXPECT_EQ(configuration.preprocessing.level.shape, LevelShape::kPlane);
  EXPECT_EQ(configuration.counter_surface.type, CounterSurfaceType::kTopic);
  EXPECT_EQ(configuration.counter_surface.facing, CounterSurfaceFacing::kUp);
  EXPECT_TRUE(configuration.model.output.energy_curve);
  EXPECT_FALSE(configuration.model.output.asperities);
}

TEST(Configuration, AChoiceBesideTrueAndFalseTakesEveryWordForThem) {
  EXPECT_EQ(Configuration().half_space.enabled, HalfSpaceUse::kFlagged);
  EXPECT_EQ(read("half_space/enabled: flagged").half_space.enabled, HalfSpaceUse::kFlagged);
  for (const char* word : {"true", "True", "on", "yes", "'true'"}) {
    EXPECT_EQ(read(std::string("half_space/enabled: ") + word).half_space.enabled,
              HalfSpaceUse::kAlways)
        << word;
  }
  for (const char* word : {"false", "OFF", "no"}) {
    EXPECT_EQ(read(std::string("half_space/enabled: ") + word).half_space.enabled,
              HalfSpaceUse::kNever)
        << word;
  }
  const std::string line = refusal("half_space/enabled: maybe");
  EXPECT_TRUE(mentions(
      line, "half_space/enabled: 'maybe' is not allowed, must be one of: false, flagged, true"))
      << line;
  EXPECT_TRUE(
      mentions(refusal("counter_surface/type: on"), "counter_surface/type: 'on' is not allowed"));
}

TEST(Configuration, UnknownKeyIsNamedWithTheOneThatWasMeant) {
  const std::string spelling = refusal("lower: {youngs_modulos: 78e9}");
  EXPECT_TRUE(mentions(spelling, "lower/youngs_modulos: '78e9'")) << spelling;
  EXPECT_TRUE(mentions(spelling, "did you mean lower/youngs_modulus?")) << spelling;
  const std::string section = refusal("work_of_adhesion: 0.1");
  EXPECT_TRUE(mentions(section, "did you mean interface/work_of_adhesion")) << section;
  const std::string of_section = refusal("lowr: {youngs_modulus: 78e9}");
  EXPECT_TRUE(mentions(of_section, "did you mean lower/youngs_modulus?")) << of_section;
  const std::string list = refusal("device: [1, 2]");
  EXPECT_TRUE(mentions(list, "device: a list is given, must be a section")) << list;
  const std::string far = refusal("colour: blue");
  EXPECT_TRUE(mentions(far, "colour: 'blue'")) << far;
  EXPECT_FALSE(mentions(far, "did you mean")) << far;
}

TEST(Configuration, WrongTypesNameKeyValueAndWhatIsAllowed) {
  for (const std::string value : {"soft", "true", "[1, 2]", "1,5", "12 GPa", "0x10"}) {
    const std::string line =
        refusal("lower: {hardness: " + (value[0] == '[' ? value : "'" + value + "'") + "}");
    EXPECT_TRUE(mentions(line, "lower/hardness: ")) << value;
    EXPECT_TRUE(mentions(line, "must be a number > 0 Pa")) << value;
    EXPECT_EQ(mentions(line, "'" + value + "'"), value[0] != '[') << line;
  }
  EXPECT_TRUE(mentions(refusal("approach/max_steps: 2.5"), "approach/max_steps: '2.5'"));
  EXPECT_TRUE(mentions(refusal("approach/max_steps: 1e300"), "approach/max_steps: '1e300'"));
  EXPECT_TRUE(mentions(refusal("output/roughness: maybe"), "output/roughness: 'maybe'"));
  EXPECT_TRUE(mentions(refusal("approach/formulation: printd"),
                       "one of: separation_curve, paper, printed"));
  EXPECT_TRUE(mentions(refusal("lower/hardness: {vickers: 1}"), "lower/hardness/vickers"));
  EXPECT_TRUE(mentions(refusal("[1, 2]"), "must be a map"));
}

TEST(Configuration, AFormulationOfEarlierVersionsIsRefusedWithWhatServesInstead) {
  const std::string text = refusal("approach: {formulation: corrected}");
  EXPECT_TRUE(mentions(text, "approach/formulation: 'corrected' is no longer there")) << text;
  EXPECT_TRUE(mentions(text, "`separation_curve`")) << text;
  EXPECT_TRUE(mentions(text, "`paper`")) << text;
  EXPECT_TRUE(mentions(refusal("approach: {formulation: consistent}"),
                       "its name is `separation_curve` now"));
  EXPECT_FALSE(mentions(refusal("approach/formulation: printd"), "no longer")) << text;
}

TEST(Configuration, UnphysicalValuesAreRefused) {
  EXPECT_TRUE(mentions(refusal("lower/youngs_modulus: -1"),
                       "lower/youngs_modulus: -1 Pa is not allowed, must be > 0"));
  EXPECT_TRUE(mentions(refusal("lower/poisson_ratio: 0.6"), "lower/poisson_ratio: 0.6"));
  EXPECT_TRUE(
      mentions(refusal("interface/work_of_adhesion: .nan"), "interface/work_of_adhesion: nan"));
  EXPECT_TRUE(
      mentions(refusal("interface/work_of_adhesion: .inf"), "interface/work_of_adhesion: inf"));
  EXPECT_TRUE(
      mentions(refusal("interface/work_of_adhesion: -.inf"), "interface/work_of_adhesion: -inf"));
  EXPECT_TRUE(mentions(refusal("scan/height_scale: 0"), "scan/height_scale: 0"));
  EXPECT_TRUE(
      mentions(refusal("scan/pitch_x: 1e-9"), "scan/pitch_x: 1e-09 m with scan/pitch_y 0 m"));
  EXPECT_TRUE(mentions(refusal("load/voltage: 5"), "interface/insulator_thickness: 0 m"));
  EXPECT_TRUE(mentions(refusal("{upper: {film_thickness: 2.0e-9, hamaker_constant: 2.6e-19}, "
                               "interface/hamaker_constant: 0}"),
                       "upper/film_thickness: 2e-09 m with interface/hamaker_constant 0 J"));
  EXPECT_TRUE(
      mentions(refusal("{load: {voltage: 5, max_voltage: 2}, interface/insulator_thickness: 1e-9}"),
               "load/voltage: 5 V is not allowed, must be in [-2, 2]"));
}

TEST(Configuration, AMeasuredCounterSurfaceSaysWhichWayItFaces) {
  for (const char* type : {"topic", "file"}) {
    const std::string stated = std::string("counter_surface: {file: upper.di, type: ") + type;
    const std::string refused = refusal(stated + "}");
    EXPECT_TRUE(mentions(refused, "counter_surface/facing: must be stated")) << refused;
    EXPECT_TRUE(mentions(refused, "up = its heights are as an instrument measures them"))
        << refused;
    EXPECT_TRUE(mentions(refused, "down = its heights are already those of the mounted surface"))
        << refused;
    for (const char* facing : {"up", "down"})
      EXPECT_NO_THROW(read(stated + ", facing: " + facing + "}"));
  }
  EXPECT_NO_THROW(read("counter_surface/type: gaussian")) << "drawn as it is mounted";
}

TEST(Configuration, CombinationsThatMeanNothingAreRefused) {
  EXPECT_TRUE(mentions(refusal("counter_surface/type: file"), "counter_surface/file: ''"));
  EXPECT_TRUE(
      mentions(refusal("output: {hurst_shortest_wavelength: 2e-7, hurst_longest_wavelength: 1e-7}"),
               "output/hurst_longest_wavelength: 1e-07 m"));
  EXPECT_TRUE(mentions(refusal("counter_surface/pose/tilt_x: 1.6"),
                       "counter_surface/pose/tilt_x: 1.6 rad"));
  EXPECT_TRUE(mentions(refusal("preprocessing/fill/max_fraction: 2"),
                       "preprocessing/fill/max_fraction: 2"));
  EXPECT_TRUE(
      mentions(refusal("resolution/min_contact_pixels: -1"), "resolution/min_contact_pixels: -1"));
}

TEST(Configuration, AllViolationsComeAtOnceAndEachOnce) {
  try {
    read("lower: {hardness: -1, youngs_modulus: x}\nload: {voltage: 5000}\nnonsense: 1");
    FAIL();
  } catch (const OptionsError& error) {
    const std::set<std::string> different(error.violations().begin(), error.violations().end());
    EXPECT_EQ(different.size(), error.violations().size());
    // hardness, modulus, voltage out of range, voltage without insulator, unknown key
    EXPECT_EQ(error.violations().size(), 5u) << error.what();
  }
}

TEST(Configuration, AKeyGivenTwiceIsRefused) {
  const std::string line = refusal("lower: {hardness: 1e9}\nlower/hardness: 2e9");
  EXPECT_TRUE(mentions(line, "lower/hardness: '2e9' is given beside '1e9'")) << line;
}

TEST(Configuration, ASectionGivenTwiceIsRefusedWithBothLines) {
  const std::string line = refusal(
      "preprocessing:\n  level: plane\nlower: {hardness: 1e9}\npreprocessing:\n  fill: {}\n");
  EXPECT_TRUE(mentions(line, "preprocessing: given in line 4 and before in line 1")) << line;
  const std::string inner = refusal("lower:\n  hardness: 1e9\n  hardness: 1e9\n");
  EXPECT_TRUE(mentions(inner, "lower/hardness: given in line 3 and before in line 2")) << inner;
}

TEST(Configuration, WhatReadersOfYamlTakeForDifferentNumbersIsRefused) {
  EXPECT_TRUE(mentions(refusal("lower: {hardness: 010}"), "lower/hardness: '010' is not allowed"));
  EXPECT_EQ(configurationFromYaml(YAML::Load("load: {max_voltage: 0.5}")).model.load.max_voltage,
            0.5);
}

TEST(Configuration, ADecimalCommaIsNamed) {
  EXPECT_TRUE(
      mentions(refusal("load:\n  max_voltage: 0,05\n"), "write 0.05: the decimal sign is a point"));
  EXPECT_TRUE(mentions(refusal("load: {max_voltage: 0,05}"), "is it behind a decimal comma?"));
}

TEST(Configuration, OtherTablesUseTheSameReader) {
  Configuration configuration;
  int queue_size = 10;
  const auto describe = [&](OptionVisitor& visitor) {
    configuration.describe(visitor);
    visitor.integer("queue_size", queue_size, Range::within(1, 100), "scans that may wait");
  };
  EXPECT_TRUE(readYaml(YAML::Load("{queue_size: 5, lower: {hardness: 1e9}}"), describe).empty());
  EXPECT_EQ(queue_size, 5);
  EXPECT_EQ(configuration.model.lower.hardness, 1e9);
  EXPECT_EQ(readYaml(YAML::Load("queue_sice: 5"), describe).size(), 1U);
  EXPECT_EQ(readYaml(YAML::Load("queue_size: 0"), describe).size(), 1U);
}

TEST(Configuration, PrintedConfigurationReadsBackTheSame) {
  Configuration configuration;
  configuration.model.lower.hardness = 1e9 / 3.0;
  configuration.model.formulation = "printed";
  configuration.scan.pitch_x = configuration.scan.pitch_y = 1e-9;
  const std::string text = toYaml(configuration);
  EXPECT_EQ(toYaml(read(text)), text);
  EXPECT_EQ(read(text).model.lower.hardness, 1e9 / 3.0);
  EXPECT_TRUE(mentions(text, "pitch_x: 1.0e-09  # [m]")) << text;
}

TEST(Configuration, NumbersAreWrittenSoThatYaml11TakesThemForNumbers) {
  EXPECT_EQ(yamlNumber(2e-9), "2.0e-09");
  EXPECT_EQ(yamlNumber(1.5e12), "1.5e+12");
  EXPECT_EQ(yamlNumber(0.25), "0.25");
  EXPECT_EQ(yamlNumber(-3.0), "-3");
  EXPECT_EQ(yamlNumber(std::nan("")), ".nan");
  EXPECT_EQ(yamlNumber(-HUGE_VAL), "-.inf");
}

TEST(Configuration, FileErrorsNameTheFile) {
  const ScratchFolder folder;
  EXPECT_THROW(loadConfiguration(folder.file("none.yaml")), FileError);
  EXPECT_THROW(loadConfiguration(folder.write("broken.yaml", "a: [1, 2")), FileError);
  const std::string path = folder.write("bad.yaml", "lower/hardness: -1\n");
  try {
    loadConfiguration(path);
    FAIL();
  } catch (const OptionsError& error) {
    EXPECT_EQ(std::string(error.what()).find(path + ": lower/hardness: -1"), 0u) << error.what();
  }
}

TEST(Configuration, RelativePathsGoByTheFolderOfTheFileThatStatesThem) {
  const ScratchFolder folder;
  const std::string path = folder.write("part.yaml",
                                        "counter_surface: {type: file, file: upper.npy, facing: "
                                        "up}\npreprocessing/region/mask_file: /whole/mask.png\n");
  Configuration defaults;
  defaults.preprocessing.region.polygon_file = "corners.txt";  // another source has stated it
  const Configuration configuration = loadConfiguration(path, defaults);
  EXPECT_EQ(configuration.counter_surface.file, folder.file("upper.npy"));
  EXPECT_EQ(configuration.preprocessing.region.mask_file, "/whole/mask.png");
  EXPECT_EQ(configuration.preprocessing.region.polygon_file, "corners.txt");
  EXPECT_EQ(read(toYaml(configuration)).counter_surface.file,
            folder.file("upper.npy"));  // wherever that is put
  try {
    const ScanPredictor predictor(loadConfiguration(
        folder.write("flat.yaml", "counter_surface: {type: file, file: upper.npy, facing: up}\n")));
    ADD_FAILURE();
  } catch (const OptionsError& error) {
    EXPECT_TRUE(mentions(error.what(), folder.file("upper.npy") + ": there is no such file"))
        << error.what();
  }
}

TEST(Configuration, WhatStatesNothingIsSaid) {
  const ScratchFolder folder;
  const auto warnings = [&](const std::string& text) {
    std::string lines;
    for (const std::string& line :
         settingsWarnings(loadConfiguration(folder.write("part.yaml", text))))
      lines += line;
    return lines;
  };
  const std::string path = folder.file("part.yaml");
  EXPECT_EQ(warnings(""), path + ": states nothing, the defaults hold");
  EXPECT_EQ(warnings("# load: {voltage: 5}\n"), path + ": states nothing, the defaults hold");
  EXPECT_EQ(warnings("interface:\n  # work_of_adhesion: 0.1\nlower: {hardness: 11e9}\n"),
            path + ": interface: has nothing below it, the defaults hold");
  EXPECT_EQ(warnings("{}"), "");
  EXPECT_EQ(warnings("interface: {}\n"), "");
  EXPECT_TRUE(settingsWarnings(loadConfiguration("/dev/null")).empty());
}

TEST(Configuration, EveryShippedFileLoads) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(MEMS_STICTION_CONFIG_DIR)) {
    // node.yaml holds what only the node knows: queues, diagnostics, display.
    // source_*.yaml is for scan_source.
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".yaml" || name == "node.yaml") continue;
    if (name.rfind("source_", 0) == 0) continue;
    EXPECT_NO_THROW(loadConfiguration(entry.path().string())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 5);
}

TEST(Configuration, TemplateHoldsEveryKeyWithItsDefault) {
  const std::string path = std::string(MEMS_STICTION_CONFIG_DIR) + "/stiction.yaml";
  KeyCollector described;
  Configuration configuration;
  configuration.describe(described);
  std::set<std::string> given;
  addKeys(YAML::LoadFile(path), "", given);
  EXPECT_EQ(given, described.keys);
  EXPECT_EQ(toYaml(loadConfiguration(path)), toYaml(Configuration()));
}

TEST(ScanPredictor, RefusedLoadNamesEachValueAndChangesNothing) {
  Configuration configuration;
  configuration.model.interface.insulator_thickness = 1e-7;
  configuration.model.load.voltage = 3.0;
  ScanPredictor predictor(configuration);
  Options options = configuration.model;
  options.load.voltage = 5.0;
  options.load.mechanical_load = 1e-6;
  predictor.setOptions(options);
  Options refused = options;
  refused.load.voltage = 2000.0;
  refused.load.mechanical_load = -1.0;
  try {
    predictor.setOptions(refused);
    FAIL();
  } catch (const OptionsError& error) {
    EXPECT_EQ(error.violations().size(), 2u);
    EXPECT_TRUE(mentions(error.what(), "load/voltage: 2000 V"));
    EXPECT_TRUE(mentions(error.what(), "load/mechanical_load: -1 N"));
  }
  refused.load.voltage = std::nan("");
  EXPECT_THROW(predictor.setOptions(refused), OptionsError);
  EXPECT_EQ(predictor.options().load.voltage, 5.0);
  EXPECT_EQ(predictor.options().load.mechanical_load, 1e-6);
  const HeightMap scan(cv::Mat::eye(8, 8, CV_64FC1) * 1e-9, 1e-8, 1e-8);
  const Prediction prediction = predictor.predict(scan);
  EXPECT_EQ(prediction.voltage, 5.0);
  EXPECT_EQ(prediction.mechanical_load, 1e-6);
}

TEST(ScanPredictor, NeedsTheCounterSurfaceThatIsConfigured) {
  Configuration configuration;
  configuration.counter_surface.type = CounterSurfaceType::kTopic;
  configuration.counter_surface.facing = CounterSurfaceFacing::kDown;
  ScanPredictor predictor(configuration);
  const HeightMap scan(cv::Mat::eye(8, 8, CV_64FC1) * 1e-9, 1e-8, 1e-8);
  EXPECT_THROW(predictor.predict(scan), SurfaceError);
  EXPECT_NO_THROW(predictor.predict(scan, HeightMap(cv::Mat::zeros(8, 8, CV_64FC1), 1e-8, 1e-8)));
  EXPECT_THROW(predictor.predict(scan, HeightMap(cv::Mat::zeros(8, 9, CV_64FC1), 1e-8, 1e-8)),
               SurfaceError);
}

TEST(ScanPredictor, LevelsWhenAsked) {
  cv::Mat heights(16, 16, CV_64FC1);
  for (int row = 0; row < 16; ++row) {
    for (int col = 0; col < 16; ++col)
      heights.at<double>(row, col) = 1e-9 * ((3 * row + 5 * col) % 7) + 2e-9 * col;
  }
  const HeightMap scan(heights, 1e-8, 1e-8);
  Configuration configuration;
  ScanPredictor plain(configuration);
  configuration.preprocessing.level.shape = LevelShape::kPlane;
  ScanPredictor levelling(configuration);
  // The tilt alone has an rms of 2 nm sqrt((16^2 - 1)/12) = 9.2 nm.
  EXPECT_GT(plain.predict(scan).rms_height, 8e-9);
  EXPECT_LT(levelling.predict(scan).rms_height, 3e-9);
}

TEST(ScanPredictor, BadConfigurationIsRefused) {
  Configuration configuration;
  configuration.scan.height_scale = 0.0;
  EXPECT_THROW(ScanPredictor{configuration}, OptionsError);
}

TEST(Configuration, ManyUnknownKeysAreNotAllNamedAndTakeNoTime) {
  std::string text = std::string(1000, 'x') + ": 1\n";  // YAML takes no longer keys
  for (int key = 0; key < 2000; ++key) text += "unknown_" + std::to_string(key) + ": 1\n";
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::string> lines;
  try {
    configurationFromYaml(YAML::Load(text));
  } catch (const OptionsError& error) {
    lines = error.violations();
  }
  // tenths of a second; ten times as long where each is compared with every known key
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_EQ(lines.size(), 101u);
  EXPECT_EQ(lines.back(), "1901 more keys are given that are no settings");
}

}  // namespace
}  // namespace mems_stiction
