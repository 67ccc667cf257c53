#include "files/open_files.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>

namespace mems_stiction {
namespace {

rlim_t openFiles() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  return limit.rlim_cur;
}

void allowOpenFiles(rlim_t soft, rlim_t hard) {
  const rlimit limit{soft, hard};
  setrlimit(RLIMIT_NOFILE, &limit);
}

// Each in a process of its own: a hard limit cannot be raised again.

TEST(OpenFiles, TheLimitIsRaisedAsFarAsItMay) {
  EXPECT_EXIT(
      {
        allowOpenFiles(64, 300);
        std::exit(lackOfOpenFiles().empty() && openFiles() == 300 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(OpenFiles, AHardLimitThatIsTooLowIsSaidWithWhatToDo) {
  EXPECT_EXIT(
      {
        allowOpenFiles(64, 64);
        const std::string said = lackOfOpenFiles();
        const bool is_named = said.find("no more than 64 ") != std::string::npos &&
                              said.find("ulimit -n") != std::string::npos;
        std::exit(is_named ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(OpenFiles, AHigherLimitStays) {
  EXPECT_EXIT(
      {
        rlimit limit{};
        getrlimit(RLIMIT_NOFILE, &limit);
        if (limit.rlim_max < 2000) std::exit(0);
        allowOpenFiles(2000, limit.rlim_max);
        std::exit(lackOfOpenFiles().empty() && openFiles() == 2000 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace mems_stiction
