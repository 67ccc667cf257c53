#pragma once

/// @file
/// The word for a ratio of what opens to what holds, and the sentence that goes with it: the same
/// for one scan and for the scans of a part. And a verdict for people: the word, why, and what
/// would make it surer.

#include <string>

#include "mems_stiction/verdict/verdict.hpp"

namespace mems_stiction {

/// A word and its reason.
struct Finding {
  Sticks sticks = Sticks::kUnknown;
  std::string reason;
};

/// Which of two findings on one device counts: the larger. No, marginal, unknown, yes.
int gravity(Sticks sticks);

/// "margin 2.1, 95 % within 1.4 to 3.2: above 1", and its word.
/// - @p name of the ratio
/// - @p lowest, highest ends of its 95 % interval
/// - @p is_upper_bound the ratio is at most so much: the surfaces bond
/// - @p has_cleanings the interval knows how far the choice of cleaning moves it
Finding judgedRatio(const std::string& name, double value, double lowest, double highest,
                    bool is_upper_bound, bool has_cleanings);

/// Whether the peel number is what decides, not the margin: as governed_by says, else the one that
/// is known; where a spring and a beam are both stated, the smaller.
bool isPeeled(const Verdict& verdict);

/// "Does it stick? Marginal: margin 1.4, 95 % within 0.7 to 2.9: 1 lies within. Surer by ..."
std::string verdictSentence(const Verdict& verdict);

}  // namespace mems_stiction
