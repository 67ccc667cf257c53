#pragma once

/// @file
/// Which dales have come together in one patch. Each patch bears the number of one of its dales;
/// the dales of a patch form a ring, so that the fewer are renamed when two patches meet, and
/// asking costs one look.

#include <cstdint>
#include <utility>
#include <vector>

namespace mems_stiction {

/// A union-find over dales.
class JoinedDales {
 public:
  /// No dale is known.
  void clear() {
    patch_.clear();
    next_.clear();
    size_.clear();
  }
  /// The dales up to `count` are known; the new ones are patches of their own.
  void growTo(int count) {
    size_.resize(static_cast<std::size_t>(count), 1);
    for (auto dale = static_cast<std::int32_t>(patch_.size()); dale < count; ++dale) {
      patch_.push_back(dale);
      next_.push_back(dale);
    }
  }
  int count() const { return static_cast<int>(patch_.size()); }

  /// Of a dale.
  std::int32_t patchOf(std::int32_t dale) const { return patch_[static_cast<std::size_t>(dale)]; }

  /// Puts the dales of two patches together.
  /// @return the patch that stays: that of more dales, or `a` if they have as many
  std::int32_t unite(std::int32_t a, std::int32_t b) {
    if (size_[static_cast<std::size_t>(a)] < size_[static_cast<std::size_t>(b)]) std::swap(a, b);
    size_[static_cast<std::size_t>(a)] += size_[static_cast<std::size_t>(b)];
    std::int32_t dale = b;
    do {
      patch_[static_cast<std::size_t>(dale)] = a;
      dale = next_[static_cast<std::size_t>(dale)];
    } while (dale != b);
    std::swap(next_[static_cast<std::size_t>(a)], next_[static_cast<std::size_t>(b)]);
    return a;
  }

 private:
  std::vector<std::int32_t> patch_;
  std::vector<std::int32_t> next_;  ///< the next dale of the same patch
  std::vector<std::int32_t> size_;  ///< per patch: number of dales
};

}  // namespace mems_stiction
