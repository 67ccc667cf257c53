#include "mems_stiction/ros/scan_pairer.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>

namespace mems_stiction {
namespace {

class ScanPairerTest : public ::testing::Test {
 protected:
  void image(std::uint32_t stamp) {
    auto message = boost::make_shared<sensor_msgs::Image>();
    message->header.stamp = ros::Time(stamp, 0);
    message->header.seq = next_++;
    pairer_.add(message, now_);
  }
  void info(std::uint32_t stamp) {
    auto message = boost::make_shared<ScanInfo>();
    message->header.stamp = ros::Time(stamp, 0);
    pairer_.add(message, now_);
  }
  void wait(double seconds) {
    now_ += ros::WallDuration(seconds);
    pairer_.expire(now_);
  }

  using Stamps = std::vector<std::uint32_t>;
  ros::WallTime now_{100, 0};
  std::uint32_t next_ = 0;
  Stamps paired_;
  Stamps rejected_;
  std::vector<std::string> reasons_;
  ScanPairer pairer_{ros::WallDuration(5.0),
                     [this](const auto& image, const auto& info) {
                       EXPECT_EQ(image->header.stamp, info->header.stamp);
                       paired_.push_back(image->header.stamp.sec);
                     },
                     [this](const auto& header, const auto& reason) {
                       rejected_.push_back(header.stamp.sec);
                       reasons_.push_back(reason);
                     }};
};

TEST_F(ScanPairerTest, PairsByStampInWhicheverOrderTheTopicsDeliver) {
  image(1), info(1), info(2), image(2);
  image(3), image(4), info(3), info(4);
  EXPECT_EQ(paired_, (Stamps{1, 2, 3, 4}));
  EXPECT_TRUE(rejected_.empty());
  EXPECT_EQ(pairer_.waiting(), 0U);
}

TEST_F(ScanPairerTest, NamesTheStampOfAPartnerThatMissesByALittle) {
  image(1), info(2);
  wait(6.0);
  ASSERT_EQ(reasons_.size(), 2U);
  EXPECT_NE(reasons_[0].find("one came with the stamp 2.000000000, 1 s later"), std::string::npos) << reasons_[0];
  EXPECT_NE(reasons_[1].find("one came with the stamp 1.000000000, 1 s earlier"), std::string::npos) << reasons_[1];
  image(10);
  wait(6.0);
  EXPECT_EQ(reasons_[2].find("one came"), std::string::npos) << reasons_[2];
}

TEST_F(ScanPairerTest, RejectsALoneMessageWhenANewerPairPasses) {
  image(1);
  info(2);
  EXPECT_TRUE(rejected_.empty());
  image(3), info(3);
  EXPECT_EQ(paired_, (Stamps{3}));
  EXPECT_EQ(rejected_, (Stamps{1, 2}));
  EXPECT_NE(reasons_[0].find("no scan_info"), std::string::npos);
  EXPECT_NE(reasons_[1].find("no scan with"), std::string::npos);
  EXPECT_EQ(pairer_.waiting(), 0U);
}

TEST_F(ScanPairerTest, RejectsALoneMessageAfterTheTimeout) {
  image(1);
  wait(4.9);
  info(2);
  EXPECT_TRUE(rejected_.empty());
  wait(0.2);
  EXPECT_EQ(rejected_, (Stamps{1}));
  wait(5.0);
  EXPECT_EQ(rejected_, (Stamps{1, 2}));
}

TEST_F(ScanPairerTest, ABagThatStartsAgainIsPairedAgain) {
  image(8), info(8), image(1), info(1);
  EXPECT_EQ(paired_, (Stamps{8, 1}));
  EXPECT_TRUE(rejected_.empty());
}

TEST_F(ScanPairerTest, EqualStampsArePairedInOrder) {
  image(0), image(0), info(0), info(0);
  EXPECT_EQ(paired_, (Stamps{0, 0}));
  EXPECT_EQ(pairer_.waiting(), 0U);
}

}  // namespace
}  // namespace mems_stiction
