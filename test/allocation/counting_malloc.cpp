/// malloc and its kin, in front of glibc's own, for one test executable: shared libraries find
/// these first.

#include <malloc.h>

#include <atomic>
#include <cerrno>
#include <cstddef>

#include "support/allocation_count.hpp"

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);
}

namespace {

std::atomic<bool> is_counting{false};
std::atomic<long> calls{0};
std::atomic<std::ptrdiff_t> held{0};
std::atomic<std::ptrdiff_t> peak{0};

void* counted(void* memory) {
  if (!is_counting || memory == nullptr) return memory;
  ++calls;
  const std::ptrdiff_t now = held += static_cast<std::ptrdiff_t>(malloc_usable_size(memory));
  std::ptrdiff_t highest = peak;
  while (now > highest && !peak.compare_exchange_weak(highest, now)) {
  }
  return memory;
}

void released(void* memory) {
  if (is_counting && memory != nullptr)
    held -= static_cast<std::ptrdiff_t>(malloc_usable_size(memory));
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) { return counted(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) { return counted(__libc_calloc(count, size)); }
void* realloc(void* memory, std::size_t size) {
  released(memory);
  return counted(__libc_realloc(memory, size));
}
void* memalign(std::size_t alignment, std::size_t size) {
  return counted(__libc_memalign(alignment, size));
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return counted(__libc_memalign(alignment, size));
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = counted(__libc_memalign(alignment, size));
  return *memory == nullptr ? ENOMEM : 0;
}
void free(void* memory) {
  released(memory);
  __libc_free(memory);
}

}  // extern "C"

namespace mems_stiction {

void startCountingAllocations() {
  calls = 0;
  held = 0;
  peak = 0;
  is_counting = true;
}

AllocationCount stopCountingAllocations() {
  is_counting = false;
  return {calls, peak};
}

}  // namespace mems_stiction
