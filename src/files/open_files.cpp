#include "files/open_files.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace mems_stiction {
namespace {

/// A node, its topics to a page with four tabs, a recorder and some scripts, and what roscpp keeps.
constexpr rlim_t kEnough = 256;
constexpr rlim_t kWanted = 1024;

}  // namespace

void holdStandardDescriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // the lowest that is free: this one
    if (::open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY) != descriptor)
      return;
  }
}

std::string lackOfOpenFiles() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return "";
  if (limit.rlim_cur < kWanted && limit.rlim_cur < limit.rlim_max) {
    limit.rlim_cur = std::min(kWanted, limit.rlim_max);
    ::setrlimit(RLIMIT_NOFILE, &limit);
    ::getrlimit(RLIMIT_NOFILE, &limit);
  }
  if (limit.rlim_cur >= kEnough) return "";
  return "no more than " + std::to_string(limit.rlim_cur) +
         " files and connections may be open at once, and connections beyond that are refused: "
         "raise the limit to " +
         std::to_string(kEnough) +
         " or more (ulimit -n; LimitNOFILE= of a systemd service; docker --ulimit nofile)";
}

}  // namespace mems_stiction
