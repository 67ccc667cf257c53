/// Every figure of the tables exists in its message, under its name, with its unit and with its
/// value.

#include <map>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "half_space/half_space_fields.hpp"
#include "prediction/prediction_fields.hpp"
#include "ros/half_space_conversion.hpp"
#include "ros/message_fields.hpp"
#include "ros/prediction_conversion.hpp"
#include "ros/station_conversion.hpp"
#include "station/station_fields.hpp"
#include "verdict/part_verdict_fields.hpp"
#include "verdict/regime_flags.hpp"
#include "verdict/verdict_fields.hpp"

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

/// Visitor: each figure stands in a message as ROS prints it, with its value.
class InPrint {
 public:
  template <typename Message>
  explicit InPrint(const Message& message) {
    std::ostringstream stream;
    stream << "\n" << message;
    print_ = stream.str();
  }

  template <typename Value>
  void operator()(const Figure& figure, const Value& value) {
    const std::string line = std::string(figure.name) + ": " + text(value) + "\n";
    EXPECT_TRUE(print_.find("\n" + line) != std::string::npos ||
                print_.find("\n  " + line) != std::string::npos)
        << line << " in " << print_;
    ++seen;
  }

  int seen = 0;

 private:
  std::string print_;
};

/// Gives every field a value of its own.
struct Fill {
  double next = 1.0;
  std::uint32_t next_count = 100;

  void operator()(const Figure&, double& value) { value = next += 0.5; }
  void operator()(const Figure&, int& value) { value = static_cast<int>(++next_count); }
  void operator()(const Figure&, std::uint32_t& value) { value = ++next_count; }
  void operator()(const Figure&, bool& value) { value = true; }
  void operator()(const Figure&, const bool& /*value*/) {}  // follows from other fields
  void operator()(const Figure& figure, std::string& value) {
    value = std::string("text of ") + figure.name;
  }
  void operator()(const Figure&, Status& value) { value = Status::kBonded; }
  void operator()(const Figure&, Regime& value) { value = Regime::kPlastic; }
  void operator()(const Figure&, BondingRegime& value) { value = BondingRegime::kAdherence; }
  void operator()(const Figure&, ContactTheory& value) { value = ContactTheory::kJkr; }
  void operator()(const Figure&, Sticks& value) { value = Sticks::kYes; }
};

TEST(PredictionMessage, HoldsEveryFieldOfTheTables) {
  PredictedScan scan;
  Fill fill;
  visitPredictionFields(scan.prediction, fill);
  visitRoughnessFields(scan.prediction.roughness, fill);
  visitSpatialRoughnessFields(scan.prediction.spatial_roughness, fill);
  visitVerdictFields(scan.verdict, fill);
  scan.preprocessing.tip_unreached_fraction = 0.125;
  scan.preprocessing.steps.resize(2);

  const StictionPrediction message = predictionMessage(scan, {});
  InPrint print(message);
  const PredictedScan& filled = scan;
  visitPredictionFields(filled.prediction, print);
  visitRoughnessFields(filled.prediction.roughness, print);
  visitSpatialRoughnessFields(filled.prediction.spatial_roughness, print);
  visitVerdictFields(filled.verdict, print);
  EXPECT_GT(print.seen, 70);
  EXPECT_EQ(message.tip_unreached_fraction, 0.125);
  EXPECT_EQ(message.preprocessing, recordLines(scan.preprocessing));
}

TEST(Summary, CountsContactsInWords) {
  PredictedScan scan;
  scan.prediction.has_asperities = true;
  for (const auto& [count, words] : {std::make_pair(1, "; 1 contact"), {2, "; 2 contacts"}}) {
    scan.prediction.asperity_count = count;
    const std::string line = summaryOf(scan);
    const std::size_t place = line.find("; " + std::to_string(count) + " contact");
    ASSERT_NE(place, std::string::npos) << line;
    EXPECT_EQ(line.substr(place, line.find(';', place + 1) - place), words);
  }
}

TEST(AsperityMessage, HoldsEveryFieldOfTheTable) {
  Prediction prediction;
  prediction.asperities.resize(3);
  Fill fill;
  for (Asperity& asperity : prediction.asperities) visitAsperityFields(asperity, fill);
  const AsperityArray message = asperitiesMessage(prediction, {});
  ASSERT_EQ(message.asperities.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    InPrint print(message.asperities[i]);
    visitAsperityFields(prediction.asperities[i], [&](const Figure& figure, const auto& value) {
      if (std::string("is_at_border") != figure.name) print(figure, value);
    });
    EXPECT_EQ(print.seen, 12);
  }
}

