#include "mems_stiction/errors/errors.hpp"

#include <cstddef>
#include <utility>

namespace mems_stiction {
namespace {

/// More than there are settings: each of them may be wrong, but what has ten thousand wrong lines
/// is another thing.
constexpr std::size_t kMostLines = 400;

std::vector<std::string> firstOf(std::vector<std::string> lines) {
  if (lines.size() <= kMostLines) return lines;
  const std::size_t more = lines.size() - kMostLines;
  lines.resize(kMostLines);
  lines.push_back("and " + std::to_string(more) + " more");
  return lines;
}

std::string joinLines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    if (!text.empty()) text += '\n';
    text += line;
  }
  return text;
}

}  // namespace

OptionsError::OptionsError(std::vector<std::string> violations)
    : Error(joinLines(firstOf(violations))), violations_(firstOf(std::move(violations))) {}

}  // namespace mems_stiction
