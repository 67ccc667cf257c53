#pragma once

/// @file
/// The lines "key, sign, value" of a header in text.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mems_stiction {

/// The integer that a text begins with, blanks aside; none if it does not begin with digits or has
/// too many.
std::optional<std::uint64_t> countIn(const std::string& text);

/// Keys with their values, blanks around both cut off. Keys are compared without regard to case.
class HeaderLines {
 public:
  /// - @p separator between key and value; the first of a line counts
  HeaderLines(const std::string& text, const std::string& separator);

  bool has(const std::string& key) const { return times(key) > 0; }
  std::size_t times(const std::string& key) const;
  /// The first value; empty if there is none.
  std::string value(const std::string& key) const;
  /// The same as a count. @throw FileError without a file name if there is none
  std::uint64_t count(const std::string& key) const;

 private:
  std::map<std::string, std::vector<std::string>> values_;
};

}  // namespace mems_stiction