/// Field to what the definition of a message says behind it.
template <typename Message>
std::map<std::string, std::string> commentsOf() {
  std::map<std::string, std::string> comments;
  std::istringstream lines(ros::message_traits::Definition<Message>::value());
  std::string name;
  for (std::string line; std::getline(lines, line) && line.compare(0, 2, "==") != 0;) {
    const std::vector<std::string> names = fieldNames(line);
    if (!names.empty()) name = names[0];
    if (!names.empty() || line[0] == ' ') comments[name] += line;
  }
  return comments;
}

/// Visitor: each figure has its field, and the unit behind it, "[-]" for a number without one.
class InDefinition {
 public:
  explicit InDefinition(std::map<std::string, std::string> comments)
      : comments_(std::move(comments)) {}

  template <typename Value>
  void operator()(const Figure& figure, const Value& /*value*/) {
    if (without_.count(figure.name) > 0) {
      EXPECT_EQ(comments_.count(figure.name), 0u) << figure.name;
      return;
    }
    ASSERT_EQ(comments_.count(figure.name), 1u) << figure.name << " has no field";
    const std::string unit =
        *figure.unit == '\0' && std::is_same_v<Value, double> ? "-" : figure.unit;
    ++seen;
    if (unit.empty()) return;
    EXPECT_NE(comments_[figure.name].find("[" + unit + "]"), std::string::npos) << figure.name;
  }

  int seen = 0;

 private:
  std::map<std::string, std::string> comments_;
  const std::set<std::string> without_ = {"is_at_border", "rest_force", "residual",
                                          "state_count"};  // Python's alone
};

TEST(Definitions, haveAFieldForEachFigureWithItsUnit) {
  const PredictedScan scan;
  const Asperity contact;
  const SeparationCurvePoint of_curve;
  const PooledVerdict pooled;
  InDefinition prediction(commentsOf<StictionPrediction>());
  visitPredictionFields(scan.prediction, prediction);
  visitVerdictFields(scan.verdict, prediction);
  visitProvenanceFields(scan.provenance, prediction);
  EXPECT_GT(prediction.seen, 70);
  InDefinition roughness(commentsOf<RoughnessStatistics>()),
      spatial(commentsOf<SpatialRoughnessStatistics>());
  visitRoughnessFields(scan.prediction.roughness, roughness);
  visitSpatialRoughnessFields(scan.prediction.spatial_roughness, spatial);
  EXPECT_EQ(roughness.seen + spatial.seen, 18);
  InDefinition asperity(commentsOf<AsperityContact>()), point(commentsOf<SeparationPoint>());
  visitAsperityFields(contact, asperity);
  visitSeparationPointFields(of_curve, point);
  EXPECT_EQ(asperity.seen + point.seen, 15);
  InDefinition part(commentsOf<PartVerdict>()), half_space(commentsOf<HalfSpaceSolution>());
  visitPartVerdictFields(pooled, [&](const Figure& figure, const auto& value) {
    if (figure.name != std::string("governed_by")) part(figure, value);  // recordings lack it
  });
  visitHalfSpaceFields({}, half_space);
  visitHalfSpaceDetails({}, half_space);
  EXPECT_EQ(part.seen + half_space.seen, 46);
  InDefinition sweep(commentsOf<SweepPoint>()), summary(commentsOf<SweepSummary>()),
      cycle(commentsOf<CyclePoint>());
  visitSweepFields({}, sweep);
  visitSummaryFields({}, summary);
  visitCycleFields({}, cycle);
  EXPECT_EQ(sweep.seen + summary.seen + cycle.seen, 55);
}

TEST(PartVerdictMessage, HoldsEveryFieldOfTheTables) {
  PredictedScan scan;
  Fill fill;
  scan.part.emplace();
  visitPartVerdictFields(*scan.part, fill);
  scan.part->regime_flags = kBondedFlag | kBorderFlag;
  scan.part->warnings = {"first, second"};
  scan.provenance.part_id = "lot 3";
  scan.provenance.settings_hash = "with a pose";
  scan.pool_settings_hash = "without";

  const PartVerdict message =
      partVerdictMessage(*scan.part, {{}, scan.provenance, scan.pool_settings_hash});
  InPrint print(message);
  const PooledVerdict& filled = *scan.part;
  visitPartVerdictFields(filled, [&](const Figure& figure, const auto& value) {
    if (figure.name != std::string("governed_by")) print(figure, value);  // recordings lack it
  });
  EXPECT_EQ(print.seen, 24);
  EXPECT_EQ(message.flags, (std::vector<std::string>{"bonded", "border"}));
  EXPECT_EQ(message.warnings, std::vector<std::string>{"first; second"});
  EXPECT_EQ(message.part_id, "lot 3");
  EXPECT_EQ(message.settings_hash, "without");
}

}  // namespace
}  // namespace mems_stiction
