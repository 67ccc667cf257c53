#include "separation/curve_statement.hpp"

#include <algorithm>
#include <cmath>

#include "mems_stiction/contact/contact_settings.hpp"
#include "numeric/median.hpp"
#include "separation/chosen_constants.hpp"

namespace mems_stiction {

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
  return flattening_ratio < chosen::kNearBonding * (1.0 + softness);
}

ModelStatement CurveStatement::of(const ContactSolution& solution, double work_of_adhesion, bool bends) {
  ModelStatement statement;
  statement.is_bound_where_bonded = false;
  statement.knows_every_load = true;
  statement.assumes_jkr = false;
  statement.may_grow_together =
      work_of_adhesion > 0.0 && mayGrowTogether(solution, solution.flattening_energy / work_of_adhesion);
  statement.error = chosen::kSparseError;
  if (statement.may_grow_together) statement.error = chosen::kNearBondingError;
  if (solution.is_conforming) statement.error = chosen::kConformingError;
  if (bends && statement.may_grow_together) {
    statement.error = solution.is_conforming ? chosen::kBentConformingError : chosen::kBentError;
  }
  return statement;
}

}  // namespace mems_stiction
