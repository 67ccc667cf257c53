#include "mems_stiction/ros/background_thread.hpp"

#include <sys/resource.h>

namespace mems_stiction {
namespace {

/// A tenth of the share of an ordinary thread: enough to notice a cancel on a machine that is overloaded.
constexpr int kNiceness = 10;

}  // namespace

void yieldToOtherThreads() {
  // On Linux niceness belongs to the thread, and 0 is the one that calls. Giving way is always allowed.
  setpriority(PRIO_PROCESS, 0, kNiceness);
}

}  // namespace mems_stiction
