/// predict_scan --sweep-voltage: rows, table, and what it refuses. The figures to the bit:
/// test/python/test_module_runs.py.

#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "mems_stiction/verdict/device_options.hpp"
#include "support/predict_scan_program.hpp"

namespace mems_stiction {
namespace {

class PredictScanSweep : public PredictScan {
 protected:
  /// A cantilever with a pad of the size of the scan; its electrode has this length.
  std::string beam(const std::string& electrode_length, const std::string& more = "") const {
    return folder_.write(
        "beam.yaml",
        "interface: {insulator_thickness: 100e-9}\n"
        "device: {beam_type: cantilever, beam_length: 300e-6, beam_width: 20e-6, beam_thickness: "
        "2e-6, "
        "beam_gap: 2e-6, beam_modulus: 160e9, contact_area: 4.08e-12, electrode_start: 50e-6, "
        "electrode_length: " +
            electrode_length + more + "}\n");
  }

  Outcome sweep(const std::string& arguments) const {
    return run("--all --pitch 20e-9 --config " + folder_.file("beam.yaml") + " " + arguments + " " +
               sphere());
  }
};

TEST_F(PredictScanSweep, HasItsRowsInTheRecordAndInATable) {
  beam("150e-6");
  const Outcome outcome = sweep("--sweep-voltage 0:20:5");
  ASSERT_EQ(outcome.status, 0);
  const YAML::Node record = YAML::Load(outcome.output)["sweep"];
  const double pull_in = record["pull_in_voltage"].as<double>();
  EXPECT_GT(pull_in, 10.0);
  EXPECT_LT(pull_in, 20.0);
  ASSERT_EQ(record["points"].size(), 9U);
  ASSERT_EQ(record["summaries"].size(), 1U);
  std::size_t line = outcome.output.find("# way ");
  ASSERT_NE(line, std::string::npos);
  for (const YAML::Node& point : record["points"]) {
    const double voltage = point["voltage"].as<double>();
    const bool is_up = point["direction"].as<std::string>() == "up";
    if (is_up) {
      EXPECT_EQ(point["lands"].as<std::string>(), voltage >= pull_in ? "yes" : "no");
    }
    EXPECT_FALSE(point["sticks"].as<std::string>().empty());
    line = outcome.output.find('\n', line) + 1;
    std::istringstream shown(outcome.output.substr(line, outcome.output.find('\n', line) - line));
    std::string mark, way, lands;
    double of_table = -1.0, load = -1.0;
    shown >> mark >> way >> of_table >> load >> lands;
    EXPECT_EQ(way, is_up ? "up" : "down");
    EXPECT_EQ(of_table, voltage);
    EXPECT_EQ(lands, point["lands"].as<std::string>());
  }
}

TEST_F(PredictScanSweep, SweepsLoadsByThemselvesAndWithVoltages) {
  beam("0.0");
  const auto points = [&](const std::string& arguments) {
    const Outcome outcome = sweep("--json " + arguments);
    EXPECT_EQ(outcome.status, 0);
    return nlohmann::json::parse(outcome.output)["sweep"];
  };
  const nlohmann::json of_loads = points("--voltage 5 --sweep-load 0,1e-7,2e-7");
  ASSERT_EQ(of_loads["points"].size(), 3U);
  EXPECT_EQ(of_loads["points"][2]["voltage"], 5.0);
  EXPECT_EQ(of_loads["points"][2]["mechanical_load"], 2e-7);
  EXPECT_EQ(of_loads["points"][2]["lands"], "unknown");
  EXPECT_EQ(of_loads["pull_in_reason"], "device/electrode_length");
  EXPECT_EQ(points("--sweep-voltage 0,5 --sweep-load 0:3e-7:1e-7")["points"].size(), 12U);
  EXPECT_EQ(points("--load 3e-7 --sweep-voltage 5")["points"][0]["mechanical_load"], 3e-7);
}

TEST_F(PredictScanSweep, RefusesWhatCannotBeSweptBeforeTheScan) {
  beam("150e-6");
  for (const auto& [arguments, why] : std::vector<std::pair<std::string, std::string>>{
           {"--sweep-voltage 0:30", "--sweep-voltage: '0:30' is not allowed, must be numbers"},
           {"--sweep-voltage ''", "--sweep-voltage: '' is not allowed, must be numbers"},
           {"--sweep-voltage 0,05", "the decimal sign is a point"},
           {"--sweep-voltage 0,5,", "must be numbers with commas between"},
           {"--sweep-voltage 0:nan:5", "must be numbers with commas between"},
           {"--sweep-voltage 30:0:1",
            "nothing lies from 30 up to 0; the way down follows by itself"},
           {"--sweep-voltage 0:30:0", "the step must be > 0"},
           {"--sweep-voltage 0:1:1e-9", "more than 10000 numbers"},
           {"--sweep-voltage 0:1:0.001 --sweep-load 0:1e-6:1e-7",
            "22011 rows, up and down, are not allowed, must be <= 10000"},
           {"--sweep-voltage 5,5", "--sweep-voltage: 5 V after 5 V is not allowed, must ascend"},
           {"--sweep-voltage 0:9000:1000", "--sweep-voltage: 9000 V is not allowed"},
           {"--sweep-load -1e-6:0:1e-7",
            "--sweep-load: -1e-06 N is not allowed, must be >= 0 N"}}) {
    const Outcome outcome = sweep(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    ASSERT_EQ(outcome.errors.size(), 1U) << arguments;
    EXPECT_NE(outcome.errors[0].find(why), std::string::npos) << outcome.errors[0];
    EXPECT_TRUE(outcome.output.empty());
  }
  beam("150e-6", ", electrode_area: 3e-9");
  const Outcome outcome = sweep("--sweep-voltage 0:20:5");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.errors.at(0).find(
                "device/electrode_area: 3e-09 m^2 is not allowed for a beam without a spring"),
            std::string::npos);
}

}  // namespace
}  // namespace mems_stiction
