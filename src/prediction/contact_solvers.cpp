#include "mems_stiction/prediction/contact_solvers.hpp"

#include <array>
#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/paper/asperity_solver.hpp"
#include "mems_stiction/separation/separation_solver.hpp"

namespace mems_stiction {
namespace {

struct Entry {
  const char* formulation;
  std::unique_ptr<ContactSolver> (*make)();
  std::array<const char*, 6> ignored;  ///< keys of settings that have no meaning for it, and of what only they need
};

template <typename Solver, auto... Arguments>
std::unique_ptr<ContactSolver> make() {
  return std::make_unique<Solver>(Arguments...);
}

/// A line per solver, the default first.
constexpr Entry kSolvers[] = {
    {"separation_curve",
     make<SeparationSolver>,
     {"paper/step", "paper/cutoff_distance", "output/energy_curve", "uncertainty/hardness",
      "uncertainty/cutoff_distance"}},
    {"paper", make<AsperitySolver, Formulation::kPaper>, {}},
    {"printed", make<AsperitySolver, Formulation::kPrinted>, {}},
};

/// A line per setting that has no effect while another one is as it is.
struct Dependent {
  const char* key;
  bool (*is_ignored)(const std::string& formulation, const ContactSettings& settings);
  const char* why;
};

bool isDry(const std::string&, const ContactSettings& settings) { return settings.capillary.relative_humidity == 0.0; }

bool hasRange(const std::string& formulation, const ContactSettings& settings) {
  return formulation == kDefaultFormulation && settings.interface.work_of_adhesion > 0.0 &&
         settings.interface.hamaker_constant > 0.0;
}

constexpr const char* kDry = "interface/relative_humidity is 0";
constexpr Dependent kDependents[] = {
    {"interface/surface_tension", isDry, kDry},
    {"interface/contact_angle", isDry, kDry},
    {"interface/temperature", isDry, kDry},
    {"interface/molar_volume", isDry, kDry},
    {"interface/equilibrium_distance", hasRange, "work of adhesion and Hamaker constant tell the range of forces"},
};

struct Retired {
  const char* formulation;
  const char* successors;
};

/// A line per name that settings of earlier versions may hold.
constexpr Retired kRetired[] = {
    {"consistent", "its name is `separation_curve` now"},
    {"corrected", "`separation_curve` is the default, `paper` is nearest to what it was"},
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

std::vector<IgnoredSetting> ignoredSettings(const std::string& formulation, const ContactSettings& settings) {
  std::vector<IgnoredSetting> ignored;
  for (const Entry& entry : kSolvers) {
    if (formulation != entry.formulation) continue;
    for (const char* key : entry.ignored) {
      if (key == nullptr) break;
      ignored.push_back({key, "approach/formulation " + formulation + " does not use it"});
    }
    for (const Dependent& dependent : kDependents) {
      if (dependent.is_ignored(formulation, settings)) ignored.push_back({dependent.key, dependent.why});
    }
  }
  return ignored;
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
