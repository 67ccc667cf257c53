#include "files/input_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "mems_stiction/errors/errors.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

constexpr InputKind kFile = {"a list", 100'000};
constexpr InputKind kFileOrStream = {"a list", 100'000, true};

std::string refusal(const std::string& path, const InputKind& kind) {
  try {
    readInput(path, kind);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

/// What another process gets from the end that reads is written before.
class Pipe {
 public:
  explicit Pipe(const std::string& text) {
    if (pipe(ends_) != 0 ||
        write(ends_[1], text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
      throw FileError("no pipe");
    }
    close(ends_[1]);
  }
  ~Pipe() { close(ends_[0]); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  std::string path() const { return "/dev/fd/" + std::to_string(ends_[0]); }

 private:
  int ends_[2] = {-1, -1};
};

TEST(InputFile, AFileIsReadWholeAndMayBeEmpty) {
  const ScratchFolder folder;
  EXPECT_EQ(readInput(folder.write("some", std::string(100'000, 'x')), kFile),
            std::string(100'000, 'x'));
  EXPECT_EQ(readInput(folder.write("none", ""), kFile), "");
  EXPECT_EQ(readInputStart(folder.write("two", "ab"), kFile, 1), "a");
}

TEST(InputFile, WhatIsNoFileIsRefusedWithoutWaiting) {
  const ScratchFolder folder;
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const InputKind& kind : {kFile, kFileOrStream}) {
    EXPECT_EQ(refusal(pipe, kind), pipe + ": is a pipe, a socket or a device, not a file");
    EXPECT_EQ(refusal("/dev/zero", kind), "/dev/zero: is a pipe, a socket or a device, not a file");
    EXPECT_EQ(refusal("/tmp", kind), "/tmp: is a folder, not a list");
    const std::string missing = folder.file("missing");
    EXPECT_EQ(refusal(missing, kind), missing + ": there is no such file");
  }
}

TEST(InputFile, TooLargeAFileIsRefusedBeforeItIsRead) {
  const ScratchFolder folder;
  const std::string path = folder.write("large", "");
  std::filesystem::resize_file(path, std::uint64_t{1} << 40);  // a hole: no disk is used
  EXPECT_EQ(refusal(path, kFile),
            path + ": has 1099511627776 bytes, more than the 100000 of a list");
}

TEST(InputFile, WhatTheShellHasOpenedIsReadUpToTheLimitWhereItIsTaken) {
  const Pipe pipe("first\nsecond\n");
  EXPECT_EQ(refusal(pipe.path(), kFile),
            pipe.path() + ": is a pipe, a socket or a device, not a file");
  EXPECT_EQ(readInput(pipe.path(), kFileOrStream), "first\nsecond\n");
  EXPECT_EQ(readInput("/dev/null", kFileOrStream), "");
  const Pipe long_pipe("12345");
  EXPECT_EQ(refusal(long_pipe.path(), {"a list", 4, true}),
            long_pipe.path() + ": has more than the 4 bytes of a list");
}

}  // namespace
}  // namespace mems_stiction
