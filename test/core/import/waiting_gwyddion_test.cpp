/// One gwyddion for many files: each is read as if by a process of its own, whatever the others were.

#include "import/waiting_gwyddion.hpp"
#include "import/format_readers.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/gwy_bytes.hpp"
#include "support/scan_bytes.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

class WaitingGwyddion : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v gwyddion >/dev/null 2>&1") != 0) GTEST_SKIP() << "needs the program gwyddion";
  }

  /// The largest height of the file that a copy makes of this one [m]; NaN if it makes none.
  double largestOf(const std::string& name, const std::string& bytes) {
    const ScratchFolder folder;
    const auto result = programs_.read(fs::path(folder.file("")).parent_path(), folder.write(name, bytes), 20.0);
    if (!result || !fs::exists(folder.file("scan.gwy"))) return std::nan("");
    double largest = 0.0;
    cv::minMaxLoc(parseGwy(ScratchFolder::read(folder.file("scan.gwy"))).at(0).values, nullptr, &largest);
    return largest;
  }

  ScratchFolder folder_;
  WaitingGwyddions programs_{"gwyddion"};
};

std::string image(const std::string& amplitude = "5 nm") {
  return scan_bytes::wsxm("double", "2 nm", amplitude, scan_bytes::wsxmDoubles());
}

TEST_F(WaitingGwyddion, ReadsOneFileAfterTheOther) {
  EXPECT_NEAR(largestOf("a.stp", image()), 5e-9, 1e-20);
  EXPECT_NEAR(largestOf("b.stp", image("5 um")), 5e-6, 1e-17) << "nothing of the file before";
  EXPECT_TRUE(std::isnan(largestOf("c.di", "\\*File list\r\n")));
  EXPECT_NEAR(largestOf("a.stp", image()), 5e-9, 1e-20);
}

/// Processes whose parent is this one.
std::vector<pid_t> childrenOf(pid_t parent) {
  std::ifstream list("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children");
  return {std::istream_iterator<pid_t>(list), {}};
}

TEST_F(WaitingGwyddion, ACopyThatEndsBetweenTwoFilesIsFollowedByAnother) {
  EXPECT_NEAR(largestOf("a.stp", image()), 5e-9, 1e-20);
  const std::vector<pid_t> waiting = childrenOf(getpid());
  ASSERT_EQ(waiting.size(), 1u);
  const std::vector<pid_t> copies = childrenOf(waiting.front());
  ASSERT_EQ(copies.size(), 1u) << "the one that has read waits for more";
  ASSERT_EQ(kill(copies.front(), SIGKILL), 0);
  EXPECT_NEAR(largestOf("b.stp", image("5 um")), 5e-6, 1e-17);
  EXPECT_NEAR(largestOf("a.stp", image()), 5e-9, 1e-20) << "each answer belongs to its request";
}

TEST_F(WaitingGwyddion, ServesSeveralThreads) {
  std::vector<double> largest(6, 0.0);
  std::vector<std::thread> threads;
  for (double& one : largest) threads.emplace_back([this, &one] { one = largestOf("a.stp", image()); });
  for (std::thread& thread : threads) thread.join();
  for (const double one : largest) EXPECT_NEAR(one, 5e-9, 1e-20);
}

TEST_F(WaitingGwyddion, AFileThatHangsIsLeftAndTheNextIsRead) {
  const std::string pipe = folder_.file("a.stp");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto result = programs_.read(fs::path(pipe).parent_path(), pipe, 0.5);
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(result->timed_out);
  EXPECT_NEAR(largestOf("a.stp", image()), 5e-9, 1e-20);
}

TEST_F(WaitingGwyddion, SaysOfADamagedFileWhatAProcessOfItsOwnSays) {
  ScanFileOptions options;
  const std::string path = folder_.write("a.di", "\\*File list\r\n\\Version: 0x1\r\n\\Data length: 1\r\n");
  const auto complaint = [&] {
    try {
      openScanFile(path, {}, options);
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string alone = complaint();
  EXPECT_NE(alone, "");
  options.import.waiting = std::make_shared<WaitingGwyddions>("gwyddion");
  EXPECT_EQ(complaint(), alone);
}

TEST(WaitingPrograms, AProgramThatDoesNotWaitIsStartedForEachFile) {
  const ScratchFolder folder;
  folder.write("made.gwy", gwy_bytes::example());
  ScanFileOptions options;
  options.import.program = folder.write("program", "#!/bin/sh\necho \"$2\" >> " + folder.file("calls") + "\ncp " +
                                                       folder.file("made.gwy") + " \"${2#--convert-to-gwy=}\"\n");
  fs::permissions(options.import.program, fs::perms::owner_all);
  options.import.waiting = std::make_shared<WaitingGwyddions>(options.import.program);
  const std::string path = folder.write("scan.di", "anything");
  EXPECT_EQ(readScanFile(path, {}, options).height(0, 0), 1e-9);
  EXPECT_EQ(readScanFile(path, {}, options).height(0, 0), 1e-9);
  EXPECT_FALSE(fs::exists("scan.gwy")) << "of the call that was to wait";
}

}  // namespace
}  // namespace mems_stiction
