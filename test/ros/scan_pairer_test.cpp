#include "ros/scan_pairer.hpp"

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
  void image(std::uint32_t stamp, const std::string& name = "") {
    auto message = boost::make_shared<sensor_msgs::Image>();
    message->header.stamp = ros::Time(stamp, 0);
    message->header.seq = next_++;
    message->header.frame_id = name;
    pairer_.add(message, now_);
  }
  void info(std::uint32_t stamp, const std::string& name = "") {
    auto message = boost::make_shared<ScanInfo>();
    message->header.stamp = ros::Time(stamp, 0);
    message->header.seq = next_++;
    message->scan_name = name;
    pairer_.add(message, now_);
  }
  /// A driver's whole scan, whose two halves bear one name.
  void scan(std::uint32_t stamp, const std::string& name, bool with_image = true,
            bool with_info = true) {
    if (with_image) image(stamp, name);
    if (with_info) info(stamp, name);
  }
  void expectNoneCrossed() const {
    for (const auto& [image, info] : names_) EXPECT_EQ(image, info);
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
  ros::SteadyTime now_{100, 0};
  std::uint32_t next_ = 0;
  Stamps paired_;
  Stamps rejected_;
  std::vector<std::string> reasons_;
  std::vector<std::pair<std::string, std::string>> names_;  ///< of image and scan_info
  ScanPairer pairer_{ros::WallDuration(5.0),
                     [this](const auto& image, const auto& info) {
                       EXPECT_EQ(image->header.stamp, info->header.stamp);
                       paired_.push_back(image->header.stamp.sec);
                       names_.emplace_back(image->header.frame_id, info->scan_name);
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
  EXPECT_NE(reasons_[0].find("one came with the stamp 2.000000000, 1 s later"), std::string::npos)
      << reasons_[0];
  EXPECT_NE(reasons_[1].find("one came with the stamp 1.000000000, 1 s earlier"), std::string::npos)
      << reasons_[1];
  image(10);
  wait(6.0);
  EXPECT_EQ(reasons_[2].find("one came"), std::string::npos) << reasons_[2];
}

TEST(ScanPairer, RejectsTheOldestBeyondItsMemoryButNeverTheNewestAndCountsEachScanOnce) {
  using Stamps = std::vector<std::uint32_t>;
  Stamps paired, rejected;
  std::string last_reason;
  ScanPairer pairer(
      ros::WallDuration(5.0),
      [&](const auto& image, const auto&) { paired.push_back(image->header.stamp.sec); },
      [&](const auto& header, const auto& reason) {
        rejected.push_back(header.stamp.sec);
        last_reason = reason;
      },
      10000);
  const ros::SteadyTime now(100, 0);
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
  EXPECT_EQ(pairer.waiting(), 2U);  // the newest stays, whatever it holds
  for (std::uint32_t stamp = 11; stamp <= 15; ++stamp) info(stamp, 4000);
  EXPECT_EQ(pairer.waiting(), 3U);
  for (const double later : {4.0, 5.0, 6.0}) pairer.expire(now + ros::WallDuration(later));
  EXPECT_EQ(rejected, (Stamps{1, 2, 3, 4, 11, 12, 13, 6, 14, 15}));  // 1 once
  EXPECT_EQ(pairer.waitingBytes(), 0U);
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

// Nobody can tell which halves belong together, by order of arrival and header.seq neither: a half
// that is lost, or was never sent, shifts all after it.
TEST_F(ScanPairerTest, RejectsScansWithoutAStampAndCountsEachOnceWhicheverHalfIsLost) {
  for (const bool image_first : {true, false}) {
    for (const bool is_image_lost : {true, false}) {
      for (const int lost : {-1, 0, 1, 10, 59}) {
        for (int number = 0; number < 60; ++number) {
          const bool with_image = number != lost || !is_image_lost;
          const bool with_info = number != lost || is_image_lost;
          if (!image_first) scan(0, "a", false, with_info);
          scan(0, "a", with_image, image_first && with_info);
          wait(0.05);
        }
        EXPECT_TRUE(paired_.empty());
        EXPECT_EQ(rejected_.size(), 60U) << lost;
        EXPECT_NE(reasons_.at(0).find("no stamp (0)"), std::string::npos) << reasons_[0];
        EXPECT_NE(reasons_.at(0).find("header.stamp of its own, or set use_scan_info to false"),
                  std::string::npos);
        EXPECT_EQ(pairer_.waiting(), 0U);
        if (lost >= 0 && is_image_lost) image(0);  // the next driver is another one
        if (lost >= 0 && !is_image_lost) info(0);
        rejected_.clear(), reasons_.clear();
      }
    }
  }
}

TEST_F(ScanPairerTest, TwoPublishersWithOneStampAreNotCrossed) {
  pairer_.setSeveralPublishers(true);
  std::mt19937 random(5);
  for (int number = 0; number < 300; ++number) {
    for (const std::uint32_t stamp : {0U, 100U + static_cast<std::uint32_t>(number)}) {
      const std::string a = "a" + std::to_string(number);
      const std::string b = "b" + std::to_string(number);
      std::vector<std::pair<std::string, bool>> halves = {
          {a, true}, {a, false}, {b, true}, {b, false}};
      std::shuffle(halves.begin(), halves.end(), random);
      for (const auto& [name, is_image] : halves) scan(stamp, name, is_image, !is_image);
    }
    wait(0.05);
  }
  wait(30.0);
  EXPECT_EQ(paired_.size() + rejected_.size(), 1200U);
  // What is together before anything else of the stamp has come is taken for a scan; the next one
  // then says so.
  const auto doubtful =
      std::count_if(reasons_.begin(), reasons_.end(), [](const std::string& reason) {
        return reason.find("that was predicted before may have got") != std::string::npos;
      });
  EXPECT_GE(static_cast<std::size_t>(doubtful), paired_.size());
}

// A clock in whole seconds, or one that stands still: the first scan of a stamp is one, until
// another has it.
TEST_F(ScanPairerTest, StampsThatWereSeenAreRejectedWithWhatToDo) {
  scan(7, "a"), scan(7, "b");
  EXPECT_EQ(paired_, (Stamps{7}));
  EXPECT_EQ(rejected_, (Stamps{7}));
  EXPECT_NE(reasons_.back().find("header.stamp of its own, or set use_scan_info to false"),
            std::string::npos)
      << reasons_.back();
  EXPECT_NE(reasons_.back().find("predicted before may have got"), std::string::npos)
      << reasons_.back();
  for (std::uint32_t second = 8; second < 20; ++second) {
    scan(second, "c", false), wait(0.4), scan(second, "d"),
        wait(0.6);  // the first image of each is lost
  }
  wait(60.0);
  ASSERT_EQ(paired_.size() + rejected_.size(), 26U);
  for (std::size_t i = 0; i < paired_.size(); ++i) {  // those that cross are said, each time
    if (names_[i].first == names_[i].second) continue;
    const auto said = std::find(rejected_.begin(), rejected_.end(), paired_[i]);
    ASSERT_NE(said, rejected_.end()) << paired_[i];
    const std::string& reason = reasons_[static_cast<std::size_t>(said - rejected_.begin())];
    EXPECT_NE(reason.find("predicted before may have got"), std::string::npos) << reason;
  }
}

TEST_F(ScanPairerTest, AStampThatComesAgainWhileOneWaitsCostsBoth) {
  image(7, "a"), image(7, "b"), info(7, "b"), info(7, "a");
  wait(20.0);
  EXPECT_TRUE(paired_.empty());
  EXPECT_EQ(rejected_, (Stamps{7, 7}));
  EXPECT_EQ(pairer_.waiting(), 0U);
}

TEST_F(ScanPairerTest, ABagOfOneScanInALoopIsPairedOnceInATimeout) {
  for (int round = 0; round < 20; ++round) scan(7, "a"), wait(0.5);
  EXPECT_EQ(paired_.size(), 1U);
  EXPECT_EQ(rejected_.size(), 19U);
  wait(7.1);
  scan(7, "a");
  EXPECT_EQ(paired_.size(), 2U);
}

TEST_F(ScanPairerTest, APartnerThatComesAfterAnyTimeIsNoScanOfItsOwn) {
  for (const double late : {6.0, 55.0, 600.0}) {
    image(1);
    wait(late);
    info(1);
    wait(7.0);
  }
  EXPECT_EQ(rejected_, (Stamps{1, 1, 1}));
  EXPECT_EQ(pairer_.waiting(), 0U);
}

TEST_F(ScanPairerTest, ADriverThatStartsAgainIsPairedAgain) {
  scan(5, "a"), image(6, "b");
  next_ = 0;
  scan(7, "c"), scan(8, "d");
  EXPECT_EQ(paired_, (Stamps{5, 7, 8}));
  wait(7.1);
  EXPECT_EQ(rejected_, (Stamps{6}));
  expectNoneCrossed();
}

TEST_F(ScanPairerTest, APublisherThatStartsAgainMaySendItsOneScanAgain) {
  for (int start = 0; start < 3; ++start) {
    next_ = 1;
    scan(5, "a");
  }
  EXPECT_EQ(paired_, (Stamps{5, 5, 5}));
  EXPECT_TRUE(rejected_.empty());
}

TEST_F(ScanPairerTest, StampsMayLieAsFarApartAsTheyCan) {
  image(4294967295), info(1), info(0);
  wait(5.1);
  EXPECT_EQ(rejected_, (Stamps{0, 4294967295, 1}));
}

TEST_F(ScanPairerTest, AHalfThatCannotBeReadIsOneScanWithItsPartner) {
  const auto refusedHeader = [](std::uint32_t stamp) {
    std_msgs::Header header;
    header.stamp = ros::Time(stamp, 0);
    return header;
  };
  pairer_.refuseImage(refusedHeader(1), "damaged");  // before its partner
  info(1);
  info(2);
  pairer_.refuseImage(refusedHeader(2), "damaged");  // after it
  pairer_.refuseInfo(refusedHeader(3), "damaged");
  pairer_.refuseImage(refusedHeader(3), "damaged");  // both
  pairer_.refuseImage(std_msgs::Header(), "nothing of it can be read");
  scan(4, "whole");
  wait(20.0);
  EXPECT_EQ(rejected_, (Stamps{1, 2, 3, 0}));
  EXPECT_EQ(paired_, (Stamps{4}));
  EXPECT_EQ(pairer_.waiting(), 0U);
}

// Scans that cross: all of them pair, whatever the order in which the halves of the two publishers
// come.
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
  image(1), info(1), image(2), image(3), info(3);  // the info of 2 was lost
  image(4), image(1), info(1);                     // the info of 4 was lost
  image(4), info(4);
  EXPECT_EQ(paired_, (Stamps{1, 3, 1, 4}));
  EXPECT_EQ(rejected_, (Stamps{4}));
  wait(7.1);
  EXPECT_EQ(rejected_, (Stamps{4, 2}));
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

// Every image counts once: accepted or rejected, in whatever order the halves come, with losses and
// jumps.
TEST_F(ScanPairerTest, EveryImageCountsOnceWhateverTheOrder) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial) {
    paired_.clear(), rejected_.clear();
    pairer_.setSeveralPublishers(trial % 2 == 1);
    std::size_t sent = 0;
    for (int round = 0; round < 3;
         ++round) {  // of one bag; what is late in one comes among the next one's
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
