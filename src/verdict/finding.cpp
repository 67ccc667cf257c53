#include "verdict/finding.hpp"

#include <cmath>

#include "errors/short_number.hpp"

namespace mems_stiction {

int gravity(Sticks sticks) {
  switch (sticks) {
    case Sticks::kNo:
      return 0;
    case Sticks::kMarginal:
      return 1;
    case Sticks::kUnknown:
      return 2;
    case Sticks::kYes:
      break;
  }
  return 3;
}

bool isPeeled(const Verdict& verdict) {
  if (!verdict.governed_by.empty()) return verdict.governed_by == kGovernedByPeeling;
  if (std::isnan(verdict.margin)) return !std::isnan(verdict.peel_number);
  return verdict.peel_number < verdict.margin;
}

Finding judgedRatio(const std::string& name, double value, double lowest, double highest,
                    bool is_upper_bound, bool has_cleanings) {
  const std::string interval = name + " " + shortNumber(value) + ", 95 % within " +
                               shortNumber(lowest) + " to " + shortNumber(highest) +
                               (has_cleanings ? " (cleaning included)" : "");
  if (highest < 1.0) return {Sticks::kYes, interval + ": below 1"};
  if (is_upper_bound) {
    return {Sticks::kUnknown, "the surfaces bond, so adhesion is at least as predicted: " + name +
                                  " at most " + shortNumber(value) + ", but not safely below 1"};
  }
  if (lowest > 1.0) return {Sticks::kNo, interval + ": above 1"};
  return {Sticks::kMarginal, interval + ": 1 lies within"};
}

}  // namespace mems_stiction
