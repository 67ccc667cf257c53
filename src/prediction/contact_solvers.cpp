#include "mems_stiction/prediction/contact_solvers.hpp"

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
    {"corrected", make<AsperitySolver, Formulation::kCorrected>},
    {"printed", make<AsperitySolver, Formulation::kPrinted>},
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

std::unique_ptr<ContactSolver> makeContactSolver(const std::string& formulation) {
  for (const Entry& entry : kSolvers) {
    if (formulation == entry.formulation) return entry.make();
  }
  OptionValidator validator;
  std::string name = formulation;  // choice() shows a mutable value; the validator only reads it
  validator.choice("approach/formulation", name, formulationNames(), "");
  throw OptionsError(validator.violations());
}

}  // namespace mems_stiction
