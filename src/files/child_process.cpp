#include "files/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>

#include "files/interruption.hpp"

extern char** environ;

namespace mems_stiction {
namespace {

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (const std::string& text : texts) result.push_back(const_cast<char*>(text.c_str()));
  result.push_back(nullptr);
  return result;
}

/// Most memory that a child may map [bytes]: a damaged file must not take the machine's.
constexpr rlim_t kChildMemory = rlim_t{8} << 30;

/// A descriptor that can be read when the child has ended, closed with the object; invalid on old
/// kernels.
class ChildEnd {
 public:
  explicit ChildEnd(pid_t child)
      : descriptor_(static_cast<int>(syscall(SYS_pidfd_open, child, 0))) {}
  ~ChildEnd() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  ChildEnd(const ChildEnd&) = delete;
  ChildEnd& operator=(const ChildEnd&) = delete;

  /// Returns when the child has ended, or at the latest when the time is over; sooner without a
  /// descriptor.
  void await(std::chrono::milliseconds left) const {
    pollfd entry{descriptor_, POLLIN, 0};
    const auto time = descriptor_ >= 0 ? left : std::min(left, std::chrono::milliseconds(5));
    poll(&entry, descriptor_ >= 0 ? 1 : 0,
         static_cast<int>(std::clamp<std::int64_t>(time.count(), 0, 1 << 30)));
  }

 private:
  int descriptor_;
};

/// Waits until the child has ended or the deadline has passed. @return true if it has ended; it is
/// not reaped then
bool waitUntil(pid_t child, std::chrono::steady_clock::time_point deadline) {
  const ChildEnd end(child);
  for (;;) {
    siginfo_t information{};
    const int state =
        waitid(P_PID, static_cast<id_t>(child), &information, WEXITED | WNOHANG | WNOWAIT);
    if (state != 0 && errno != EINTR) return true;
    if (state == 0 && information.si_pid == child) return true;
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    if (left.count() <= 0) return false;
    end.await(left);
  }
}

/// While a RunningChild is made. @return the child's id, or -1 if it could not be started
pid_t startChild(const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment, const std::string& log_path) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log_path.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  // A process group of its own, so that a timeout also ends what the child has started; and default
  // signals, since the caller may block or ignore some.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigset_t all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);

  pid_t child = -1;
  const int error = posix_spawnp(&child, arguments.front().c_str(), &actions, &attributes,
                                 pointers(arguments).data(), pointers(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return -1;
  const rlimit no_core{0, 0};  // a crash must not leave a core file in the caller's folder
  prlimit(child, RLIMIT_CORE, &no_core, nullptr);
  const rlimit memory{kChildMemory, kChildMemory};
  prlimit(child, RLIMIT_AS, &memory, nullptr);
  return child;
}

}  // namespace

ChildResult runChild(const std::vector<std::string>& arguments,
                     const std::vector<std::string>& environment, const std::string& log_path,
                     double timeout) {
  const RunningChild running([&] { return startChild(arguments, environment, log_path); });
  const pid_t child = running.id();
  ChildResult result;
  if (child < 0) return result;
  result.started = true;
  const auto deadline = std::chrono::steady_clock::now() +
                        std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                            std::chrono::duration<double>(timeout));
  result.timed_out = !waitUntil(child, deadline);
  if (result.timed_out) kill(-child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (result.timed_out) return result;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  return result;
}

std::vector<std::string> environmentWithout(const std::vector<std::string>& names,
                                            const std::vector<std::string>& settings) {
  std::vector<std::string> result;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('='));
    if (std::find(names.begin(), names.end(), name) == names.end()) result.push_back(text);
  }
  result.insert(result.end(), settings.begin(), settings.end());
  return result;
}

}  // namespace mems_stiction
