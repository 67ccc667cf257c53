#pragma once

/// @file
/// Errors of the core: a small family, one class per thing a caller can do about it.
///
///     try {
///       use(readScanFile("scan.tiff"));
///     } catch (const FileError& error) {
///       report(error.what());
///     }

#include <stdexcept>
#include <string>
#include <vector>

namespace mems_stiction {

/// Base of every error that the core throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One or more settings are out of their range, unknown, or of the wrong type. what() has one line
/// per violation, each naming the key, the value and what is allowed.
class OptionsError : public Error {
 public:
  explicit OptionsError(std::vector<std::string> violations);
  const std::vector<std::string>& violations() const { return violations_; }

 private:
  std::vector<std::string> violations_;
};

/// A height map cannot be used: no valid pixel, sizes that do not match, a pitch that is not
/// positive.
class SurfaceError : public Error {
 public:
  using Error::Error;
};

/// A file cannot be read or written. what() names the file and the cause.
class FileError : public Error {
 public:
  using Error::Error;
};

}  // namespace mems_stiction
