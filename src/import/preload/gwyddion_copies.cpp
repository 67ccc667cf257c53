/// Loaded into the program gwyddion before its own libraries (LD_PRELOAD), so that one start serves many files: where
/// gwyddion would read its first file, it stays, and each request on its standard input makes a copy of it that reads one.
/// A copy that crashes ends itself alone; the next one begins as fresh as the first.
///
/// Request, one message: the folder to work in, NUL, the path of the scan, NUL. Answer: the copy's end as of waitpid().

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace {

constexpr std::size_t kLongestRequest = 16384;
char request[kLongestRequest];  // static: the copy's file name must outlive the function

using Load = void* (*)(const char*, int, void**);

/// From here on the copy is a gwyddion that was called for this one file. @return the file; null if it cannot begin
const char* becomeCopy() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const char* folder = request;
  const int log = chdir(folder) == 0 ? open("log", O_WRONLY | O_CREAT | O_TRUNC, 0600) : -1;
  const int nothing = open("/dev/null", O_RDONLY);
  if (log < 0 || nothing < 0) return nullptr;
  dup2(nothing, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  return request + std::strlen(folder) + 1;
}

}  // namespace

/// Stands before the function of libgwymodule with this name.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" void* gwy_file_load(const char*, int mode, void** error) {
  const auto load = reinterpret_cast<Load>(dlsym(RTLD_NEXT, "gwy_file_load"));
  if (load == nullptr) _exit(127);
  for (;;) {
    const ssize_t size = recv(STDIN_FILENO, request, kLongestRequest - 2, 0);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) _exit(0);
    request[size] = request[size + 1] = '\0';
    const pid_t copy = fork();
    if (copy == 0) {
      const char* path = becomeCopy();
      if (path == nullptr) _exit(127);
      return load(path, mode, error);
    }
    int status = 127 << 8;
    while (copy > 0 && waitpid(copy, &status, 0) < 0 && errno == EINTR) {
    }
    if (send(STDIN_FILENO, &status, sizeof status, MSG_NOSIGNAL) != sizeof status) _exit(0);
  }
}
