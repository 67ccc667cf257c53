/// The message of a device holds what was found and judged, and no figure where nothing was.

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/message_cases.hpp"
#include "device/device_force_fields.hpp"
#include "ros/awaited_scans.hpp"
#include "ros/device_force_conversion.hpp"
#include "ros/device_verdict_topic.hpp"

namespace mems_stiction {
namespace {

TEST(DeviceMessage, HoldsEveryFigure) {
  DeviceForce force;
  double next = 1.25;
  visitDeviceForceFields(force, [&](const Figure&, auto& value) {
    value = static_cast<std::decay_t<decltype(value)>>(next);
    next += 1.0;
  });
  force.realisations = {{2e-7, 0.1, 4, 1e-9}, {3e-7, 0.1, 4, 1e-9}};
  force.warnings = {"measure a field of 40 um, pixels of 100 nm will do"};
  std_msgs::Header header;
  header.frame_id = "stage";
  const DeviceAdhesion message = deviceMessage(force, someLoad(), header);
  const std::set<std::string> lines = linesOf(message);
  visitDeviceForceFields(force, [&](const Figure& figure, const auto& value) {
    EXPECT_TRUE(lines.count(std::string(figure.name) + ": " + text(static_cast<double>(value))))
        << figure.name << " in\n"
        << message;
  });
  EXPECT_EQ(message.status, DeviceAdhesion::FOUND);
  EXPECT_EQ(message.header.frame_id, "stage");
  EXPECT_EQ(message.voltage, 3.0);
  EXPECT_EQ(message.mechanical_load, 2e-6);
  EXPECT_EQ(message.realisations, (std::vector<double>{2e-7, 3e-7}));
  // commas would be fields for rostopic echo -p
  EXPECT_EQ(message.warnings,
            std::vector<std::string>{"measure a field of 40 um; pixels of 100 nm will do"});
  EXPECT_EQ(message.sticks, static_cast<int>(Sticks::kUnknown));
  EXPECT_EQ(message.reason + message.verdict_by, "");
}

TEST(DeviceMessage, HoldsTheVerdict) {
  DeviceAdhesion message = deviceMessage(DeviceForce(), someLoad(), {});
  fillVerdict(someVerdict(), message);
  EXPECT_EQ(message.sticks, 2);
  EXPECT_EQ(message.reason, "two; lines; 95 %");
  EXPECT_EQ(message.verdict_by, "prediction");
  EXPECT_EQ((std::vector<double>{message.restoring_force, message.margin, message.margin_lower,
                                 message.margin_upper}),
            (std::vector<double>{1e-6, 0.5, 0.4, 0.6}));
  EXPECT_EQ((std::vector<double>{message.peel_number, message.peel_number_lower,
                                 message.peel_number_upper}),
            (std::vector<double>{5.0, 4.0, 6.0}));
}

TEST(DeviceMessage, ARefusalHasNoFigures) {
  const DeviceAdhesion message = refusedDevice("two\nlines", someLoad(), {});
  EXPECT_EQ(message.status, DeviceAdhesion::REFUSED);
  EXPECT_EQ(message.message, "two; lines");
  for (const double figure :
       {message.pull_off_force, message.pull_off_force_lower, message.apparent_work_of_adhesion,
        message.linear_pull_off_force, message.contacts, message.separation_at_rest, message.area,
        message.pitch, message.force_deviation, message.processing_time, message.restoring_force,
        message.margin}) {
    EXPECT_TRUE(std::isnan(figure));
  }
  EXPECT_TRUE(message.realisations.empty() && message.warnings.empty());
}

DeviceAnswer answerOn(std::uint64_t scan, const std::string& part, double margin,
                      bool is_by_device_force = false) {
  DeviceAnswer answer;
  answer.last.id = scan;
  answer.last.provenance.part_id = part;
  answer.verdict = someVerdict();
  answer.verdict->margin = margin;
  answer.is_by_device_force = is_by_device_force;
  return answer;
}

std::vector<double> marginsOf(const std::vector<DeviceVerdict>& messages) {
  std::vector<double> margins;
  for (const DeviceVerdict& message : messages) margins.push_back(message.margin);
  return margins;
}

TEST(DeviceVerdicts, TheNewestScansAnswerIsTheLastOneAfterALateOneToo) {
  DeviceVerdicts verdicts;
  EXPECT_EQ(marginsOf(verdicts.answer(answerOn(1, "", 1.0), {false, true}, true)),
            std::vector<double>{1.0});
  EXPECT_EQ(marginsOf(verdicts.answer(answerOn(2, "", 2.0), {true, false}, true)),
            std::vector<double>{2.0});
  const std::vector<DeviceVerdict> late = verdicts.answer(answerOn(1, "", 1.5), {}, false);
  EXPECT_EQ(marginsOf(late), (std::vector<double>{1.5, 2.0}));
  EXPECT_TRUE(late.front().is_final && !late.back().is_final);
  const std::vector<DeviceVerdict> found = verdicts.answer(answerOn(2, "", 2.5, true), {}, true);
  EXPECT_EQ(marginsOf(found), std::vector<double>{2.5});
  EXPECT_EQ(marginsOf(verdicts.answer(answerOn(1, "", 1.7), {}, false)),
            (std::vector<double>{1.7, 2.5}));
}

TEST(DeviceVerdicts, AnAnswerThatNeverCameIsSaidOnlyIfItWasAwaited) {
  DeviceVerdicts verdicts;
  verdicts.answer(answerOn(1, "", 1.0), {true, true}, true);
  DeviceAnswer none = answerOn(1, "", 0.0);
  none.verdict.reset();
  EXPECT_TRUE(verdicts.answer(none, {true, true}, true).empty());
  const std::vector<DeviceVerdict> again = verdicts.answer(none, {true, false}, true);
  ASSERT_EQ(marginsOf(again), std::vector<double>{1.0});
  EXPECT_EQ(again.front().waits_for, "device_force");
  none.last.id = 7;
  EXPECT_TRUE(verdicts.answer(none, {}, false).empty());
}

TEST(DeviceVerdicts, AnOvertakenScanStaysProvisional) {
  DeviceVerdicts verdicts;
  verdicts.answer(answerOn(1, "a", 1.0), {false, true, false}, true);
  verdicts.answer(answerOn(2, "a", 2.0), {false, true, false}, true);
  DeviceAnswer late = answerOn(1, "a", 1.5);
  EXPECT_FALSE(verdicts.answer(late, {false, false, true}, false).front().is_final);
  late.verdict.reset();
  EXPECT_TRUE(verdicts.answer(late, {false, false, true}, false).empty());
  DeviceAnswer newest = answerOn(2, "a", 0.0);
  newest.verdict.reset();
  const std::vector<DeviceVerdict> final = verdicts.answer(newest, {}, true);
  ASSERT_EQ(marginsOf(final), std::vector<double>{2.0});
  EXPECT_TRUE(final.front().is_final);
}

TEST(AwaitedScans, AreThoseOfThePartUntilEachAnswerIsTaken) {
  const ScanOfPart first = answerOn(1, "a", 1.0).last;
  const ScanOfPart newer = answerOn(2, "a", 1.0).last;
  const ScanOfPart lone = answerOn(3, "", 1.0).last;
  AwaitedScans awaited;
  for (const ScanOfPart& scan : {first, first, lone}) awaited.add(scan);
  EXPECT_TRUE(awaited.has(newer) && awaited.has(lone));
  EXPECT_FALSE(awaited.has(answerOn(4, "b", 1.0).last) || awaited.has(answerOn(5, "", 1.0).last));
  awaited.remove(newer);  // never offered
  awaited.remove(lone);
  awaited.remove(first);
  EXPECT_TRUE(awaited.has(newer)) << "it was offered twice";
  awaited.remove(first);
  EXPECT_FALSE(awaited.has(newer) || awaited.has(first) || awaited.has(lone));
}

/// A frame says less than the device's own force: of an earlier scan of the part, too, whichever
/// part was scanned since.
TEST(DeviceVerdicts, KnowWhetherAPartWasJudgedByTheForceOfTheDevice) {
  DeviceVerdicts verdicts;
  const DeviceAnswer first = answerOn(1, "a", 1.0);
  verdicts.answer(first, {}, true);
  EXPECT_FALSE(verdicts.isByDeviceForce(first.last));
  verdicts.answer(answerOn(2, "a", 2.0, true), {}, true);
  EXPECT_TRUE(verdicts.isByDeviceForce(first.last));
  verdicts.answer(answerOn(3, "b", 3.0), {}, true);
  EXPECT_TRUE(verdicts.isByDeviceForce(first.last));
  EXPECT_FALSE(verdicts.isByDeviceForce(answerOn(3, "b", 3.0).last));
  verdicts.answer(answerOn(4, "a", 4.0), {true, false}, true);
  EXPECT_FALSE(verdicts.isByDeviceForce(first.last)) << "its newest scan is not judged so yet";
  verdicts.answer(answerOn(5, "", 5.0, true), {}, true);
  EXPECT_TRUE(verdicts.isByDeviceForce(answerOn(5, "", 5.0).last));
  EXPECT_FALSE(verdicts.isByDeviceForce(answerOn(6, "", 6.0).last))
      << "scans without a part are devices of their own";
}

}  // namespace
}  // namespace mems_stiction
