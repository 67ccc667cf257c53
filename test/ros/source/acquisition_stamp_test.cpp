/// The stamp of a scan follows from what its file states.

#include <cstdlib>
#include <ctime>
#include <string>

#include <gtest/gtest.h>

#include "source/acquisition_stamp.hpp"

namespace mems_stiction {
namespace {

constexpr std::int64_t kFileTime = 1500000000123456789;

TEST(AcquisitionStamp, ATimeWithAZoneIsExact) {
  // date -u -d "2014-03-01T13:05:00Z" +%s
  EXPECT_EQ(acquisitionStamp("2014-03-01T14:05:00.25+01:00", kFileTime), 1393679100250000000u);
  EXPECT_EQ(acquisitionStamp("2014-03-01T13:05:00Z", kFileTime), 1393679100000000000u);
  EXPECT_EQ(acquisitionStamp("2014-03-01T08:05-05:00", kFileTime), 1393679100000000000u);
}

TEST(AcquisitionStamp, ATimeWithoutAZoneIsThisMachines) {
  const char* zone = std::getenv("TZ");
  const std::string before = zone == nullptr ? "" : zone;
  setenv("TZ", "CET-1CEST,M3.5.0,M10.5.0/3", 1);
  tzset();
  const std::uint64_t winter = acquisitionStamp("2014-03-01T14:05:00", kFileTime);
  const std::uint64_t summer = acquisitionStamp("2014-07-01T14:05:00", kFileTime);
  before.empty() ? unsetenv("TZ") : setenv("TZ", before.c_str(), 1);
  tzset();
  EXPECT_EQ(winter, 1393679100000000000u);
  EXPECT_EQ(summer, 1404216300000000000u);
}

TEST(AcquisitionStamp, WhatMakesNoSenseLeavesTheFilesTime) {
  for (const char* text : {"", "2014-03-01", "1970-01-01T00:00:00", "1980-01-01T00:00:00",
                           "2999-01-01T00:00:00", "03/11/2011", "2014-03-01T14:05:00 and more"}) {
    EXPECT_EQ(acquisitionStamp(text, kFileTime), static_cast<std::uint64_t>(kFileTime)) << text;
  }
  EXPECT_EQ(acquisitionStamp("", -5), 1u);
}

}  // namespace
}  // namespace mems_stiction
