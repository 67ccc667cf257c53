#pragma once

/// @file
/// The solvers that there are, by the names that approach/formulation takes. Each is one line of
/// the table in contact_solvers.cpp.

#include <memory>
#include <string>
#include <vector>

#include "contact/contact_solver.hpp"
#include "mems_stiction/contact/contact_settings.hpp"
#include "mems_stiction/prediction/options.hpp"

namespace mems_stiction {

/// Why a formulation of earlier versions is refused and what serves instead, as a line for
/// messages; empty for any other name.
std::string retirement(const std::string& formulation);

/// Shows what single solvers ask for beside the settings of all.
void describeOwnSettings(SolverSettings& settings, OptionVisitor& visitor);

/// What a solver does that not every one does.
struct SolverSkills {
  bool doubts_thin_bodies =
      false;                   ///< asks how thick bodies are, and doubts itself where they are thin
  bool tilts_plates = false;   ///< device/guidance free
  bool follows_areas = false;  ///< that come in tiles (area_adhesion.hpp)
  bool calls_half_space =
      false;  ///< flags of its predictions may ask for one (evaluation/half_space_call.hpp)
  bool looks_under_films = false;  ///< what lies under native films, and retardation
  bool has_caps = false;           ///< takes contacts for spherical caps of known tilt and load
};

/// Of a formulation; none of those if there is no such one.
SolverSkills skillsOf(const std::string& formulation);

/// Whether a formulation has the figure of this name, which records and rows leave out if not:
/// JKR's sums over contacts, tilt, mechanical energy and plastic work are of solvers with caps
/// alone. True if there is no such formulation.
bool hasFigure(const std::string& formulation, const std::string& figure);

/// A setting without effect, and why.
struct IgnoredSetting {
  std::string key;
  std::string why;
};
/// The settings that bear on nothing that a formulation predicts, nor on the intervals of that,
/// while the others are as given; none if there is no such formulation. A test changes every
/// setting and compares bits.
std::vector<IgnoredSetting> ignoredSettings(const std::string& formulation,
                                            const ContactSettings& settings);

/// @throw OptionsError if there is no formulation of this name; it lists those that there are.
std::unique_ptr<ContactSolver> makeContactSolver(const std::string& formulation);

}  // namespace mems_stiction
