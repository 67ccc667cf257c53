#include "ros/scan_accounting.hpp"

#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <gtest/gtest.h>
#include <ros/console.h>

#include "ros/own_log.hpp"

namespace mems_stiction {
namespace {

class ScanAccountingTest : public ::testing::Test {
 protected:
  void image(std::uint32_t seq, std::uint32_t stamp) {
    std_msgs::Header header;
    header.seq = seq;
    header.stamp = ros::Time(stamp, 0);
    books_.arrived(header);
  }
  std::uint64_t missing() const { return books_.counts().missing_by_sequence; }

  ScanAccounting books_{ros::WallDuration(5.0)};
};

TEST_F(ScanAccountingTest, NumbersThatOnePublisherSkipsAreMissing) {
  image(1, 1), image(2, 2), image(6, 3), image(7, 4), image(9, 5);
  EXPECT_EQ(missing(), 4U);
}

TEST_F(ScanAccountingTest, NumbersAreMissingAlsoWhereStampsStandStill) {
  image(1, 0), image(2, 0), image(6, 0), image(7, 0);
  EXPECT_EQ(missing(), 3U);
}

TEST_F(ScanAccountingTest, SeveralPublishersAreNoLosses) {
  for (std::uint32_t i = 0; i < 150; ++i) image(1 + i, 1000 + i), image(900 + i, 500 + i);
  EXPECT_EQ(missing(), 0U);
}

TEST_F(ScanAccountingTest, APublisherThatJoinsLaterIsNoLoss) {
  image(1, 1), image(2, 2);
  image(800, 3), image(3, 4), image(801, 5), image(4, 6);
  EXPECT_EQ(missing(), 0U);
  image(7, 7), image(803, 8);  // each has lost some of its own
  EXPECT_EQ(missing(), 3U);
}

TEST_F(ScanAccountingTest, APublisherThatStartsAgainIsNoLoss) {
  image(1, 1), image(2, 2), image(3, 3);
  image(1, 4), image(2, 5), image(3, 6), image(4, 7);
  EXPECT_EQ(missing(), 0U);
}

TEST_F(ScanAccountingTest, StampsThatDoNotGrowAreCounted) {
  image(1, 8), image(2, 9), image(3, 8), image(4, 9);  // a bag that starts again
  EXPECT_EQ(books_.counts().stamps_not_increasing, 1U);
  EXPECT_EQ(missing(), 0U);
}

TEST_F(ScanAccountingTest, AStampThatComesTwiceDoesNotGrow) {
  image(1, 8), image(2, 8), image(3, 9);
  EXPECT_EQ(books_.counts().stamps_not_increasing, 1U);
}

TEST(ScanAccounting, APauseInWhichTheProcessDidNotRunIsSaid) {
  ScanAccounting books(ros::WallDuration(5.0), ros::WallDuration(0.01));
  const auto levelAfter = [&](double pause) {
    ros::WallDuration(pause).sleep();
    diagnostic_updater::DiagnosticStatusWrapper status;
    books.report(status);
    return static_cast<int>(status.level);
  };
  EXPECT_EQ(levelAfter(0.0), diagnostic_msgs::DiagnosticStatus::OK);
  EXPECT_EQ(levelAfter(0.02), diagnostic_msgs::DiagnosticStatus::OK);
  EXPECT_EQ(levelAfter(1.2), diagnostic_msgs::DiagnosticStatus::WARN);
  EXPECT_EQ(levelAfter(0.02), diagnostic_msgs::DiagnosticStatus::OK);
}

/// What is warned of while it lives.
class Warnings : public ros::console::LogAppender {
 public:
  Warnings() { ros::console::register_appender(this); }
  ~Warnings() override { ros::console::deregister_appender(this); }
  void log(ros::console::Level level, const char* text, const char* /*file*/,
           const char* /*function*/, int /*line*/) override {
    if (level == ros::console::levels::Warn) texts.emplace_back(text);
  }

  std::vector<std::string> texts;
};

TEST(ScanAccounting, WhatAMessageSaysMakesNoNewKindOfWarning) {
  ScanAccounting books(ros::WallDuration(1000.0));
  const Warnings warnings;
  const std_msgs::Header header;
  const auto reject = [&](const std::string& encoding) {
    books.rejected(header, "encoding '" + encoding + "' does not carry heights; accepted: 32FC1");
  };
  for (char letter = 'a'; letter <= 'z'; ++letter) reject(std::string(3, letter) + "7");
  reject(""), reject("'"), reject("a' or 'b"), reject("it's"), reject("x 'y");
  finishLog();
  EXPECT_EQ(warnings.texts.size(), 1U);
  for (const char* frame : {"left", "right"})
    books.rejected(header, '"' + std::string(frame) + "\" does not exist");
  finishLog();
  EXPECT_EQ(warnings.texts.size(), 2U);
  books.warn(header, "the scan's pitch is odd, and the counter's too");
  books.warn(header, "the scan's range is odd, and the counter's too");
  finishLog();
  EXPECT_EQ(warnings.texts.size(), 4U);  // an apostrophe is no quotation mark
}

TEST(OwnLogDeathTest, AProcessEndsBehindTheLinesThatWait) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
      {
        for (int line = 0; line < 50; ++line)
          logSoon(ros::console::levels::Warn, "line " + std::to_string(line));
        std::exit(0);
      },
      testing::ExitedWithCode(0), "line 49");
}

TEST(ScanAccounting, TellsWhatBecameOfEachScan) {
  ScanAccounting accounting(ros::WallDuration(5.0), ros::WallDuration(1.0));
  std_msgs::Header header;
  for (int scan = 0; scan < 10; ++scan) accounting.received();
  accounting.predicted(0.5, 0.1);
  accounting.predicted(2.0, 0.2);
  accounting.predicted(1.0, 0.3);
  accounting.dropped(header, "too many");
  accounting.dropped(header, "too many");
  accounting.rejected(header, "no pitch");
  accounting.counterSurfaceAccepted();
  diagnostic_updater::DiagnosticStatusWrapper status;
  accounting.report(status);
  std::map<std::string, std::string> values;
  for (const auto& entry : status.values) values[entry.key] = entry.value;
  const std::map<std::string, std::string> expected = {
      {"received", "10"},
      {"predicted", "3"},
      {"dropped", "2"},
      {"rejected", "1"},
      {"waiting", "4"},
      {"counter_surfaces", "1"},
      {"last_latency [s]", "1"},
      {"max_latency [s]", "2"},
      {"last_processing_time [s]", "0.3"},
      {"last_reason", "rejected the scan of stamp 0.000000000: no pitch"}};
  for (const auto& [key, value] : expected) EXPECT_EQ(values[key], value) << key;
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::WARN);
  accounting.report(status);
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::OK);
}

}  // namespace
}  // namespace mems_stiction
