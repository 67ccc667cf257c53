/// The half-space's message holds what was solved, and no figure where nothing was.

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "../support/message_cases.hpp"
#include "half_space/half_space_fields.hpp"
#include "ros/half_space_conversion.hpp"
#include "ros/message_parts.hpp"

namespace mems_stiction {
namespace {

SolvedHalfSpace solvedWithCurve(int points) {
  SolvedHalfSpace solved;
  solved.status = HalfSpaceStatus::kSolved;
  solved.pull_off_force = 2e-7;
  solved.pull_off_height = 3e-10;
  solved.contact_area = 4e-16;
  solved.contact_count = 7;
  for (int i = 0; i < points; ++i) {
    ForcePoint point;
    point.height = 1e-9 - 2e-9 * i / points;
    point.force = i == points / 3 ? 2e-7 : 1e-7 * std::sin(0.001 * i);
    solved.approach.push_back(point);
    point.height = -point.height;
    solved.retraction.push_back(point);
  }
  return solved;
}

using mems_stiction::text;
std::string text(bool value) { return value ? "1" : "0"; }
std::string text(int value) { return std::to_string(value); }
std::string text(HalfSpaceStatus value) { return std::to_string(static_cast<int>(value)); }

TEST(HalfSpaceMessage, HoldsEveryFieldOfTheRecord) {
  SolvedHalfSpace solved = solvedWithCurve(10);
  solved.status = HalfSpaceStatus::kNotConverged;
  solved.message = "a sentence";
  solved.contact_fraction = 0.25;
  solved.mean_gap = 1.5e-9;
  solved.work_of_adhesion = 0.001;
  solved.hysteresis = 0.002;
  solved.is_converged = solved.is_resolved = true;
  solved.newton_steps = 111;
  solved.processing_time = 0.5;
  std_msgs::Header header;
  header.frame_id = "stage";
  const HalfSpaceSolution message = halfSpaceMessage(solved, someLoad(), header);
  const std::set<std::string> lines = linesOf(message);
  int visited = 0;
  visitHalfSpaceFields(solved, [&](const Figure& figure, const auto& value) {
    EXPECT_TRUE(lines.count(std::string(figure.name) + ": " + text(value)))
        << figure.name << " in\n"
        << message;
    ++visited;
  });
  EXPECT_EQ(visited, 12);
  EXPECT_EQ(message.header.frame_id, "stage");
  EXPECT_EQ(message.message, "a sentence");
  EXPECT_EQ(message.voltage, 3.0);
  EXPECT_EQ(message.mechanical_load, 2e-6);
  EXPECT_EQ(message.contact_count, 7);

  const std::vector<CurvePoint> curve = curveOf(solved);
  ASSERT_EQ(message.curve.size(), curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    EXPECT_EQ(message.curve[i].height, curve[i].height);
    EXPECT_EQ(message.curve[i].force, curve[i].force);
    EXPECT_EQ(message.curve[i].direction, static_cast<int>(curve[i].direction));
  }
}

TEST(HalfSpaceMessage, HoldsTheVerdictWithWhoJudged) {
  Verdict verdict = someVerdict();
  verdict.judge = Judge::kHalfSpace;
  HalfSpaceSolution message = halfSpaceMessage(solvedWithCurve(10), someLoad(), {});
  EXPECT_EQ(message.sticks, 3);
  EXPECT_EQ(message.reason + message.verdict_by, "");
  EXPECT_TRUE(std::isnan(message.margin) && std::isnan(message.peel_number_upper));
  fillVerdict(verdict, message);
  EXPECT_EQ(message.sticks, 2);
  EXPECT_EQ(message.reason,
            "two; lines; 95 %");  // commas would be fields for rostopic echo -p
  EXPECT_EQ(message.verdict_by, "half_space");
  EXPECT_EQ((std::vector<double>{message.margin, message.margin_lower, message.margin_upper}),
            (std::vector<double>{0.5, 0.4, 0.6}));
  EXPECT_EQ((std::vector<double>{message.peel_number, message.peel_number_lower,
                                 message.peel_number_upper}),
            (std::vector<double>{5.0, 4.0, 6.0}));
}

TEST(HalfSpaceMessage, ALongCurveKeepsItsEndsAndItsLargestForce) {
  for (const int points : {4096, 4097, 8190, 8191, 100000}) {
    const SolvedHalfSpace solved = solvedWithCurve(points);
    const HalfSpaceSolution message = halfSpaceMessage(solved, someLoad(), {});
    ASSERT_LE(message.curve.size(), 2 * kMostCurvePoints) << points;
    ASSERT_GT(message.curve.size(), kMostCurvePoints / 2)
        << points;  // a stride of 2 halves the shortest that is too long
    EXPECT_EQ(message.curve.front().height, solved.approach.front().height);
    EXPECT_EQ(message.curve.back().height, solved.retraction.back().height);
    int largest = 0;
    for (const HalfSpacePoint& point : message.curve) largest += point.force == 2e-7 ? 1 : 0;
    EXPECT_EQ(largest, 2) << points;
  }
}

TEST(HalfSpaceMessage, ARefusalHasNoFigures) {
  const HalfSpaceSolution message = refusedMessage("two\nlines", someLoad(), {});
  EXPECT_EQ(message.status, HalfSpaceSolution::REFUSED);
  EXPECT_EQ(message.message, "two; lines");
  for (const double figure :
       {message.pull_off_force, message.pull_off_uncertainty, message.pull_off_height,
        message.apparent_work_of_adhesion, message.adhesion_hysteresis, message.rest_height,
        message.contact_area, message.contact_fraction, message.mean_gap, message.flowed_volume,
        message.cohesive_length, message.range, message.processing_time,
        message.pull_off_force_under_voltage}) {
    EXPECT_TRUE(std::isnan(figure));
  }
  EXPECT_EQ(message.contact_count, -1);
  EXPECT_FALSE(message.is_converged || message.is_resolved || message.is_step_converged);
  EXPECT_TRUE(message.curve.empty());
}

}  // namespace
}  // namespace mems_stiction
