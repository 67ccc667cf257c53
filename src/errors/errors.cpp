#include "mems_stiction/errors/errors.hpp"

#include <utility>

namespace mems_stiction {
namespace {

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
    : Error(joinLines(violations)), violations_(std::move(violations)) {}

}  // namespace mems_stiction
