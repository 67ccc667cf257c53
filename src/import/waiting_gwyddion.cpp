#include "import/waiting_gwyddion.hpp"

#include <dlfcn.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "files/interruption.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// It needs none to convert files, and a folder of its own would stay where a process ends without cleaning up.
constexpr const char* kNoHome = "/dev/null";
constexpr std::size_t kLongestRequest = 16000;

/// The library that makes gwyddion wait, beside this one; empty if it is not there.
std::string preloadPath() {
  Dl_info place{};
  if (dladdr(reinterpret_cast<const void*>(&gwyddionArguments), &place) == 0 || place.dli_fname == nullptr) return "";
  const fs::path path = fs::path(place.dli_fname).parent_path() / "libmems_stiction_gwyddion.so";
  std::error_code error;
  return fs::is_regular_file(path, error) ? fs::absolute(path).string() : "";
}

/// Both ends of a connection, closed with the object; programs that are started do not inherit them.
class Connection {
 public:
  Connection() {
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends_) != 0) ends_[0] = ends_[1] = -1;
  }
  ~Connection() {
    closeFarEnd();
    if (ends_[0] >= 0) close(ends_[0]);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  int nearEnd() const { return ends_[0]; }
  int farEnd() const { return ends_[1]; }
  /// Then its other holder's end is seen at the near one.
  void closeFarEnd() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  int ends_[2];
};

}  // namespace

class WaitingGwyddion {
 public:
  explicit WaitingGwyddion(const std::string& program)
      : child_([&] {
          const std::string preload = preloadPath();
          if (preload.empty() || connection_.farEnd() < 0) return static_cast<pid_t>(-1);
          const char* others = std::getenv("LD_PRELOAD");
          const std::string all = others == nullptr || *others == '\0' ? preload : preload + ":" + others;
          return startChild(gwyddionArguments(program, "scan.gwy", kWaitingFileName),
                            gwyddionEnvironment(kNoHome, {"LD_PRELOAD=" + all}), "/dev/null", connection_.farEnd(),
                            "/");
        }) {
    connection_.closeFarEnd();
  }

  ~WaitingGwyddion() {
    if (child_.id() < 0) return;
    kill(-child_.id(), SIGKILL);
    while (waitpid(child_.id(), nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  WaitingGwyddion(const WaitingGwyddion&) = delete;
  WaitingGwyddion& operator=(const WaitingGwyddion&) = delete;

  /// @return none if it has ended, or never waited
  std::optional<ChildResult> read(const std::string& folder, const std::string& path, double timeout) {
    const std::string request = folder + '\0' + path + '\0';
    if (child_.id() < 0 || request.size() > kLongestRequest ||
        send(connection_.nearEnd(), request.data(), request.size(), MSG_NOSIGNAL) < 0) {
      return std::nullopt;
    }
    ChildResult result;
    result.started = true;
    const auto deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout));
    for (;;) {
      pollfd entry{connection_.nearEnd(), POLLIN, 0};
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
      const int ready = poll(&entry, 1, static_cast<int>(std::clamp<std::int64_t>(left, 0, 1 << 30)));
      if (ready > 0) break;
      if (ready == 0) {
        result.timed_out = true;
        return result;
      }
      if (errno != EINTR) return std::nullopt;
    }
    int status = 0;
    if (recv(connection_.nearEnd(), &status, sizeof status, 0) != sizeof status) return std::nullopt;
    setEnd(status, result);
    return result;
  }

 private:
  Connection connection_;
  RunningChild child_;
};

std::vector<std::string> gwyddionArguments(const std::string& program, const std::string& target,
                                           const std::string& file) {
  return {program, "--no-log-to-file", "--convert-to-gwy=" + target, file};
}

std::vector<std::string> gwyddionEnvironment(const std::string& home, std::vector<std::string> settings) {
  // Its threads take longer to start than a small file takes to read. Memory in large pages that stays with the process saves a
  // quarter of the time, which went into faults of small ones.
  settings.insert(settings.end(), {"HOME=" + home, "LC_ALL=C.UTF-8", "OMP_NUM_THREADS=1"});
  if (std::getenv("GLIBC_TUNABLES") == nullptr) {
    settings.emplace_back(
        "GLIBC_TUNABLES=glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=1073741824:"
        "glibc.malloc.trim_threshold=2147483648");
  }
  std::vector<std::string> names = {"DISPLAY", "WAYLAND_DISPLAY", "XDG_CONFIG_HOME", "LANGUAGE"};
  for (const std::string& setting : settings) names.push_back(setting.substr(0, setting.find('=')));
  return environmentWithout(names, settings);
}

WaitingGwyddions::WaitingGwyddions(std::string program) : program_(std::move(program)) {}
WaitingGwyddions::~WaitingGwyddions() = default;

std::unique_ptr<WaitingGwyddion> WaitingGwyddions::take() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!is_possible_) return nullptr;
    if (!idle_.empty()) {
      std::unique_ptr<WaitingGwyddion> one = std::move(idle_.back());
      idle_.pop_back();
      return one;
    }
  }
  return std::make_unique<WaitingGwyddion>(program_);
}

std::optional<ChildResult> WaitingGwyddions::read(const std::string& folder, const std::string& path, double timeout) {
  std::unique_ptr<WaitingGwyddion> one = take();
  if (!one) return std::nullopt;
  const std::optional<ChildResult> result = one->read(folder, path, timeout);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!result) {
    is_possible_ = false;  // another start would end in the same way
  } else if (!result->timed_out) {
    idle_.push_back(std::move(one));
  }
  return result;
}

}  // namespace mems_stiction
