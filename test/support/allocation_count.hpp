#pragma once

/// Counts what the process asks of the heap, by whatever road: operator new, malloc and OpenCV's
/// allocator.

#include <cstddef>

namespace mems_stiction {

struct AllocationCount {
  long calls = 0;           ///< malloc, calloc, realloc, aligned allocations
  std::ptrdiff_t peak = 0;  ///< largest number of bytes held beyond those held at the start
};

/// Starts a count of zero, for all threads.
void startCountingAllocations();
/// Ends it.
AllocationCount stopCountingAllocations();

}  // namespace mems_stiction
