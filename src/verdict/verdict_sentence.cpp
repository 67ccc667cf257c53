#include "verdict/verdict_sentence.hpp"

#include <cmath>

#include "verdict/finding.hpp"

namespace mems_stiction {
namespace {

const char* capital(Sticks sticks) {
  constexpr const char* kWords[] = {"No", "Marginal", "Yes", "Not known"};
  return kWords[static_cast<int>(sticks)];
}

}  // namespace

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
