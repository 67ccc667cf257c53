#include "import/file_statements.hpp"

#include <gtest/gtest.h>

#include <string>

#include "import/format_readers.hpp"
#include "import/nanoscope_check.hpp"
#include "support/gwy_bytes.hpp"

namespace mems_stiction {
namespace {

TEST(FileStatements, NamesOfMakersAreKnownInAnySection) {
  const ScanIdentity x3p = identityFrom({{"Date", "2011-10-20T15:48:33"},
                                         {"Creator", "A. Worker"},
                                         {"Manufacturer", "Maker"},
                                         {"Model", "Two"},
                                         {"Serial", "0012"}});
  EXPECT_EQ(x3p.acquisition_time, "2011-10-20T15:48:33");
  EXPECT_EQ(x3p.operator_name, "A. Worker");
  EXPECT_EQ(x3p.instrument, "Maker Two, serial number 0012");
  const ScanIdentity wsxm =
      identityFrom({{"General Info/Acquisition time", "20/11/2011, 20:23:46.484"},
                    {"General Info/Head type", "AFM"},
                    {"Miscellaneous/Dulcinea serial number", "24"}});
  EXPECT_EQ(wsxm.acquisition_time, "2011-11-20T20:23:46.484");
  EXPECT_EQ(wsxm.instrument, "AFM, serial number 24");
  const ScanIdentity wyko =
      identityFrom({{"Date", "7/7/2015"}, {"Time", "16:19:48"}, {"User Name", "ann"}});
  EXPECT_EQ(wyko.acquisition_time, "2015-07-07T16:19:48");
  EXPECT_EQ(wyko.operator_name, "ann");
}

TEST(FileStatements, WhatSaysThatNothingIsKnownIsNotStated) {
  const ScanIdentity none = identityFrom({{"Date", "1970-01-01T01:00:00"},
                                          {"Operator", " "},
                                          {"Serial", "not available"},
                                          {"Instrument", "Unknown"}});
  EXPECT_EQ(none.acquisition_time + none.operator_name + none.instrument, "");
}

TEST(FileStatements, AreShortLinesOfUtf8) {
  const ScanIdentity hostile = identityFrom({{"Operator", "\x1b[31mann\nbob\xff"},
                                             {"Instrument", std::string(1000000, 'a')},
                                             {"Acquisition time", std::string(1000000, '1')}});
  EXPECT_EQ(hostile.operator_name, "\\x1b[31mann; bob\xc3\xbf")
      << "a byte that is no UTF-8 is one of Latin-1";
  EXPECT_EQ(hostile.instrument.size(), 200u);
  EXPECT_EQ(hostile.instrument.substr(196), "a...");
  EXPECT_EQ(hostile.acquisition_time, "");
  std::string letters;
  for (int i = 0; i < 1000; ++i) letters += "\xc2\xb5";
  for (const std::string& before : {std::string(), std::string("a")}) {
    const std::string cut = identityFrom({{"Operator", before + letters}}).operator_name;
    EXPECT_LE(cut.size(), 200u);
    EXPECT_GE(cut.size(), 198u);
    EXPECT_EQ(cut.substr(0, cut.size() - 3), (before + letters).substr(0, cut.size() - 3));
    EXPECT_EQ((cut.size() - 3 - before.size()) % 2, 0u) << "no letter is cut in two";
  }
}

TEST(FileStatements, OfAGwyChannelAreThoseOfItsMetadata) {
  using namespace gwy_bytes;
  const std::string meta =
      object("/1/meta", "GwyContainer",
             text("Date", "20.10.2011") + integer("Count", 3) + text("Operator", "ann"));
  const auto channels =
      parseGwy(file(field("/0/data", 1, 1, {1e-9}) + field("/1/data", 1, 1, {1e-9}) + meta));
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_EQ(channels[0].identity.operator_name, "");
  EXPECT_EQ(channels[1].identity.operator_name, "ann");
  EXPECT_EQ(channels[1].identity.acquisition_time, "2011-10-20");
}

TEST(FileStatements, OfNanoscopeAreThoseOfItsFirstList) {
  const std::string header =
      "\\*File list\r\n\\Date: 01:33:51 PM Mon Dec 15 2014\r\n\\*Equipment list\r\n\\Microscope: "
      "Dimension V\r\n"
      "\\Serial Number: Hybrid 306  \r\n\\*Ciao image list\r\n\\Date: 01:33:51 PM Mon Dec 15 "
      "2015\r\n\x1a";
  const ScanIdentity identity = checkedNanoscope(header).identity;
  EXPECT_EQ(identity.acquisition_time, "2014-12-15T13:33:51");
  EXPECT_EQ(identity.instrument, "Dimension V, serial number Hybrid 306");
  EXPECT_EQ(checkedNanoscope("\\Date: 01:33:51 PM Mon Dec 15 2014").identity.acquisition_time, "")
      << "another file";
}

}  // namespace
}  // namespace mems_stiction
