#include "files/output_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "mems_stiction/errors/errors.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

TEST(OutputFile, ReplacesTheFileAndKeepsItsMode) {
  const ScratchFolder folder;
  const std::string path = folder.write("out", "before");
  ASSERT_EQ(chmod(path.c_str(), 0640), 0);
  writeFile(path, "after");
  EXPECT_EQ(ScratchFolder::read(path), "after");
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640u);
  EXPECT_EQ(std::distance(
                std::filesystem::directory_iterator(std::filesystem::path(path).parent_path()), {}),
            1);
}

TEST(OutputFile, AFullDiskIsAnErrorThatNamesTheFile) {
  try {
    writeFile("/dev/full", std::string(100000, 'x'));
    FAIL();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "/dev/full: cannot be written: No space left on device");
  }
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(OutputFile, APipeThatNobodyReadsIsRefusedWithoutWaiting) {
  const ScratchFolder folder;
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(writeFile(pipe, "x"), FileError);
}

TEST(OutputFile, APipeThatTheShellHasOpenedIsWrittenTo) {
  int ends[2] = {-1, -1};
  ASSERT_EQ(::pipe(ends), 0);
  writeFile("/dev/fd/" + std::to_string(ends[1]), "x");
  char letter = 0;
  EXPECT_EQ(read(ends[0], &letter, 1), 1);
  EXPECT_EQ(letter, 'x');
  close(ends[0]);
  close(ends[1]);
}

TEST(OutputFile, AFolderThatIsMissingLeavesNothing) {
  const ScratchFolder folder;
  EXPECT_THROW(writeFile(folder.file("none/out"), "x"), FileError);
}

/// Somebody who guesses the name of the partial file lays a link there: the file behind it is not
/// ours.
TEST(OutputFile, IsNeverWrittenThroughALinkThatLiesBesideIt) {
  const ScratchFolder folder;
  const std::string path = folder.file("rows.csv");
  const std::string victim = folder.write("victim", "kept");
  const std::string guessed = path + "." + std::to_string(getpid()) + ".0";
  std::filesystem::create_symlink(victim, guessed);
  writeFile(path, "force\n");
  EXPECT_EQ(ScratchFolder::read(victim), "kept");
  EXPECT_EQ(ScratchFolder::read(path), "force\n");
  EXPECT_FALSE(std::filesystem::is_symlink(path));
  EXPECT_TRUE(std::filesystem::is_symlink(guessed));
}

TEST(OutputFile, ALinkStaysALinkAndTheFileBehindItIsReplaced) {
  const ScratchFolder folder;
  const std::string path = folder.write("rows.csv", "before");
  std::filesystem::create_symlink(path, folder.file("newest"));
  writeFile(folder.file("newest"), "after");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("newest")));
  EXPECT_EQ(ScratchFolder::read(path), "after");
}

}  // namespace
}  // namespace mems_stiction
