#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tf2/LinearMath/Matrix3x3.h>
#include <tf2/LinearMath/Quaternion.h>

#include "mems_stiction/errors/errors.hpp"
#include "ros/counter_surface_frame.hpp"
#include "ros/transform_gate.hpp"

namespace mems_stiction {
namespace {

geometry_msgs::Transform transformOf(const tf2::Quaternion& turn, double x = 0.0, double y = 0.0) {
  geometry_msgs::Transform transform;
  transform.translation.x = x;
  transform.translation.y = y;
  transform.translation.z = 1e-3;
  transform.rotation.x = turn.x();
  transform.rotation.y = turn.y();
  transform.rotation.z = turn.z();
  transform.rotation.w = turn.w();
  return transform;
}

TEST(PoseOf, NoTurnIsNoPose) {
  const SurfacePose pose = poseOf(transformOf(tf2::Quaternion(0.0, 0.0, 0.0, 1.0), 2e-6, -3e-6));
  EXPECT_EQ(pose.offset_x, 2e-6);
  EXPECT_EQ(pose.offset_y, -3e-6);
  EXPECT_EQ(pose.rotation, 0.0);
  EXPECT_EQ(pose.tilt_x, 0.0);
  EXPECT_EQ(pose.tilt_y, 0.0);
}

/// By the definition in alignment.hpp: points of the counter-surface's plane lie where the pose's
/// slopes say.
TEST(PoseOf, ThePlaneIsThatOfTheTransform) {
  tf2::Quaternion turn;
  turn.setRPY(0.02, -0.05, 0.7);
  const SurfacePose pose = poseOf(transformOf(turn));
  for (const tf2::Vector3& point :
       {tf2::Vector3(1, 0, 0), tf2::Vector3(0, 1, 0), tf2::Vector3(-2, 3, 0)}) {
    const tf2::Vector3 seen = tf2::Matrix3x3(turn) * point;
    EXPECT_NEAR(seen.z(), seen.x() * std::tan(pose.tilt_x) + seen.y() * std::tan(pose.tilt_y),
                1e-12);
  }
  EXPECT_NEAR(pose.rotation, 0.7, 2e-3);  // of second order in the tilts
}

TEST(PoseOf, SignsAreThoseOfTheColumnsAndRows) {
  tf2::Quaternion turn;
  turn.setRPY(0.0, -0.01, 0.0);  // about -y: the side of larger x goes up
  EXPECT_NEAR(poseOf(transformOf(turn)).tilt_x, 0.01, 1e-12);
  turn.setRPY(0.01, 0.0, 0.0);  // about x: the side of larger y goes up
  EXPECT_NEAR(poseOf(transformOf(turn)).tilt_y, 0.01, 1e-12);
  turn.setRPY(0.0, 0.0, -3.0);
  EXPECT_NEAR(poseOf(transformOf(turn)).rotation, -3.0, 1e-12);
}

TEST(PoseOf, ASurfaceThatFacesAwayIsRefused) {
  tf2::Quaternion turn;
  turn.setRPY(3.1, 0.0, 0.0);
  EXPECT_THROW(poseOf(transformOf(turn)), SurfaceError);
  turn.setRPY(0.0, 1.55, 0.0);
  EXPECT_THROW(poseOf(transformOf(turn)), SurfaceError);
}

class TransformGateTest : public testing::Test {
 protected:
  void add(double stamp, std::size_t bytes = 0) {
    std_msgs::Header header;
    header.stamp = ros::Time(stamp);
    gate_.add(
        header,
        [this, stamp](const SurfacePose&) {
          log_.push_back("accept " + std::to_string(std::int64_t(stamp)));
        },
        [this, stamp](const std::string& reason) {
          log_.push_back("reject " + std::to_string(std::int64_t(stamp)) + " " + reason);
        },
        dropping(std::to_string(std::int64_t(stamp))), bytes, now_);
  }
  void addCounterSurface(const std::string& name, std::size_t bytes = 0) {
    gate_.addCounterSurface([this, name] { log_.push_back(name); }, dropping(name), bytes, now_);
  }
  TransformGate::Drop dropping(const std::string& name) {
    return [this, name] { log_.push_back("drop " + name); };
  }
  void wait(double seconds) {
    now_ += ros::WallDuration(seconds);
    gate_.poll(now_);
  }

  static constexpr std::uint32_t kWild = 4294967295U;

  double known_until_ = 0.0;
  ros::SteadyTime now_{100.0};
  std::vector<std::string> log_;
  TransformGate gate_{ros::WallDuration(1.0),
                      [this](const std_msgs::Header& header) {
                        if (header.stamp.toSec() < 0.5) throw SurfaceError("never");
                        if (header.stamp.sec == kWild)
                          throw std::runtime_error("Duration is out of range");
                        if (header.stamp.toSec() > known_until_) throw NoTransform("not yet");
                        return SurfacePose();
                      },
                      100};
};

TEST_F(TransformGateTest, NobodyOvertakes) {
  add(5.0);
  add(3.0);
  addCounterSurface("behind");
  known_until_ = 4.0;  // the second could go, the first cannot
  wait(0.5);
  EXPECT_TRUE(log_.empty());
  EXPECT_EQ(gate_.waiting(), 3U);
  known_until_ = 5.0;
  wait(0.1);
  EXPECT_EQ(log_, (std::vector<std::string>{"accept 5", "accept 3", "behind"}));
}

TEST_F(TransformGateTest, WhoWaitedTooLongIsRejectedAndTheNextGoesOn) {
  add(5.0);
  wait(0.5);
  add(6.0);
  known_until_ = 0.0;
  wait(0.6);  // 1.1 s for the first, 0.6 s for the second
  EXPECT_EQ(log_, (std::vector<std::string>{"reject 5 not yet"}));
  known_until_ = 6.0;
  wait(0.1);
  EXPECT_EQ(log_.back(), "accept 6");
}

TEST_F(TransformGateTest, BeyondItsMemoryTheOldestAreDroppedButForTheFirstInLine) {
  for (const double stamp : {5.0, 6.0, 7.0, 8.0}) add(stamp, 40);
  EXPECT_EQ(log_, (std::vector<std::string>{"drop 6", "drop 7"}));
  EXPECT_EQ(gate_.waitingBytes(), 80U);
  known_until_ = 8.0;
  wait(0.1);
  EXPECT_EQ(log_, (std::vector<std::string>{"drop 6", "drop 7", "accept 5", "accept 8"}));
  EXPECT_EQ(gate_.waitingBytes(), 0U);
}

TEST_F(TransformGateTest, OfCounterSurfacesWithoutAScanBetweenThemTheNewestIsEnough) {
  add(5.0, 40);
  for (const char* name : {"a", "b", "c"}) addCounterSurface(name, 40);
  known_until_ = 5.0;
  wait(0.1);
  EXPECT_EQ(log_, (std::vector<std::string>{"drop a", "drop b", "accept 5", "c"}));
}

TEST_F(TransformGateTest, WhatCanNeverPassIsRejectedAtOnce) {
  add(0.0);
  EXPECT_EQ(log_, (std::vector<std::string>{"reject 0 never"}));
}

TEST_F(TransformGateTest, WhateverTheLookupThrowsTheNextInLineGetsItsTurn) {
  add(5.0);
  add(kWild);
  add(6.0);
  known_until_ = 6.0;
  wait(0.1);
  EXPECT_EQ(log_, (std::vector<std::string>{
                      "accept 5", "reject 4294967295 Duration is out of range", "accept 6"}));
}

}  // namespace
}  // namespace mems_stiction
