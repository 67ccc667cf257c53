#pragma once

/// @file
/// Memory for what is as large as the frame: in pages of 2 MiB where the system gives them on request, so that writing
/// to hundreds of places of it in turn does not wait for the addresses of pages.
///
///     LargePageVector<float> relief;  // a std::vector otherwise; small ones stay in ordinary pages

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace mems_stiction {

/// Allocator of std::vector that asks the system for large pages wherever one lies inside the memory of
/// std::allocator, so that no more memory is used. Throws what std::allocator does.
template <typename T>
class LargePageAllocator : public std::allocator<T> {
 public:
  /// The allocator of another type; that of std::allocator would forget the large pages.
  template <typename Other>
  struct rebind {
    using other = LargePageAllocator<Other>;
  };

  LargePageAllocator() = default;
  template <typename Other>
  LargePageAllocator(const LargePageAllocator<Other>& /*other*/) noexcept {}  // NOLINT(google-explicit-constructor)

  T* allocate(std::size_t count) {
    T* const memory = std::allocator<T>::allocate(count);
#if defined(MADV_HUGEPAGE)
    const auto first = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = (first + kLargePage - 1) / kLargePage * kLargePage;
    const std::uintptr_t end = (first + count * sizeof(T)) / kLargePage * kLargePage;
    // only advice: where it is not followed, everything works in ordinary pages
    if (begin < end) static_cast<void>(madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE));
#endif
    return memory;
  }

 private:
  static constexpr std::uintptr_t kLargePage = std::uintptr_t{1} << 21U;
};

template <typename T>
using LargePageVector = std::vector<T, LargePageAllocator<T>>;

}  // namespace mems_stiction
