#include "ros/background_thread.hpp"

#include <algorithm>

#include <sys/resource.h>

namespace mems_stiction {
namespace {

/// A tenth of the share of an ordinary thread: enough to notice a cancel on a machine that is
/// overloaded.
constexpr int kNiceness = 10;
constexpr int kNicest = 19;

/// Gives way when it is made. On Linux niceness belongs to the thread, and 0 is the one that calls.
struct Yield {
  Yield() {
    setpriority(PRIO_PROCESS, 0, std::min(getpriority(PRIO_PROCESS, 0) + kNiceness, kNicest));
  }
};

}  // namespace

void yieldToOtherThreads() { thread_local const Yield once; }

}  // namespace mems_stiction
