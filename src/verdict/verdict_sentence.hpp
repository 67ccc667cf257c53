#pragma once

/// @file
/// A verdict for people: the word, why, and what would make it surer.

#include <string>

#include "mems_stiction/verdict/verdict.hpp"

namespace mems_stiction {

/// "Does it stick? Marginal: margin 1.4, 95 % within 0.7 to 2.9: 1 lies within. Surer by ..."
std::string verdictSentence(const Verdict& verdict);

}  // namespace mems_stiction
