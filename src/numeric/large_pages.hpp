#pragma once

/// @file
/// Memory for what is as large as the frame: in pages of 2 MiB where the system gives them on
/// request, so that writing to hundreds of places of it in turn does not wait for the addresses of
/// pages.
///
///     // a std::vector otherwise; small ones stay in ordinary pages
///     LargePageVector<float> relief;

#include <cstddef>
#include <memory>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace mems_stiction {

/// Allocator of std::vector that asks the system for large pages wherever one lies inside the
/// memory of std::allocator, so that no more memory is used. Throws what std::allocator does.
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
  LargePageAllocator(const LargePageAllocator<Other>& /*other*/) noexcept {
  }  // NOLINT(google-explicit-constructor)

  T* allocate(std::size_t count) {
    T* const memory = std::allocator<T>::allocate(count);
#if defined(MADV_HUGEPAGE)
    void* begin = memory;
    std::size_t bytes = count * sizeof(T);
    // only advice: where it is not followed, everything works in ordinary pages
    if (std::align(kLargePage, kLargePage, begin, bytes) != nullptr) {
      static_cast<void>(madvise(begin, bytes / kLargePage * kLargePage, MADV_HUGEPAGE));
    }
#endif
    return memory;
  }

 private:
  static constexpr std::size_t kLargePage = std::size_t{1} << 21U;
};

template <typename T>
using LargePageVector = std::vector<T, LargePageAllocator<T>>;

}  // namespace mems_stiction
