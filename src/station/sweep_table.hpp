#pragma once

/// @file
/// A sweep as people read it: a table with a row for each load, and what its loops say.

#include <string>

#include "station/load_sweep.hpp"

namespace mems_stiction {

/// Lines, each with the indent before it and a line end.
std::string sweepTable(const LoadSweepResult& sweep, const std::string& indent);

}  // namespace mems_stiction
