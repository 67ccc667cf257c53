#include "files/content_hash.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "files/input_file.hpp"

namespace mems_stiction {
namespace {

std::string bytesOf(std::size_t count) {
  std::string bytes(count, '\0');
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<char>(37 * i + i / 256);
  return bytes;
}

TEST(ContentHash, isTheSameInWhateverPiecesTheContentComes) {
  for (const std::size_t size : {0u, 1u, 7u, 8u, 9u, 64u, 1000u}) {
    const std::string bytes = bytesOf(size);
    for (const std::size_t piece : {1u, 3u, 8u, 13u, 999u}) {
      ContentHash hash;
      for (std::size_t at = 0; at < size; at += piece)
        hash.add(std::string_view(bytes).substr(at, piece));
      EXPECT_EQ(hash.text(), contentHash(bytes)) << size << " in " << piece;
    }
  }
}

TEST(ContentHash, oneByteOrOneZeroMoreIsAnother) {
  const std::string bytes = bytesOf(20);
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string other = bytes;
    other[at] = static_cast<char>(other[at] + 1);
    EXPECT_NE(contentHash(other), contentHash(bytes)) << at;
  }
  EXPECT_NE(contentHash(bytes + '\0'), contentHash(bytes));
  EXPECT_NE(contentHash(""), contentHash(std::string(8, '\0')));
}

TEST(FileState, isOfTheContentAndEmptyWhereNoFileIs) {
  std::string folder = testing::TempDir() + "content_hash_XXXXXX";
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const std::string path = folder + "/large";
  const std::string bytes = bytesOf((3u << 20) + 5);
  std::ofstream(path, std::ios::binary) << bytes;
  const FileState state = fileState(path);
  EXPECT_EQ(state.size, bytes.size());
  EXPECT_EQ(state.checksum, contentHash(bytes));
  EXPECT_EQ(state.time.size(), std::string("2026-01-31T12:00:00.123456789Z").size()) << state.time;
  for (const std::string& none : {folder, folder + "/none", std::string("/dev/zero")}) {
    EXPECT_TRUE(fileState(none).checksum.empty()) << none;
  }
  std::filesystem::remove_all(folder);
}

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
