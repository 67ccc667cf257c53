#pragma once

/// @file
/// The answer on one scan for people: status, force, verdict, flags in words, warnings. record.hpp
/// has every figure, for scripts.

#include <string>

#include "evaluation/record.hpp"

namespace mems_stiction {

/// Lines of text; numbers are rounded to what is known. Tables of convergence, cleanings and sweep
/// follow where the extras have them.
/// - @p file the scan's name, as the user wrote it
/// - @p has_colours by the codes of ECMA-48 (SGR), for terminals
std::string shortRecord(const std::string& file, const HeightMap& scan,
                        const Prediction& prediction, const RecordExtras& extras, bool has_colours);

}  // namespace mems_stiction
