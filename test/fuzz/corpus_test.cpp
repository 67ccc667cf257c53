/// The inputs of the corpus through the functions that scripts/fuzz feeds, in the build of the
/// other tests.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

using FeedInput = int (*)(const std::uint8_t* data, std::size_t size);

// Each NAME_fuzz.cpp defines its function under a name of its own here.
#define INPUT_OF(name) extern "C" int inputOf_##name(const std::uint8_t* data, std::size_t size);
#include "inputs.inc"
#undef INPUT_OF

namespace {

struct Reader {
  std::string name;
  FeedInput feed;
};

void PrintTo(const Reader& reader, std::ostream* stream) { *stream << reader.name; }

class Corpus : public testing::TestWithParam<Reader> {};

TEST_P(Corpus, holdsNothingThatIsAFinding) {
  const std::filesystem::path folder =
      std::filesystem::path(MEMS_STICTION_CORPUS) / GetParam().name;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ASSERT_GE(files.size(), 10u) << folder;
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file);
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream),
                                  std::istreambuf_iterator<char>()};
    EXPECT_NO_THROW(
        GetParam().feed(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
  }
  EXPECT_NO_THROW(GetParam().feed(nullptr, 0)) << "nothing at all";
}

#define INPUT_OF(name) Reader{#name, &inputOf_##name},
const std::vector<Reader> kReaders = {
#include "inputs.inc"
};
#undef INPUT_OF
INSTANTIATE_TEST_SUITE_P(Readers, Corpus, testing::ValuesIn(kReaders),
                         [](const auto& reader) { return reader.param.name; });

}  // namespace
