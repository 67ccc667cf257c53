/// Every figure of the tables exists in the message, under its name and with its value.

#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "mems_stiction/prediction/prediction_fields.hpp"
#include "mems_stiction/ros/part_verdict_conversion.hpp"
#include "mems_stiction/ros/prediction_conversion.hpp"
#include "mems_stiction/verdict/part_verdict_fields.hpp"
#include "mems_stiction/verdict/regime_flags.hpp"
#include "mems_stiction/verdict/verdict_fields.hpp"

namespace mems_stiction {
namespace {

/// As ROS prints a value.
std::string text(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}
std::string text(const std::string& value) { return value; }
std::string text(bool value) { return value ? "1" : "0"; }
std::string text(int value) { return std::to_string(value); }
std::string text(std::uint32_t value) { return std::to_string(value); }
template <typename Enum>
std::string text(Enum value) {
  return std::to_string(static_cast<int>(value));
}

/// Gives every field a value of its own.
struct Fill {
  double next = 1.0;
  std::uint32_t next_count = 100;

  void operator()(const char*, double& value, const char*) { value = next += 0.5; }
  void operator()(const char*, int& value, const char*) { value = static_cast<int>(++next_count); }
  void operator()(const char*, std::uint32_t& value, const char*) { value = ++next_count; }
  void operator()(const char*, bool& value, const char*) { value = true; }
  void operator()(const char* name, std::string& value, const char*) { value = std::string("text of ") + name; }
  void operator()(const char*, Status& value, const char*) { value = Status::kBonded; }
  void operator()(const char*, BondingRegime& value, const char*) { value = BondingRegime::kAdherence; }
  void operator()(const char*, ContactTheory& value, const char*) { value = ContactTheory::kJkr; }
  void operator()(const char*, Sticks& value, const char*) { value = Sticks::kYes; }
};

TEST(PredictionMessage, HoldsEveryFieldOfTheTables) {
  PredictedScan scan;
  Fill fill;
  visitPredictionFields(scan.prediction, fill);
  visitRoughnessFields(scan.prediction.roughness, fill);
  visitSpatialRoughnessFields(scan.prediction.spatial_roughness, fill);
  visitVerdictFields(scan.verdict, fill);
  // the message has one field for it: the device's, which is the prediction's unless it was measured
  scan.prediction.apparent_work_of_adhesion = scan.verdict.apparent_work_of_adhesion;
  scan.preprocessing.tip_unreached_fraction = 0.125;
  scan.preprocessing.steps.resize(2);

  const StictionPrediction message = predictionMessage(scan, {});
  std::ostringstream stream;
  stream << message;
  std::set<std::string> lines;
  std::string line;
  for (std::istringstream reader(stream.str()); std::getline(reader, line);) lines.insert(line);

  int visited = 0;
  const auto expect = [&](const std::string& indent) {
    return [&, indent](const char* name, const auto& value, const char*) {
      EXPECT_TRUE(lines.count(indent + name + ": " + text(value))) << name << " " << text(value) << " in\n"
                                                                   << stream.str();
      ++visited;
    };
  };
  const PredictedScan& filled = scan;
  visitPredictionFields(filled.prediction, expect(""));
  visitRoughnessFields(filled.prediction.roughness, expect("  "));
  visitSpatialRoughnessFields(filled.prediction.spatial_roughness, expect("  "));
  visitVerdictFields(filled.verdict, expect(""));
  EXPECT_GT(visited, 70);
  EXPECT_EQ(message.tip_unreached_fraction, 0.125);
  EXPECT_EQ(message.preprocessing, recordLines(scan.preprocessing));
}

TEST(PartVerdictMessage, HoldsEveryFieldOfTheTables) {
  PredictedScan scan;
  Fill fill;
  scan.part.emplace();
  visitPartVerdictFields(
      *scan.part, [&](const std::string& name, auto& value, const char* unit) { fill(name.c_str(), value, unit); });
  scan.part->regime_flags = kBondedFlag | kBorderFlag;
  scan.part->warnings = {"first, second"};
  scan.provenance.part_id = "lot 3";
  scan.provenance.settings_hash = "with a pose";
  scan.pool_settings_hash = "without";

  const PartVerdict message = partVerdictMessage(*scan.part, {{}, scan.provenance, scan.pool_settings_hash});
  std::ostringstream stream;
  stream << message;
  std::set<std::string> lines;
  std::string line;
  for (std::istringstream reader(stream.str()); std::getline(reader, line);) lines.insert(line);
  int visited = 0;
  const PooledVerdict& filled = *scan.part;
  visitPartVerdictFields(filled, [&](const std::string& name, const auto& value, const char*) {
    EXPECT_TRUE(lines.count(name + ": " + text(value))) << name << " " << text(value) << " in\n" << stream.str();
    ++visited;
  });
  EXPECT_EQ(visited, 20);
  EXPECT_EQ(message.flags, (std::vector<std::string>{"bonded", "border"}));
  EXPECT_EQ(message.warnings, std::vector<std::string>{"first; second"});
  EXPECT_EQ(message.part_id, "lot 3");
  EXPECT_EQ(message.settings_hash, "without");
}

}  // namespace
}  // namespace mems_stiction
