#pragma once

/// @file
/// The bytes of a scan file: regular files alone, none too large, opened without waiting for
/// anybody.

#include <cstdint>
#include <string>

namespace mems_stiction {

/// Largest file that is read [bytes].
constexpr std::uint64_t kMaxFileBytes = std::uint64_t{2} << 30;
/// Most pixels that a scan may have: a square of 10 000 x 10 000. Checked before memory is taken
/// for them.
constexpr std::uint64_t kMaxPixels = 100'000'000;

/// The whole file. @throw FileError naming it: missing, a folder, a pipe or device, empty, too
/// large, unreadable.
std::string readFileBytes(const std::string& path);

/// @throw FileError without a file name if there are no such pixels or too many of them.
void checkPixelCount(std::uint64_t cols, std::uint64_t rows);

}  // namespace mems_stiction
