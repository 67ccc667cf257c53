#include "files/content_hash.hpp"

#include <gtest/gtest.h>

#include <string>

namespace mems_stiction {
namespace {

/// The first three are the examples of FIPS 180-4's publisher, NIST.
TEST(Sha256, IsThatOfThePublishedExamples) {
  EXPECT_EQ(sha256Text("abc"),
            "sha256:ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256Text(""),
            "sha256:e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256Text(std::string(1000000, 'a')),
            "sha256:cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, CountsEveryByteAlsoZeros) {
  EXPECT_NE(sha256Text(std::string("a\0b", 3)), sha256Text(std::string("a\0c", 3)));
  EXPECT_NE(sha256Text(std::string("a", 1)), sha256Text(std::string("a\0", 2)));
}

}  // namespace
}  // namespace mems_stiction
