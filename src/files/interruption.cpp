#include "files/interruption.hpp"

#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <mutex>
#include <set>
#include <string>
#include <system_error>
#include <thread>

#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

/// Held by whoever makes or removes an entry; by the last interruption until the process has ended.
struct Registry {
  std::mutex mutex;
  std::set<pid_t> children;
  std::set<std::string> paths;
  bool has_line = false;  ///< on the terminal of the standard error
};

/// Never destroyed: an interruption may come while the process ends.
Registry& registry() {
  static auto* one = new Registry;
  return *one;
}

void writeLine(const std::string& text) {
  const std::string whole = "\r\033[K" + text;
  // a terminal that has gone shows nothing
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, whole.data(), whole.size());
}

/// Until no process of the child's group is left that could still write, on a busy machine, too; 2
/// s at most.
void awaitEnd(pid_t child) {
  for (int waited = 0; waited < 2000; ++waited) {
    waitpid(child, nullptr, WNOHANG);
    if (kill(-child, 0) != 0) return;
    usleep(1000);
  }
}

void cleanUp() {
  if (registry().has_line) writeLine("");
  for (const pid_t child : registry().children) kill(-child, SIGKILL);
  for (const pid_t child : registry().children) awaitEnd(child);
  for (const std::string& path : registry().paths) {
    // What a child had begun to write may appear only now: once more, then.
    std::error_code error;
    for (int attempt = 0; attempt < 3; ++attempt) {
      std::filesystem::remove_all(path, error);
      if (!error) break;
      usleep(1000);
    }
  }
}

}  // namespace

void cleanUpWhenInterrupted() {
  signal(SIGXFSZ, SIG_IGN);
  sigset_t awaited;
  sigemptyset(&awaited);
  bool is_any = false;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction current {};
    if (sigaction(number, nullptr, &current) != 0 || current.sa_handler == SIG_IGN) continue;
    sigaddset(&awaited, number);
    is_any = true;
  }
  if (!is_any) return;
  pthread_sigmask(SIG_BLOCK, &awaited, nullptr);  // in every thread that is started from now on
  std::thread([awaited] {
    int number = 0;
    if (sigwait(&awaited, &number) != 0) return;
    registry().mutex.lock();  // for good: nothing may be started any more
    cleanUp();
    signal(number, SIG_DFL);
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, number);
    pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
    kill(getpid(), number);
    pause();
  }).detach();
}

void writeInPlace(const std::string& text) {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  registry().has_line = !text.empty();
  writeLine(text);
}

ScratchPath::ScratchPath(const std::function<std::string()>& make) {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  path_ = make();
  registry().paths.insert(path_);
}

ScratchPath::~ScratchPath() {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  registry().paths.erase(path_);
}

PrivateFolder::PrivateFolder()
    : scratch_([] {
        std::string pattern =
            (std::filesystem::temp_directory_path() / "mems_stiction.XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr)
          throw FileError(pattern + ": the temporary folder cannot be made");
        return pattern;
      }) {}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(scratch_.path(), ignored);
}

RunningChild::RunningChild(const std::function<pid_t()>& start) {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  id_ = start();
  if (id_ > 0) registry().children.insert(id_);
}

RunningChild::~RunningChild() {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  registry().children.erase(id_);
}

}  // namespace mems_stiction
