/// The message of a device holds what was found and judged, and no figure where nothing was.

#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "../support/message_cases.hpp"
#include "device/device_force_fields.hpp"
#include "ros/device_force_conversion.hpp"

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
  EXPECT_EQ(message.warnings, std::vector<std::string>{"measure a field of 40 um; pixels of 100 nm will do"});
  EXPECT_EQ(message.sticks, static_cast<int>(Sticks::kUnknown));
  EXPECT_EQ(message.verdict_reason + message.verdict_by, "");
}

TEST(DeviceMessage, HoldsTheVerdict) {
  DeviceAdhesion message = deviceMessage(DeviceForce(), someLoad(), {});
  fillVerdict(someVerdict(), message);
  EXPECT_EQ(message.sticks, 2);
  EXPECT_EQ(message.verdict_reason, "two; lines; 95 %");
  EXPECT_EQ(message.verdict_by, "prediction");
  EXPECT_EQ((std::vector<double>{message.restoring_force, message.margin, message.margin_lower, message.margin_upper}),
            (std::vector<double>{1e-6, 0.5, 0.4, 0.6}));
  EXPECT_EQ((std::vector<double>{message.peel_number, message.peel_number_lower, message.peel_number_upper}),
            (std::vector<double>{5.0, 4.0, 6.0}));
}

TEST(DeviceMessage, ARefusalHasNoFigures) {
  const DeviceAdhesion message = refusedDevice("two\nlines", someLoad(), {});
  EXPECT_EQ(message.status, DeviceAdhesion::REFUSED);
  EXPECT_EQ(message.message, "two; lines");
  for (const double figure :
       {message.pull_off_force, message.pull_off_force_lower, message.apparent_work_of_adhesion,
        message.linear_pull_off_force, message.contacts, message.separation_at_rest, message.area, message.pitch,
        message.force_deviation, message.processing_time, message.restoring_force, message.margin}) {
    EXPECT_TRUE(std::isnan(figure));
  }
  EXPECT_TRUE(message.realisations.empty() && message.warnings.empty());
}

}  // namespace
}  // namespace mems_stiction
