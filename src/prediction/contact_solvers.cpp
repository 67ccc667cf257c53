#include "mems_stiction/prediction/contact_solvers.hpp"

#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/equilibrium/asperity_solver.hpp"
#include "mems_stiction/separation/separation_solver.hpp"

namespace mems_stiction {
namespace {

struct Entry {
  const char* formulation;
  std::unique_ptr<ContactSolver> (*make)();
};

template <typename Solver, auto... Arguments>
std::unique_ptr<ContactSolver> make() {
  return std::make_unique<Solver>(Arguments...);
}

/// A line per solver, the default first.
constexpr Entry kSolvers[] = {
    {"consistent", make<SeparationSolver>},
    {"paper", make<AsperitySolver, Formulation::kPaper>},
    {"printed", make<AsperitySolver, Formulation::kPrinted>},
};

struct Retired {
  const char* formulation;
  const char* successors;
};

/// A line per name that settings of earlier versions may hold.
constexpr Retired kRetired[] = {
    {"corrected", "`consistent` is the default, `paper` is nearest to what it was"},
};

}  // namespace

const char* const kDefaultFormulation = kSolvers[0].formulation;

const std::vector<std::string>& formulationNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Entry& entry : kSolvers) all.emplace_back(entry.formulation);
    return all;
  }();
  return names;
}

std::string retirement(const std::string& formulation) {
  for (const Retired& entry : kRetired) {
    if (formulation == entry.formulation) {
      return "approach/formulation: '" + formulation + "' is no longer there: " + entry.successors;
    }
  }
  return "";
}

std::unique_ptr<ContactSolver> makeContactSolver(const std::string& formulation) {
  for (const Entry& entry : kSolvers) {
    if (formulation == entry.formulation) return entry.make();
  }
  OptionValidator validator;
  std::string name = formulation;  // choice() shows a mutable value; the validator only reads it
  validator.choice("approach/formulation", name, formulationNames(), "");
  std::vector<std::string> violations = validator.violations();
  const std::string reason = retirement(formulation);
  if (!reason.empty()) violations.push_back(reason);
  throw OptionsError(std::move(violations));
}

}  // namespace mems_stiction
