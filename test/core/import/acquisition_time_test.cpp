#include "import/acquisition_time.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace mems_stiction {
namespace {

TEST(AcquisitionTime, DatesOfMakersAreWrittenByIso8601) {
  const std::vector<std::pair<std::string, std::string>> dates = {
      {"01:33:51 PM Mon Dec 15 2014", "2014-12-15T13:33:51"},  // NanoScope
      {"12:05:00 AM Sat Feb 29 2020", "2020-02-29T00:05:00"},
      {"12:05:00 PM Sat Feb 29 2020", "2020-02-29T12:05:00"},
      {"2011-10-20T15:48:33", "2011-10-20T15:48:33"},  // x3p
      {"2011-10-20T15:48:33.250+02:00", "2011-10-20T15:48:33.250+02:00"},
      {"2011-10-20T15:48:33Z", "2011-10-20T15:48:33Z"},
      {"2011-10-20 15:48:33 UTC", "2011-10-20T15:48:33Z"},
      {"2011-10-20 15:48:33+0200", "2011-10-20T15:48:33+02:00"},
      {"Thu Oct 20 15:48:33 2011", "2011-10-20T15:48:33"},
      {"20 October 2011", "2011-10-20"},
      {"20.10.2011 7:05", "2011-10-20T07:05"},
      {"9.10.2011", "2011-10-09"},
      {"10/20/2011 3:48:33PM", "2011-10-20T15:48:33"},  // no month has the number 20
      {"20/10/2011, 20:23:46.484", "2011-10-20T20:23:46.484"},
      {"7/7/2015 16:19:48", "2015-07-07T16:19:48"},  // the same either way
      {"2016/02/03", "2016-02-03"},
  };
  for (const auto& [text, iso] : dates) EXPECT_EQ(acquisitionTime(text), iso) << text;
}

TEST(AcquisitionTime, WhatCanBeReadInTwoWaysOrIsNoDayOfTheCalendarStays) {
  for (const char* text :
       {"03/11/2011, 20:23:46.484", "2011-02-29", "2011-13-01", "2011-10-20 25:00",
        "2011-10-20 13:00 PM", "2011-10-20 2012-10-20", "1-2-03", "20.10.2011 in the morning"}) {
    EXPECT_EQ(acquisitionTime(text), text);
  }
}

TEST(AcquisitionTime, WhatNamesNoDayIsNone) {
  for (const char* text : {"", "0. 0. 0", "0000-00-00 00:00:00", "1970-01-01T01:00:00", "12.5 s",
                           "1414156", "yesterday", "15:48:33", "Oct"}) {
    EXPECT_EQ(acquisitionTime(text), "") << text;
  }
  EXPECT_EQ(acquisitionTime(std::string(100000, '1')), "");
  EXPECT_EQ(acquisitionTime("2011-10-20 " + std::string(100000, ' ')), "");
}

}  // namespace
}  // namespace mems_stiction
