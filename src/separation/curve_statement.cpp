#include "separation/curve_statement.hpp"

#include <algorithm>
#include <cmath>

#include "mems_stiction/contact/contact_settings.hpp"
#include "numeric/median.hpp"

namespace mems_stiction {
namespace {

/// Flattening energy over the work of adhesion below which stiff contacts (DMT) may grow together, and soft ones (JKR)
/// at twice that [-].
constexpr double kNearBonding = 2.0;
/// Up to this ratio, contacts that join one after another may pull each other together.
constexpr double kJoiningOnes = 6.0;
/// Rise of the force, of the largest one, that tells of such contacts [-].
constexpr double kJoiningRise = 0.1;

constexpr ModelError kConformingError{0.07, 0.06};
constexpr ModelError kNearBondingError{0.10, 0.11};
constexpr ModelError kSparseError{0.05, 0.04};

}  // namespace

std::vector<UnusedSetting> CurveStatement::unusedSettings(const ContactSettings& settings) {
  std::vector<UnusedSetting> unused = {{"paper/step"},
                                       {"paper/cutoff_distance"},
                                       {"output/energy_curve"},
                                       {"uncertainty/hardness"},
                                       {"uncertainty/cutoff_distance"}};
  if (settings.interface.work_of_adhesion > 0.0 && settings.interface.hamaker_constant > 0.0) {
    unused.push_back(
        {"interface/equilibrium_distance", "work of adhesion and Hamaker constant tell the range of forces"});
  }
  return unused;
}

bool CurveStatement::mayGrowTogether(const ContactSolution& solution, double flattening_ratio) {
  values_.clear();
  const std::vector<Asperity>& contacts =
      solution.pull_off_contacts.empty() ? solution.asperities : solution.pull_off_contacts;
  for (const Asperity& contact : contacts) values_.push_back(contact.tabor_parameter);
  const double tabor = values_.empty() ? 0.0 : medianOf(values_);
  const double softness = std::isnan(tabor) ? 0.0 : std::min(tabor, 1.0);
  if (flattening_ratio < kNearBonding * (1.0 + softness)) return true;
  return flattening_ratio < kJoiningOnes && solution.joining_rise > kJoiningRise;
}

ModelStatement CurveStatement::of(const ContactSolution& solution, double work_of_adhesion) {
  ModelStatement statement;
  statement.is_bound_where_bonded = false;
  statement.knows_every_load = true;
  statement.assumes_jkr = false;
  statement.may_grow_together =
      work_of_adhesion > 0.0 && mayGrowTogether(solution, solution.flattening_energy / work_of_adhesion);
  statement.error = kSparseError;
  if (statement.may_grow_together) statement.error = kNearBondingError;
  if (solution.is_conforming) statement.error = kConformingError;
  return statement;
}

}  // namespace mems_stiction
