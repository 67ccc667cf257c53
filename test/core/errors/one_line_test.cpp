#include "errors/one_line.hpp"

#include <string>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

TEST(OneLine, NoControlCharacterIsLeft) {
  EXPECT_EQ(oneLine("a\x1b[2Jb\x7f"), "a\\x1b[2Jb\\x7f");
  EXPECT_EQ(oneLine("first\nsecond"), "first; second");
  EXPECT_EQ(oneLine("a\xc2\x9b"
                    "2Jb"),
            "a\\xc2\\x9b2Jb");  // CSI, in UTF-8
  EXPECT_EQ(oneLine("a\x9b"
                    "2Jb"),
            "a\\x9b2Jb");  // and in Latin-1
}

TEST(OneLine, BytesThatAreNoUtf8AreSpelledOut) {
  EXPECT_EQ(oneLine("H\xf6he"), "H\\xf6he");                       // Latin-1
  EXPECT_EQ(oneLine("\xe2\x82"), "\\xe2\\x82");                    // cut off
  EXPECT_EQ(oneLine("\xe2\x82\xc3\xb6"), "\\xe2\\x82\xc3\xb6");    // cut off, then a letter
  EXPECT_EQ(oneLine("\xc0\xaf"), "\\xc0\\xaf");                    // two bytes for one
  EXPECT_EQ(oneLine("\xe0\x80\xaf"), "\\xe0\\x80\\xaf");           // three
  EXPECT_EQ(oneLine("\xf0\x80\x80\xaf"), "\\xf0\\x80\\x80\\xaf");  // four
  EXPECT_EQ(oneLine("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // half a pair of UTF-16
  EXPECT_EQ(oneLine("\xf4\x90\x80\x80\xff"),
            "\\xf4\\x90\\x80\\x80\\xff");  // beyond the last letter
}

TEST(OneLine, LettersOfOtherLanguagesStay) {
  for (const char* text :
       {"5 \xc2\xb5m", "\xef\xbf\xbf", "\xf4\x8f\xbf\xbf", "H\xc3\xb6he", "\xc3\x9c",
        "\xe2\x82\xac", "\xe9\xab\x98\xe3\x81\x95", "\xf0\x9f\x94\xac"}) {
    EXPECT_EQ(oneLine(text), text);
  }
}

TEST(Shortened, KeepsTheBeginningAndWholeLetters) {
  EXPECT_EQ(shortened("12345", 5), "12345");
  EXPECT_EQ(shortened("123456", 5), "12345... (6 bytes)");
  EXPECT_EQ(shortened("1234\xC3\xA4", 5), "1234... (6 bytes)");
  EXPECT_EQ(shortened(std::string(5000000, 'a'), 3), "aaa... (5000000 bytes)");
}

}  // namespace
}  // namespace mems_stiction
