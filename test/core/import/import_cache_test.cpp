#include "import/import_cache.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>

#include "mems_stiction/import/scan_file.hpp"
#include "support/gwy_bytes.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

/// A converter that counts its calls and always gives the same container.
class ImportCache : public ::testing::Test {
 protected:
  void SetUp() override {
    setenv("XDG_CACHE_HOME", folder_.file("cache").c_str(), 1);
    folder_.write("made.gwy", gwy_bytes::example());
    options_.import.program = folder_.write("program", "#!/bin/sh\necho called >> " + folder_.file("calls") + "\ncp " +
                                                           folder_.file("made.gwy") + " \"${2#--convert-to-gwy=}\"\n");
    fs::permissions(options_.import.program, fs::perms::owner_all);
    options_.import.use_cache = true;
  }
  double heightOf(const std::string& content) const {
    return readScanFile(folder_.write("scan.di", content), {}, options_).height(0, 0);
  }
  std::size_t calls() const {
    const std::string text = ScratchFolder::read(folder_.file("calls"));
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }

  ScratchFolder folder_;
  ScanFileOptions options_;
};

TEST_F(ImportCache, TheSameContentIsConvertedOnce) {
  EXPECT_EQ(heightOf("one"), 1e-9);
  EXPECT_EQ(heightOf("one"), 1e-9);
  EXPECT_EQ(calls(), 1u);
  heightOf("two");
  EXPECT_EQ(calls(), 2u) << "another content under the same name";
}

TEST_F(ImportCache, CanBeSwitchedOffAndCleared) {
  heightOf("one");
  clearImportCache();
  heightOf("one");
  EXPECT_EQ(calls(), 2u);
  options_.import.use_cache = false;
  heightOf("one");
  EXPECT_EQ(calls(), 3u);
}

TEST_F(ImportCache, WhatIsNotAsItWasKeptIsConvertedAgain) {
  heightOf("one");
  int damaged = 0;
  for (const auto& entry : fs::directory_iterator(*importCacheFolder())) {
    std::string bytes = ScratchFolder::read(entry.path().string());
    bytes[bytes.size() - 20] = static_cast<char>(bytes[bytes.size() - 20] ^ 1);
    std::ofstream(entry.path(), std::ios::binary) << bytes;
    ++damaged;
  }
  EXPECT_EQ(damaged, 1);
  EXPECT_EQ(heightOf("one"), 1e-9);
  EXPECT_EQ(calls(), 2u);
}

TEST_F(ImportCache, WhatOlderReadersKeptIsNotFound) {
  const auto key = [&](const std::string& readers) {
    return importCacheKey("bytes", ".di", options_.import.program, readers);
  };
  EXPECT_EQ(key(readerVersion()), key(readerVersion()));
  EXPECT_NE(key(readerVersion()), key("0123456789abcdef"));
  EXPECT_EQ(readerVersion().size(), 16u);
}

TEST_F(ImportCache, AnotherVersionOfTheProgramConvertsAnew) {
  heightOf("one");
  fs::last_write_time(options_.import.program, fs::file_time_type::clock::now() + std::chrono::hours(1));
  heightOf("one");
  EXPECT_EQ(calls(), 2u);
}

}  // namespace
}  // namespace mems_stiction
