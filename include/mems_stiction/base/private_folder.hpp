#pragma once

/// @file
/// A folder for files that nobody else may see, and that must not stay.

#include <filesystem>

#include "mems_stiction/base/interruption.hpp"

namespace mems_stiction {

/// A new folder below the system's temporary one, for this user alone. It goes with the object, and with an interruption.
class PrivateFolder {
 public:
  /// @throw FileError if it cannot be made
  PrivateFolder();
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  std::filesystem::path path() const { return scratch_.path(); }

 private:
  ScratchPath scratch_;
};

}  // namespace mems_stiction
