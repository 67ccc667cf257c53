#include "mems_stiction/ros/scan_pairer.hpp"

#include <algorithm>
#include <random>
#include <string>
#include <utility>
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
  void look() { pairer_.expire(now_); }
  void standStill(double seconds) { now_ += ros::WallDuration(seconds); }
  /// As the node does: a look in each fifth of the timeout.
  void wait(double seconds) {
    constexpr double kPeriod = 1.0;
    for (double left = seconds; left > 0.0; left -= kPeriod) {
      standStill(std::min(left, kPeriod));
      look();
    }
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

TEST_F(ScanPairerTest, APartnerThatCameWhileTheNodeStoodStillIsInTime) {
  image(1);
  standStill(60.0);
  look(), look();  // the timer may catch up before the messages do
  info(1);
  EXPECT_EQ(paired_, (Stamps{1}));
  image(2);
  standStill(60.0);
  wait(1.0), wait(1.0);
  EXPECT_TRUE(rejected_.empty());
  wait(1.0);
  EXPECT_EQ(rejected_, (Stamps{2}));
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

TEST(ScanPairer, RejectsTheOldestBeyondItsMemoryButNeverTheNewestAndCountsEachScanOnce) {
  using Stamps = std::vector<std::uint32_t>;
  Stamps paired, rejected;
  std::string last_reason;
  ScanPairer pairer(
      ros::WallDuration(5.0), [&](const auto& image, const auto&) { paired.push_back(image->header.stamp.sec); },
      [&](const auto& header, const auto& reason) {
        rejected.push_back(header.stamp.sec);
        last_reason = reason;
      },
      10000);
  const ros::WallTime now(100, 0);
  const auto image = [&](std::uint32_t stamp, std::size_t bytes) {
    auto message = boost::make_shared<sensor_msgs::Image>();
    message->header.stamp = ros::Time(stamp, 0);
    message->data.resize(bytes);
    pairer.add(message, now);
  };
  const auto info = [&](std::uint32_t stamp, std::size_t bytes) {
    auto message = boost::make_shared<ScanInfo>();
    message->header.stamp = ros::Time(stamp, 0);
    message->scan_name.resize(bytes);
    pairer.add(message, now);
  };
  for (std::uint32_t stamp = 1; stamp <= 5; ++stamp) image(stamp, 4000);
  EXPECT_EQ(rejected, (Stamps{1, 2, 3}));
  EXPECT_NE(last_reason.find("max_waiting_memory"), std::string::npos) << last_reason;
  EXPECT_EQ(pairer.waiting(), 2U);
  EXPECT_GE(pairer.waitingBytes(), 8000U);
  EXPECT_LE(pairer.waitingBytes(), 10000U);
  info(1, 0), info(5, 0);  // the partner of one that was rejected, and of one that waits
  EXPECT_EQ(paired, (Stamps{5}));
  image(6, 40000);
  EXPECT_EQ(pairer.waiting(), 1U);  // image 4 was older than the pair; the newest stays, whatever it holds
  for (std::uint32_t stamp = 11; stamp <= 15; ++stamp) info(stamp, 4000);
  EXPECT_EQ(pairer.waiting(), 3U);
  for (const double later : {4.0, 5.0, 6.0}) pairer.expire(now + ros::WallDuration(later));
  EXPECT_EQ(rejected, (Stamps{1, 2, 3, 4, 11, 12, 13, 6, 14, 15}));  // 1 once
  EXPECT_EQ(pairer.waitingBytes(), 0U);
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

TEST_F(ScanPairerTest, EqualStampsArePairsOneAfterTheOther) {
  image(0), info(0), info(0), image(0), image(0), info(0);
  EXPECT_EQ(paired_, (Stamps{0, 0, 0}));
  EXPECT_TRUE(rejected_.empty());
}

TEST_F(ScanPairerTest, EqualStampsAreNoPairsOnceAHalfIsLost) {
  image(0), info(0), image(0);  // the info was lost: every later image would get that of the next one
  for (int scan = 2; scan < 6; ++scan) image(0), info(0);
  EXPECT_EQ(paired_, (Stamps{0}));
  EXPECT_EQ(rejected_, (Stamps{0, 0, 0, 0, 0}));
  EXPECT_NE(reasons_.back().find("several scans bear its stamp"), std::string::npos);
  wait(5.1);
  image(0), info(0), image(7), info(7);
  EXPECT_EQ(paired_, (Stamps{0, 0, 7}));
  EXPECT_EQ(rejected_.size(), 5U);
  EXPECT_EQ(pairer_.waiting(), 0U);
}

TEST_F(ScanPairerTest, StampsMayLieAsFarApartAsTheyCan) {
  image(4294967295), info(1), info(0);
  wait(5.1);
  EXPECT_EQ(rejected_, (Stamps{4294967295, 1, 0}));
}

// Scans that cross: all of them pair, whatever the order in which the halves of the two publishers come.
TEST_F(ScanPairerTest, StampsOfTwoPublishersMayCross) {
  pairer_.setSeveralPublishers(true);
  image(501), image(1001), info(1001), info(501);
  image(1002), info(502), info(1002), image(502);
  EXPECT_EQ(paired_, (Stamps{1001, 501, 1002, 502}));
  EXPECT_TRUE(rejected_.empty());
}

// As rosbag play --loop: the images of a new round are there before the infos of the old one.
TEST_F(ScanPairerTest, AJumpBackInTimeStartsAfresh) {
  for (int round = 0; round < 3; ++round) {
    image(1), info(1), image(2), image(3);
    image(1), info(2), info(3), info(1), image(2), info(2);
  }
  EXPECT_EQ(paired_.size(), 15U);
  EXPECT_TRUE(rejected_.empty());
  EXPECT_EQ(pairer_.waiting(), 0U);
}

TEST_F(ScanPairerTest, WhatWaitsFromBeforeAJumpBackIsNoHalfOfANewScan) {
  image(1), info(1), image(2), image(3), info(3);  // the info of 2 was lost, and 2 is rejected
  image(4), image(1), info(1);                     // the info of 4 was lost
  image(4), info(4);
  EXPECT_EQ(paired_, (Stamps{1, 3, 1, 4}));
  EXPECT_EQ(rejected_, (Stamps{2, 4}));
}

TEST_F(ScanPairerTest, AScanWhoseHalvesAreGivenUpOneAfterTheOtherCountsOnce) {
  image(1);
  wait(6.0);
  info(1), info(2);
  wait(6.0);
  image(2);
  wait(6.0);
  EXPECT_EQ(rejected_, (Stamps{1, 2}));
  EXPECT_EQ(pairer_.waiting(), 0U);
}

// Every image counts once: accepted or rejected, in whatever order the halves come, with losses and jumps.
TEST_F(ScanPairerTest, EveryImageCountsOnceWhateverTheOrder) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial) {
    paired_.clear(), rejected_.clear();
    pairer_.setSeveralPublishers(trial % 2 == 1);
    std::size_t sent = 0;
    for (int round = 0; round < 3; ++round) {  // of one bag; what is late in one comes among the next one's
      std::vector<std::pair<std::uint32_t, bool>> halves;
      for (std::uint32_t scan = 0; scan < 20; ++scan) {
        const std::uint32_t stamp = scan % 2 == 0 ? 1000 + scan : 500 + scan;
        halves.emplace_back(stamp, true);
        if (random() % 10 > 0) halves.emplace_back(stamp, false);
      }
      for (std::size_t i = 0; i + 1 < halves.size(); ++i) {
        std::swap(halves[i], halves[std::min(halves.size() - 1, i + random() % 6)]);
      }
      for (const auto& [stamp, is_image] : halves) {
        is_image ? image(stamp) : info(stamp);
        sent += is_image ? 1 : 0;
        if (random() % 12 == 0) wait(3.0);
      }
      wait(6.0);
    }
    EXPECT_EQ(paired_.size() + rejected_.size(), sent) << "trial " << trial;
    EXPECT_EQ(pairer_.waiting(), 0U);
    wait(60.0);  // what was given up is forgotten
  }
}

}  // namespace
}  // namespace mems_stiction
