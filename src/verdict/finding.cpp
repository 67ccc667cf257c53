#include "verdict/finding.hpp"

#include <cmath>

#include "errors/short_number.hpp"

namespace mems_stiction {
namespace {

const char* capital(Sticks sticks) {
  constexpr const char* kWords[] = {"No", "Marginal", "Yes", "Not known"};
  return kWords[static_cast<int>(sticks)];
}

}  // namespace

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

std::string verdictSentence(const Verdict& verdict) {
  std::string text =
      std::string("Does it stick? ") + capital(verdict.sticks) + ": " + verdict.reason + ".";
  if (verdict.sticks != Sticks::kMarginal || std::isnan(verdict.surface_reach)) return text;
  const double ratio = isPeeled(verdict) ? verdict.peel_number_upper / verdict.peel_number_lower
                                         : verdict.margin_upper / verdict.margin_lower;
  const double reach = 0.5 * std::log(ratio);  // of the whole interval, to either side
  const bool is_of_surfaces = 2.0 * verdict.surface_reach * verdict.surface_reach > reach * reach;
  return text + " Surer by " +
         (is_of_surfaces ? "more scans of other places"
                         : "a work of adhesion that was measured (calibrate)") +
         ".";
}

}  // namespace mems_stiction
