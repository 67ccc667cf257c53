#pragma once

/// @file
/// Settings that are stated and do nothing: those of another solver, of a step that is off, of a
/// surface of another type.

#include <string>
#include <vector>

#include "mems_stiction/configuration/configuration.hpp"

namespace mems_stiction {

/// One sentence for each setting that is not its default but has no effect, with the reason.
std::vector<std::string> idleSettings(const Configuration& configuration);

}  // namespace mems_stiction
