#include "prediction/contact_solvers.hpp"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <utility>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/paper/paper_options.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "paper/asperity_solver.hpp"
#include "separation/separation_solver.hpp"
#include "settings/option_values.hpp"

namespace mems_stiction {
namespace {

using DescribeOwn = void (*)(SolverSettings&, OptionVisitor&);

struct Entry {
  const char* formulation;
  std::unique_ptr<ContactSolver> (*make)();
  std::vector<UnusedSetting> (*unused)(const ContactSettings&);  ///< that have no meaning for it
  SolverSkills skills;
  DescribeOwn
      describe_own;  ///< shows the settings that not every solver asks for; nullptr: it has none
};

template <typename Solver, auto... Arguments>
std::unique_ptr<ContactSolver> make() {
  return std::make_unique<Solver>(Arguments...);
}

template <typename Own>
void describeOwn(SolverSettings& settings, OptionVisitor& visitor) {
  settings.of<Own>().describe(visitor);
}

std::vector<UnusedSetting> usesAll(const ContactSettings&) { return {}; }

constexpr SolverSkills kOfCurve = {true, true, true, true, true, false};
constexpr SolverSkills kOfCaps = {false, false, false, false, false, true};

/// A line per solver, the default first.
constexpr Entry kSolvers[] = {
    {"separation_curve", make<SeparationSolver>, CurveStatement::unusedSettings, kOfCurve, nullptr},
    {"paper", make<AsperitySolver, Formulation::kPaper>, usesAll, kOfCaps,
     describeOwn<PaperOptions>},
    {"printed", make<AsperitySolver, Formulation::kPrinted>, usesAll, kOfCaps,
     describeOwn<PaperOptions>},
};

/// Figures of solvers with caps alone.
constexpr const char* kFiguresOfCaps[] = {"pull_off_force_jkr", "pull_off_force_transition",
                                          "contact_area_jkr",   "mechanical_energy",
                                          "plastic_work",       "max_tilt"};

/// What only condensed water needs.
constexpr const char* kOfWater[] = {"interface/surface_tension", "interface/contact_angle",
                                    "interface/temperature", "interface/molar_volume",
                                    "interface/water_film"};

/// What of a body's other side bears on nothing.
/// - @p doubts_thin_bodies of the solver
void addOfOtherSide(const Material& body, const std::string& name, bool doubts_thin_bodies,
                    std::vector<IgnoredSetting>& ignored) {
  const auto add = [&](std::initializer_list<const char*> keys, const std::string& why) {
    for (const char* key : keys) ignored.push_back({name + key, why});
  };
  if (body.thickness == 0.0) {
    add({"/backing", "/substrate/youngs_modulus", "/substrate/poisson_ratio"},
        name + "/thickness is 0");
  } else if (!doubts_thin_bodies) {
    add({"/thickness", "/backing", "/substrate/youngs_modulus", "/substrate/poisson_ratio"},
        "the separation curve and the half-space alone ask how thick bodies are");
  } else if (body.backing == Backing::kFree) {
    add({"/substrate/youngs_modulus", "/substrate/poisson_ratio"}, name + "/backing is free");
  } else if (body.substrate.youngs_modulus == 0.0) {
    add({"/substrate/poisson_ratio"}, name + "/substrate/youngs_modulus is 0");
  }
}

/// What of a body's film bears on nothing.
/// - @p looks_under_films of the solver
void addOfFilm(const Material& body, const std::string& name, bool looks_under_films,
               std::vector<IgnoredSetting>& ignored) {
  const std::string film = name + "/film_thickness";
  const std::string constant = name + "/hamaker_constant";
  if (!looks_under_films) {
    const std::string why = "the separation curve and the half-space alone look under films";
    ignored.push_back({film, why});
    ignored.push_back({constant, why});
  } else if (body.film_thickness == 0.0) {
    ignored.push_back({constant, film + " is 0"});
  } else if (body.hamaker_constant == 0.0) {
    ignored.push_back({film, constant + " is 0"});
  }
}

struct Retired {
  const char* formulation;
  const char* successors;
};

/// A line per name that settings of earlier versions may have.
constexpr Retired kRetired[] = {
    {"consistent", "its name is `separation_curve` now"},
    {"corrected", "`separation_curve` is the default, `paper` is nearest to what it was"},
};

/// The own settings of all solvers, those that several share once; without those that one of them
/// describes.
struct OwnSettings {
  SolverSettings& settings;
  DescribeOwn without = nullptr;

  void describe(OptionVisitor& visitor) {
    std::vector<DescribeOwn> shown = {nullptr, without};
    for (const Entry& entry : kSolvers) {
      if (std::find(shown.begin(), shown.end(), entry.describe_own) != shown.end()) continue;
      shown.push_back(entry.describe_own);
      entry.describe_own(settings, visitor);
    }
  }
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

void describeOwnSettings(SolverSettings& settings, OptionVisitor& visitor) {
  OwnSettings{settings}.describe(visitor);
}

SolverSkills skillsOf(const std::string& formulation) {
  for (const Entry& entry : kSolvers) {
    if (formulation == entry.formulation) return entry.skills;
  }
  return {};
}

bool hasFigure(const std::string& formulation, const std::string& figure) {
  const bool is_of_caps = std::find(std::begin(kFiguresOfCaps), std::end(kFiguresOfCaps), figure) !=
                          std::end(kFiguresOfCaps);
  if (!is_of_caps || skillsOf(formulation).has_caps) return true;
  const std::vector<std::string>& names = formulationNames();
  return std::find(names.begin(), names.end(), formulation) == names.end();
}

std::vector<IgnoredSetting> ignoredSettings(const std::string& formulation,
                                            const ContactSettings& settings) {
  std::vector<IgnoredSetting> ignored;
  for (const Entry& entry : kSolvers) {
    if (formulation != entry.formulation) continue;
    const std::string has_no_use = "approach/formulation " + formulation + " does not use it";
    SolverSettings own = settings.solver;
    visitValues(OwnSettings{own, entry.describe_own}, [&](const std::string& key, const auto&) {
      ignored.push_back({key, has_no_use});
    });
    for (const UnusedSetting& unused : entry.unused(settings)) {
      ignored.push_back({unused.key, unused.why != nullptr ? unused.why : has_no_use});
    }
    addOfOtherSide(settings.lower, "lower", entry.skills.doubts_thin_bodies, ignored);
    addOfOtherSide(settings.upper, "upper", entry.skills.doubts_thin_bodies, ignored);
    if (settings.load.contact_potential == 0.0) {
      ignored.push_back({"uncertainty/contact_potential", "load/contact_potential is 0"});
    }
    addOfFilm(settings.lower, "lower", entry.skills.looks_under_films, ignored);
    addOfFilm(settings.upper, "upper", entry.skills.looks_under_films, ignored);
    if (!entry.skills.looks_under_films) {
      ignored.push_back({"interface/retardation_length",
                         "the separation curve and the half-space alone retard the attraction"});
    }
    if (settings.capillary.relative_humidity > 0.0) continue;
    for (const char* key : kOfWater) ignored.push_back({key, "interface/relative_humidity is 0"});
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
