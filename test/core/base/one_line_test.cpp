#include "mems_stiction/base/one_line.hpp"

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

TEST(OneLine, LettersOfOtherLanguagesStay) {
  for (const char* text :
       {"5 \xc2\xb5m", "H\xc3\xb6he", "\xc3\x9c", "\xe2\x82\xac", "\xe9\xab\x98\xe3\x81\x95", "\xf0\x9f\x94\xac"}) {
    EXPECT_EQ(oneLine(text), text);
  }
}

}  // namespace
}  // namespace mems_stiction
