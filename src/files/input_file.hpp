#pragma once

/// @file
/// Files that a person names are read without waiting for anybody and without end: none too large,
/// no device.

#include <cstdint>
#include <string>

namespace mems_stiction {

/// The path of what the shell has opened, perhaps a pipe: /dev/stdin, /dev/stdout, /dev/fd/... and
/// so on.
bool isOpenStream(const std::string& path);

/// What a file is read as.
struct InputKind {
  const char* name;                 ///< with its article, as in "a scan"
  std::uint64_t max_bytes;          ///< of the largest that is read
  bool takes_open_streams = false;  ///< also /dev/null and what isOpenStream()
};

/// Settings: a configuration, or what stands beside a scan.
constexpr InputKind kSettingsInput = {"a configuration file", 1'000'000, true};

/// The whole file; may be empty. @throw FileError naming it: missing, a folder, a pipe or device,
/// too large, unreadable.
std::string readInput(const std::string& path, const InputKind& kind);

/// At most the first `count` bytes. @throw FileError as readInput()
std::string readInputStart(const std::string& path, const InputKind& kind, std::uint64_t count);

/// A file as it was at one moment.
struct FileState {
  std::uint64_t size = 0;  ///< [bytes]
  std::string time;        ///< of its last change, UTC, "2026-01-31T12:00:00.123456789Z"
  std::string checksum;    ///< contentHash() of it; empty where there is no file that can be read
};

/// Of a file of any size; no error where there is none.
FileState fileState(const std::string& path);

}  // namespace mems_stiction
