#include "ros/checked_messages.hpp"

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Header.h>
#include <tf2_msgs/TFMessage.h>

#include "mems_stiction/ScanInfo.h"
#include "mems_stiction/SweepLoadGoal.h"

namespace mems_stiction {
namespace {

template <typename Message>
std::vector<std::uint8_t> bytesAsSent(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

template <typename Message>
Message readFrom(std::vector<std::uint8_t> bytes) {
  Message message;
  readMessage(bytes.data(), static_cast<std::uint32_t>(bytes.size()), message);
  return message;
}

/// Writes a number of 32 bits over the bytes from a place on.
void overwrite(std::vector<std::uint8_t>& bytes, std::size_t place, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i)
    bytes[place + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

/// The largest memory of this process so far [bytes].
std::size_t peakMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "VmHWM:") continue;
    std::size_t kilobytes = 0;
    status >> kilobytes;
    return 1024 * kilobytes;
  }
  return 0;
}

sensor_msgs::Image smallImage() {
  sensor_msgs::Image image;
  image.header.stamp = ros::Time(7, 5);
  image.header.frame_id = "scan";
  image.encoding = "mono8";
  image.height = image.width = image.step = 2;
  image.data = {1, 2, 3, 4};
  return image;
}

TEST(ReadMessage, IsWhatRoscppReads) {
  EXPECT_EQ(readFrom<sensor_msgs::Image>(bytesAsSent(smallImage())), smallImage());
  SweepLoadGoal goal;
  goal.voltages = {0.0, 1.5, 3.0};
  goal.height = smallImage();
  goal.scan_info.part_id = "lot 3";
  EXPECT_EQ(readFrom<SweepLoadGoal>(bytesAsSent(goal)), goal);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.resize(2);
  transforms.transforms[1].child_frame_id = "stage";
  transforms.transforms[1].transform.rotation.w = 1.0;
  EXPECT_EQ(readFrom<tf2_msgs::TFMessage>(bytesAsSent(transforms)), transforms);
}

TEST(ReadMessage, AMessageThatStatesMoreThanItHoldsTakesNoMemory) {
  const std::size_t before = peakMemory();
  std::vector<std::uint8_t> image = bytesAsSent(sensor_msgs::Image());
  overwrite(image, image.size() - 4, 0xFFFFFFFFU);
  EXPECT_LE(image.size(), 43U);
  EXPECT_THROW(readFrom<sensor_msgs::Image>(image), MessageError);
  std::vector<std::uint8_t> transforms = bytesAsSent(tf2_msgs::TFMessage());
  overwrite(transforms, 0, 30000000U);
  EXPECT_THROW(readFrom<tf2_msgs::TFMessage>(transforms), MessageError);
  // 2^29 numbers have 2^32 bytes, which roscpp takes for none
  SweepLoadGoal goal;
  goal.voltages = {1.0};
  std::vector<std::uint8_t> sweep = bytesAsSent(goal);
  bool is_found = false;
  for (std::size_t place = 0; place + 12 <= sweep.size() && !is_found; ++place) {
    std::vector<std::uint8_t> damaged = sweep;
    is_found = sweep[place] == 1 && sweep[place + 10] == 0xF0 &&
               sweep[place + 11] == 0x3F;  // one element, 1.0
    if (!is_found) continue;
    overwrite(damaged, place, 1U << 29U);
    EXPECT_THROW(readFrom<SweepLoadGoal>(damaged), MessageError);
  }
  EXPECT_TRUE(is_found);
  EXPECT_LT(peakMemory() - before, std::size_t{16} << 20U);
}

TEST(ReadMessage, AMessageThatIsCutOffAnywhereIsRefused) {
  const std::vector<std::uint8_t> whole = bytesAsSent(smallImage());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(readFrom<sensor_msgs::Image>(
                     {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}),
                 MessageError);
  }
}

class CheckedCallbackTest : public testing::Test {
 protected:
  ros::VoidConstPtr deserialize(std::vector<std::uint8_t> bytes, double most = kLargestMessage) {
    CheckedCallback<sensor_msgs::Image> callback(
        {[](const auto&) { ADD_FAILURE() << "is called by roscpp"; },
         [this](const BoundedStream& refused, const std::string& reason) {
           header_ = std_msgs::Header();
           readBeginning(refused, header_);
           reason_ = reason;
         },
         most});
    return callback.deserialize({bytes.data(), static_cast<std::uint32_t>(bytes.size()), nullptr});
  }

  std_msgs::Header header_;
  std::string reason_;
};

TEST_F(CheckedCallbackTest, WhatIsRefusedIsNamedByItsHeader) {
  std::vector<std::uint8_t> bytes = bytesAsSent(smallImage());
  overwrite(bytes, bytes.size() - 8, 4000000000U);
  EXPECT_EQ(deserialize(bytes), nullptr);
  EXPECT_EQ(header_.stamp, ros::Time(7, 5));
  EXPECT_NE(reason_.find("states 4000000000 elements of at least 1 bytes, but only 4 bytes follow"),
            std::string::npos)
      << reason_;
  EXPECT_EQ(deserialize({1, 2, 3}), nullptr);
  EXPECT_TRUE(header_.stamp.isZero());
}

TEST_F(CheckedCallbackTest, BeyondMaxMessageSizeNothingIsRead) {
  const std::vector<std::uint8_t> bytes = bytesAsSent(smallImage());
  EXPECT_EQ(deserialize(bytes, static_cast<double>(bytes.size()) - 1.0), nullptr);
  EXPECT_NE(reason_.find("max_message_size"), std::string::npos) << reason_;
  reason_.clear();
  EXPECT_NE(deserialize(bytes, static_cast<double>(bytes.size())), nullptr);
  EXPECT_EQ(reason_, "");
}

}  // namespace
}  // namespace mems_stiction
