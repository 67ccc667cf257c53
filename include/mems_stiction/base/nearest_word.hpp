#pragma once

/// @file
/// What a mistyped word may have meant.

#include <string>
#include <vector>

namespace mems_stiction {

/// Known words that the unknown one may have meant, as " (did you mean ...?)"; empty if none is near. Words with slashes
/// are near to all that share their last part.
std::string suggestion(const std::string& unknown, const std::vector<std::string>& known);

}  // namespace mems_stiction
