#include "threads_inside.hpp"

#include <limits.h>
#include <pthread.h>
#include <pybind11/pybind11.h>
#include <stdlib.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdio>

namespace mems_stiction {
namespace python {
namespace {

std::atomic<int> thread_count{0};

/// The value of a thread that is counted says which round of destructors comes next.
void* roundValue(std::uintptr_t round) {
  return reinterpret_cast<void*>(round);  // NOLINT(performance-no-int-to-ptr): a number
}

pthread_key_t roundKey();

/// In the last of the rounds in which a thread that ends destroys what libraries keep for it.
void leave(void* value) {
  const auto round = reinterpret_cast<std::uintptr_t>(value);
  if (round < PTHREAD_DESTRUCTOR_ITERATIONS) {
    pthread_setspecific(roundKey(), roundValue(round + 1));
  } else {
    --thread_count;
  }
}

pthread_key_t roundKey() {
  static const pthread_key_t key = [] {
    pthread_key_t made = 0;
    pthread_key_create(&made, &leave);
    return made;
  }();
  return key;
}

bool isCounted() { return pthread_getspecific(roundKey()) != nullptr; }

/// The first of what exit() calls, since it was named last.
void leaveAtOnce(int status, void* /*unused*/) {
  if (thread_count <= (isCounted() ? 1 : 0)) return;
  std::fflush(nullptr);
  ::_exit(status);
}

}  // namespace

void countThisThread() {
  if (isCounted()) return;
  if (pthread_setspecific(roundKey(), roundValue(1)) == 0) ++thread_count;
}

void spareStaticObjects() {
  roundKey();
  Py_AtExit([] { on_exit(&leaveAtOnce, nullptr); });
}

}  // namespace python
}  // namespace mems_stiction
