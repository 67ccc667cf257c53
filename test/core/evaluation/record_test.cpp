#include "evaluation/record.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <type_traits>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "prediction/contact_solvers.hpp"
#include "prediction/prediction_fields.hpp"
#include "support/analytic_surfaces.hpp"

namespace mems_stiction {
namespace {

HeightMap scan() { return {cv::Mat::zeros(3, 4, CV_32FC1), 2e-9, 3e-9}; }

Prediction example() {
  Prediction prediction;
  prediction.status = Status::kBonded;
  prediction.pull_off_force = 1.0 / 3.0 * 1e-6;
  prediction.contact_area = 2e-12;
  prediction.adhesion_parameter = std::numeric_limits<double>::infinity();
  prediction.normalized_bonding_energy = std::numeric_limits<double>::quiet_NaN();
  prediction.bonding_regime = BondingRegime::kAdherence;
  prediction.contact_theory = ContactTheory::kJkr;
  prediction.asperity_count = 7;
  prediction.roughness.sq = 4e-9;
  return prediction;
}

std::set<std::string> fieldNames() {
  std::set<std::string> names;
  const Prediction prediction;
  visitPredictionFields(prediction, [&names](const Figure& figure, const auto&) {
    EXPECT_TRUE(names.insert(figure.name).second) << figure.name << " twice";
  });
  return names;
}

TEST(Record, HasItsWarningsInYamlAsInJson) {
  RecordExtras extras;
  extras.warnings = {"the pitch: is \"odd\"", "# and - so: {is this"};
  const YAML::Node record = YAML::Load(yamlRecord("scan.tiff", scan(), example(), extras));
  EXPECT_EQ(record["warnings"].as<std::vector<std::string>>(), extras.warnings);
  EXPECT_EQ(nlohmann::json::parse(jsonRecord("scan.tiff", scan(), example(), extras))["warnings"],
            extras.warnings);
  EXPECT_EQ(YAML::Load(yamlRecord("scan.tiff", scan(), example()))["warnings"].size(), 0U);
}

TEST(Record, HasTheFieldsThatScriptsRead) {
  const std::set<std::string> names = fieldNames();
  for (const char* name : {"status",
                           "voltage",
                           "mechanical_load",
                           "van_der_waals_force",
                           "electrostatic_force",
                           "normal_load",
                           "pull_off_force",
                           "pull_off_force_jkr",
                           "pull_off_force_transition",
                           "contact_area",
                           "contact_area_jkr",
                           "nominal_area",
                           "contact_fraction",
                           "approach",
                           "mean_gap",
                           "mechanical_energy",
                           "surface_energy",
                           "elastic_energy",
                           "total_energy",
                           "bonding_energy",
                           "normalized_bonding_energy",
                           "adhesion_parameter",
                           "bonding_regime",
                           "asperity_count",
                           "elastic_count",
                           "elasto_plastic_count",
                           "plastic_count",
                           "max_tilt",
                           "median_tabor_parameter",
                           "rms_height",
                           "invalid_fraction",
                           "processing_time"}) {
    EXPECT_EQ(names.count(name), 1u) << name;
  }
}

TEST(Record, YamlHoldsEveryFieldToTheLastBit) {
  RecordExtras extras;
  extras.channel = "0: ZSensor";
  const std::string text = yamlRecord("a \"b\": c.tiff", scan(), example(), extras);
  EXPECT_EQ(text.compare(0, 4, "---\n"), 0) << text;
  EXPECT_EQ(text.back(), '\n');
  const YAML::Node record = YAML::Load(text);
  for (const std::string& name : fieldNames()) EXPECT_TRUE(record[name].IsDefined()) << name;
  EXPECT_EQ(record["file"].as<std::string>(), "a \"b\": c.tiff");
  EXPECT_EQ(record["channel"].as<std::string>(), "0: ZSensor");
  EXPECT_EQ(record["rows"].as<int>(), 3);
  EXPECT_EQ(record["pitch_y"].as<double>(), 3e-9);
  EXPECT_EQ(record["status"].as<std::string>(), "BONDED");
  EXPECT_TRUE(record["is_lower_bound"].as<bool>());
  EXPECT_EQ(record["bonding_regime"].as<std::string>(), "ADHERENCE");
  EXPECT_EQ(record["contact_theory"].as<std::string>(), "JKR");
  EXPECT_EQ(record["pull_off_force"].as<double>(), example().pull_off_force);
  EXPECT_EQ(record["roughness"]["sq"].as<double>(), 4e-9);
  EXPECT_TRUE(std::isinf(record["adhesion_parameter"].as<double>()));
  EXPECT_TRUE(std::isnan(record["normalized_bonding_energy"].as<double>()));
  EXPECT_FALSE(record["energy_curve"].IsDefined());
}

TEST(Record, RecordsInARowAreYamlDocuments) {
  const std::string text = yamlRecord("a", scan(), example()) + yamlRecord("b", scan(), example());
  const std::vector<YAML::Node> documents = YAML::LoadAll(text);
  ASSERT_EQ(documents.size(), 2u);
  EXPECT_EQ(documents[1]["file"].as<std::string>(), "b");
  EXPECT_FALSE(documents[1]["channel"].IsDefined());
}

TEST(Record, JsonIsOneLineWithNullForWhatIsNotFinite) {
  const std::string text = jsonRecord("scan.tiff", scan(), example());
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const nlohmann::json record = nlohmann::json::parse(text);
  for (const std::string& name : fieldNames()) EXPECT_EQ(record.count(name), 1u) << name;
  EXPECT_EQ(record["status"], "BONDED");
  EXPECT_EQ(record["asperity_count"], 7);
  EXPECT_EQ(record["pull_off_force"].get<double>(), example().pull_off_force);
  EXPECT_TRUE(record["adhesion_parameter"].is_null());
  EXPECT_TRUE(record["normalized_bonding_energy"].is_null());
  EXPECT_EQ(record["roughness"]["sq"].get<double>(), 4e-9);
}

TEST(Record, FileNamesThatAreNotUtf8DoNotBreakJson) {
  EXPECT_NO_THROW(nlohmann::json::parse(jsonRecord("\xff\xfe.tiff", scan(), example())));
}

TEST(Record, EnergyCurveIsAListWhenThereIsOne) {
  Prediction prediction = example();
  prediction.energy_curve.resize(2);
  prediction.energy_curve[1].total_energy = 5e-15;
  const YAML::Node yaml = YAML::Load(yamlRecord("a", scan(), prediction));
  ASSERT_EQ(yaml["energy_curve"].size(), 2u);
  EXPECT_EQ(yaml["energy_curve"][1]["total_energy"].as<double>(), 5e-15);
  const nlohmann::json json = nlohmann::json::parse(jsonRecord("a", scan(), prediction));
  EXPECT_EQ(json["energy_curve"][1]["total_energy"].get<double>(), 5e-15);
}

TEST(Record, CurveIsAListWhenItIsAskedFor) {
  Prediction prediction = example();
  prediction.curve = {{-1e-10, 2e-7, false}, {-3e-10, 1e-7, true}};
  EXPECT_FALSE(YAML::Load(yamlRecord("a", scan(), prediction))["curve"].IsDefined());
  RecordExtras extras;
  extras.has_curve = true;
  const YAML::Node yaml = YAML::Load(yamlRecord("a", scan(), prediction, extras));
  ASSERT_EQ(yaml["curve"].size(), 2u);
  EXPECT_EQ(yaml["curve"][0]["displacement"].as<double>(), -1e-10);
  EXPECT_TRUE(yaml["curve"][1]["is_separation"].as<bool>());
  const nlohmann::json json = nlohmann::json::parse(jsonRecord("a", scan(), prediction, extras));
  EXPECT_EQ(json["curve"][1]["force"].get<double>(), 1e-7);
}

TEST(Record, FlagsAndFormulationAreThereWithoutADevice) {
  RecordExtras extras;
  extras.formulation = "separation_curve";
  const YAML::Node yaml = YAML::Load(yamlRecord("a", scan(), example(), extras));
  EXPECT_EQ(yaml["formulation"].as<std::string>(), "separation_curve");
  EXPECT_EQ(yaml["regime_flags"].as<unsigned>() & 1u, 1u) << "bonded";
  EXPECT_EQ(yaml["regime_flag_names"].as<std::string>().substr(0, 6), "bonded");
  EXPECT_FALSE(yaml["sticks"].IsDefined());
}

TEST(Record, leavesOutWhatTheFormulationDoesNotHave) {
  const HeightMap surface = analytic::paraboloid(41, 41, 10e-9, 10e-9, 1e-6);
  const std::set<std::string> of_scan = {"tip_limit", "needed_pitch", "unresolved_height",
                                         "unresolved_limit"};
  for (const std::string& formulation : formulationNames()) {
    Options options;
    options.formulation = formulation;
    const Prediction prediction = AdhesionModel(options).predict(surface);
    RecordExtras extras;
    extras.formulation = formulation;
    extras.convergence.emplace_back();
    const YAML::Node record = YAML::Load(yamlRecord("a", surface, prediction, extras));
    const bool has_caps = formulation != kDefaultFormulation;
    EXPECT_EQ(record["convergence"][0]["contact_area_jkr"].IsDefined(), has_caps) << formulation;
    visitPredictionFields(prediction, [&](const Figure& figure, const auto& value) {
      const std::string name = figure.name;
      const bool has_it = hasFigure(formulation, name);
      EXPECT_EQ(record[name].IsDefined(), has_it) << formulation << ": " << name;
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
        const bool may_be_nan = has_caps || of_scan.count(name) > 0;
        EXPECT_TRUE(has_it ? may_be_nan || !std::isnan(value) : !(value > 0.0))
            << formulation << ": " << name << " " << value;
      }
    });
    EXPECT_EQ(record["pull_off_force_jkr"].IsDefined(), has_caps) << formulation;
    EXPECT_EQ(has_caps, prediction.pull_off_force_jkr > 0.0) << formulation;
  }
}

TEST(Record, VerdictHasItsFieldsOnceBesideThoseOfTheScan) {
  RecordExtras extras;
  extras.verdict.emplace();
  extras.verdict->sticks = Sticks::kYes;
  extras.verdict->margin = 0.25;
  extras.verdict->device_apparent_work_of_adhesion = 3e-3;
  const std::string text = yamlRecord("a", scan(), example(), extras);
  const YAML::Node yaml = YAML::Load(text);
  EXPECT_EQ(yaml["sticks"].as<std::string>(), "yes");
  EXPECT_EQ(yaml["margin"].as<double>(), 0.25);
  EXPECT_EQ(yaml["device_apparent_work_of_adhesion"].as<double>(), 3e-3);
  const YAML::Node without = YAML::Load(yamlRecord("a", scan(), example(), {}));
  EXPECT_EQ(yaml["apparent_work_of_adhesion"].as<std::string>(),
            without["apparent_work_of_adhesion"].as<std::string>());
  EXPECT_EQ(text.find("regime_flags:"), text.rfind("regime_flags:"));
  EXPECT_EQ(nlohmann::json::parse(jsonRecord("a", scan(), example(), extras))["sticks"], "yes");
}

}  // namespace
}  // namespace mems_stiction
