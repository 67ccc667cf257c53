/// Which files of a folder are whole.

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "source/folder_watch.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

constexpr double kSettle = 0.1;  // [s]

/// Names of the files that are whole once the watch has waited for `seconds` in all.
std::vector<std::string> wholeWithin(FolderWatch& watch, double seconds) {
  const auto end = FolderWatch::Clock::now() + std::chrono::duration<double>(seconds);
  std::vector<std::string> names;
  do {
    EXPECT_EQ(watch.look(), "");
    for (const FoundFile& file : watch.whole()) {
      names.push_back(file.name);
      watch.settle(file, false);
    }
    watch.wait(0.02);
  } while (FolderWatch::Clock::now() < end);
  return names;
}

FolderWatch watchOf(const ScratchFolder& folder, bool is_recursive = false) {
  return {fs::path(folder.file("")).parent_path().string(), is_recursive, kSettle, 0.05,
          [](const std::string& name) { return name.find(".yaml") == std::string::npos; }};
}

using Names = std::vector<std::string>;

TEST(FolderWatch, AFileThatStandsStillIsWholeOnce) {
  const ScratchFolder folder;
  FolderWatch watch = watchOf(folder);
  folder.write("a.txt", "1 2");
  EXPECT_EQ(wholeWithin(watch, 5 * kSettle), Names{"a.txt"});
  EXPECT_EQ(wholeWithin(watch, 3 * kSettle), Names{});
  folder.write("a.txt", "1 2 3");
  EXPECT_EQ(wholeWithin(watch, 5 * kSettle), Names{"a.txt"});
}

TEST(FolderWatch, AFileThatIsStillOpenForWritingIsNotWholeHoweverLongThePauses) {
  const ScratchFolder folder;
  FolderWatch watch = watchOf(folder);
  ASSERT_EQ(watch.look(), "");
  ASSERT_TRUE(watch.isTold());
  const int file = open(folder.file("grows.di").c_str(), O_WRONLY | O_CREAT, 0600);
  for (int piece = 0; piece < 3; ++piece) {
    ASSERT_EQ(write(file, "rows", 4), 4);
    EXPECT_EQ(wholeWithin(watch, 4 * kSettle), Names{});
  }
  close(file);
  EXPECT_EQ(wholeWithin(watch, 4 * kSettle), Names{"grows.di"});
}

TEST(FolderWatch, AFileThatIsRenamedIntoPlaceOrLinkedCounts) {
  const ScratchFolder folder, elsewhere;
  FolderWatch watch = watchOf(folder);
  ASSERT_EQ(watch.look(), "");
  fs::rename(elsewhere.write("x", "1"), folder.file("renamed"));
  fs::create_hard_link(folder.file("renamed"), folder.file("linked"));
  EXPECT_EQ(wholeWithin(watch, 5 * kSettle), (Names{"linked", "renamed"}));
}

TEST(FolderWatch, ASidecarThatComesAfterwardsIsWaitedForAndBringsItsScanBack) {
  const ScratchFolder folder;
  FolderWatch watch = watchOf(folder);
  folder.write("a.txt", "1 2");
  EXPECT_EQ(wholeWithin(watch, 5 * kSettle), Names{"a.txt"});
  folder.write("a.txt.yaml", "pitch_x: 1e-8");
  EXPECT_EQ(wholeWithin(watch, 5 * kSettle), Names{"a.txt"});
}

TEST(FolderWatch, NumberedScansDoNotBringEachOtherBack) {
  const ScratchFolder folder;
  FolderWatch watch = watchOf(folder);
  folder.write("s.001", "1");
  EXPECT_EQ(wholeWithin(watch, 4 * kSettle), Names{"s.001"});
  folder.write("s.002", "2");
  EXPECT_EQ(wholeWithin(watch, 4 * kSettle), Names{"s.002"});
}

TEST(FolderWatch, ARefusedFileComesBackWithWhatItLacked) {
  const ScratchFolder folder;
  FolderWatch watch = watchOf(folder);
  folder.write("m--1.Z_mtrx", "1");
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ASSERT_EQ(watch.look(), "");
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  ASSERT_EQ(watch.whole().size(), 1u);
  watch.settle(watch.whole().front(), true);
  folder.write("m.mtrx", "parameters");
  EXPECT_EQ(wholeWithin(watch, 5 * kSettle), (Names{"m--1.Z_mtrx", "m.mtrx"}));
}

TEST(FolderWatch, FoldersBelowCountIfAskedForAlsoThoseThatComeLater) {
  const ScratchFolder folder;
  FolderWatch watch = watchOf(folder, true);
  FolderWatch flat = watchOf(folder);
  ASSERT_EQ(watch.look(), "");
  fs::create_directories(folder.file("lot 7/part"));
  folder.write("lot 7/part/ä.di", "1");
  EXPECT_EQ(wholeWithin(watch, 5 * kSettle), Names{"lot 7/part/ä.di"});
  EXPECT_EQ(wholeWithin(flat, 3 * kSettle), Names{});
}

TEST(FolderWatch, AFolderThatIsGoneIsSaidAndNothingIsForgotten) {
  const ScratchFolder outer;
  fs::create_directory(outer.file("share"));
  FolderWatch watch(outer.file("share"), false, kSettle, 0.05,
                    [](const std::string&) { return true; });
  outer.write("share/a", "1");
  outer.write("share/b", "1");
  ASSERT_EQ(watch.look(), "");
  EXPECT_EQ(watch.waiting().size(), 2u);
  fs::rename(outer.file("share"), outer.file("away"));
  EXPECT_NE(watch.look().find("cannot be read"), std::string::npos);
  EXPECT_EQ(watch.waiting().size(), 2u);
  fs::rename(outer.file("away"), outer.file("share"));
  fs::remove(outer.file("share/b"));
  EXPECT_EQ(wholeWithin(watch, 5 * kSettle), Names{"a"});
  EXPECT_EQ(watch.gone(), 1u);
}

}  // namespace
}  // namespace mems_stiction
