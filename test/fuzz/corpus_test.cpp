/// The inputs of a corpus through the function that scripts/fuzz feeds, in the build of the other tests.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/fuzzing.hpp"

TEST(Corpus, holdsNothingThatIsAFinding) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(MEMS_STICTION_CORPUS)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ASSERT_GE(files.size(), 10u) << MEMS_STICTION_CORPUS;
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file);
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    EXPECT_NO_THROW(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
  }
  EXPECT_NO_THROW(LLVMFuzzerTestOneInput(nullptr, 0)) << "nothing at all";
}
