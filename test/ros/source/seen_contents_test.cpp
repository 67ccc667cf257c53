/// The file that remembers which contents were published.

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"
#include "source/seen_contents.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

const FileStamp kStamp = {10, 20, 30};

TEST(SeenContents, ANewRunKnowsWhatAnEarlierOnePublishedAndPassedOver) {
  const ScratchFolder folder;
  const std::string path = folder.file("below/state");
  {
    SeenContents seen(path);
    EXPECT_TRUE(seen.isFirstStart());
    seen.notePassed("old with blanks\nand lines.di", kStamp);
    seen.noteBegun();
    seen.notePublished("sha256:ab", 77, "a.di", kStamp);
    EXPECT_EQ(seen.writeWaiting(), "");
  }
  const SeenContents seen(path);
  EXPECT_FALSE(seen.isFirstStart());
  EXPECT_TRUE(seen.knows("sha256:ab"));
  EXPECT_FALSE(seen.knows("-"));
  EXPECT_TRUE(seen.knowsFile("a.di", kStamp));
  EXPECT_TRUE(seen.knowsFile("old with blanks\nand lines.di", kStamp));
  EXPECT_FALSE(seen.knowsFile("a.di", {10, 21, 30}));
  EXPECT_EQ(seen.stamps(), std::vector<std::uint64_t>{77});
}

TEST(SeenContents, WhateverAKillHasCutOffTheLinesBeforeStay) {
  const ScratchFolder folder;
  {
    SeenContents seen(folder.file("state"));
    seen.noteBegun();
    seen.notePublished("sha256:ab", 77, "a.di", kStamp);
  }
  const std::string whole = ScratchFolder::read(folder.file("state"));
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const std::string path = folder.write("cut", whole.substr(0, size));
    {
      SeenContents seen(path);
      EXPECT_EQ(seen.knows("sha256:ab"), size == whole.size()) << size;
      EXPECT_EQ(seen.isFirstStart(), size < last) << size;
      seen.notePublished("sha256:cd", 78, "b.di", kStamp);
    }
    const SeenContents again(path);
    EXPECT_TRUE(again.knows("sha256:cd")) << size;
  }
}

/// What was published a moment ago may not have left when the process is killed.
TEST(SeenContents, AKillRightAfterPublishingRepeatsTheScanWithItsStamp) {
  const ScratchFolder folder;
  std::string left_by_a_kill;
  {
    SeenContents seen(folder.file("state"));
    seen.noteBegun();
    ASSERT_EQ(seen.noteSending("sha256:ab", 77), "");
    seen.notePublished("sha256:ab", 77, "a.di", kStamp);
    EXPECT_TRUE(seen.knows("sha256:ab"));
    EXPECT_EQ(seen.writeWaiting(), "");
    left_by_a_kill = ScratchFolder::read(folder.file("state"));
  }
  const SeenContents after(folder.write("killed", left_by_a_kill));
  EXPECT_FALSE(after.knows("sha256:ab"));
  EXPECT_EQ(after.stampOf("sha256:ab"), 77u);
  EXPECT_EQ(after.stamps(), std::vector<std::uint64_t>{77});
  const SeenContents ended(folder.file("state"));
  EXPECT_TRUE(ended.knows("sha256:ab"));
  EXPECT_EQ(ended.stampOf("sha256:ab"), 0u);
}

TEST(SeenContents, AFullDiskIsSaidAndMadeUpForLater) {
  const ScratchFolder folder;
  SeenContents seen(folder.file("state"));
  seen.noteBegun();
  ASSERT_EQ(seen.writeWaiting(), "");
  // A limit on the size of files stands for the disk.
  struct rlimit before {};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto old = std::signal(SIGXFSZ, SIG_IGN);
  const struct rlimit none = {100, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &none);
  const std::string failure = seen.noteSending("sha256:ab", 77);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old);
  EXPECT_NE(failure.find("cannot be written"), std::string::npos);
  EXPECT_EQ(seen.stampOf("sha256:ab"), 77u);
  EXPECT_EQ(seen.writeWaiting(), "");
  const std::string content = ScratchFolder::read(folder.file("state"));
  EXPECT_EQ(content.find("sending sha256:ab 77"), content.rfind("sending"));
}

TEST(SeenContents, OneProcessHasItAtATimeAndOtherFilesAreNotWrittenOver) {
  const ScratchFolder folder;
  const SeenContents seen(folder.file("state"));
  EXPECT_THROW(SeenContents(folder.file("state")), FileError);
  const std::string other =
      folder.write("notes.txt", "somebody's own words, which are longer than the first line\n");
  EXPECT_THROW(SeenContents{other}, FileError);
  EXPECT_EQ(ScratchFolder::read(other).size(), 59u);
  ASSERT_EQ(symlink(other.c_str(), folder.file("link").c_str()), 0);
  EXPECT_THROW(SeenContents(folder.file("link")), FileError);
}

}  // namespace
}  // namespace mems_stiction
