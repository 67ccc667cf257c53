#include "prediction/contact_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/median.hpp"

namespace mems_stiction {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Limits of the adhesion parameter by Gui et al. 1999 (J. Appl. Phys. 85, 7448).
constexpr double kBondingLimit = 1.0;
constexpr double kNonBondingLimit = 12.0;
/// Limits of Tabor's parameter in Johnson and Greenwood's adhesion map (J. Colloid Interface Sci.
/// 192 (1997) 326).
constexpr double kDmtLimit = 0.1;
constexpr double kJkrLimit = 5.0;

BondingRegime bondingRegimeOf(double adhesion_parameter) {
  if (std::isnan(adhesion_parameter)) return BondingRegime::kUnknown;
  if (adhesion_parameter < kBondingLimit) return BondingRegime::kBonding;
  return adhesion_parameter <= kNonBondingLimit ? BondingRegime::kAdherence
                                                : BondingRegime::kNonBonding;
}

ContactTheory contactTheoryOf(double tabor_parameter) {
  if (std::isnan(tabor_parameter)) return ContactTheory::kUnknown;
  if (tabor_parameter < kDmtLimit) return ContactTheory::kDmt;
  return tabor_parameter <= kJkrLimit ? ContactTheory::kTransition : ContactTheory::kJkr;
}

/// Of a figure of the contacts; NaN if there are none.
template <typename Figure>
double medianOver(const std::vector<Asperity>& asperities, std::vector<double>& values,
                  const Figure& figure) {
  if (asperities.empty()) return kUnknown;
  values.clear();
  for (const Asperity& asperity : asperities) values.push_back(figure(asperity));
  return medianOf(values);
}

void summarizeAsperities(const ContactProblem& problem, const ContactSolution& solution,
                         std::vector<double>& values, Prediction& prediction) {
  const std::vector<Asperity>& asperities = solution.asperities;
  prediction.has_asperities = solution.has_asperities;
  prediction.asperity_count = static_cast<int>(asperities.size());
  prediction.pull_off_contact_count = static_cast<int>(
      solution.pull_off_contacts.empty() ? asperities.size() : solution.pull_off_contacts.size());
  prediction.max_tilt = solution.has_asperities ? 0.0 : kUnknown;
  for (const Asperity& asperity : asperities) {
    prediction.max_tilt = std::max(prediction.max_tilt, asperity.tilt);
    if (asperity.regime == Regime::kElastic) ++prediction.elastic_count;
    if (asperity.regime == Regime::kElastoPlastic) ++prediction.elasto_plastic_count;
    if (asperity.regime == Regime::kPlastic) ++prediction.plastic_count;
  }
  prediction.median_tabor_parameter = medianOver(
      asperities, values, [](const Asperity& asperity) { return asperity.tabor_parameter; });
  prediction.contact_theory = contactTheoryOf(prediction.median_tabor_parameter);
  const double cell_area = problem.gap.cellArea();
  prediction
      .median_contact_pixels =  // whole numbers of cells, whatever the area has been rounded to
      medianOver(asperities, values,
                 [=](const Asperity& asperity) { return std::round(asperity.area / cell_area); });
  prediction.median_composite_radius = medianOver(
      asperities, values, [](const Asperity& asperity) { return asperity.composite_radius; });
}

}  // namespace

void summarizeContact(const ContactProblem& problem, ContactSolution& solution,
                      std::vector<double>& values, Prediction& prediction) {
  const GapField& gap = problem.gap;
  const ContactSettings& settings = problem.settings;
  prediction.status = solution.status;
  prediction.steps = solution.steps;
  prediction.model = solution.model;
  prediction.voltage = settings.load.voltage;
  prediction.mechanical_load = settings.load.mechanical_load;
  prediction.van_der_waals_force = solution.load.van_der_waals;
  prediction.electrostatic_force = solution.load.electrostatic;
  prediction.normal_load = solution.load.total();
  prediction.capillary_force = solution.load.capillary;
  prediction.pull_off_force = solution.pull_off_force;
  prediction.pull_off_force_jkr = solution.pull_off_force_jkr;
  prediction.pull_off_force_transition = solution.pull_off_force_transition;

  prediction.contact_area = solution.contact_area;
  prediction.contact_area_jkr = solution.contact_area_jkr;
  prediction.nominal_area = gap.validCount() * gap.cellArea();
  prediction.contact_fraction = solution.contact_fraction;
  prediction.approach = solution.approach;
  prediction.mean_gap = solution.mean_gap;

  const double work_of_adhesion = settings.interface.work_of_adhesion;
  prediction.mechanical_energy = solution.energies.mechanical;
  prediction.surface_energy = solution.energies.surface;
  prediction.elastic_energy = solution.energies.elastic;
  // of solvers that follow the curve, the energy of the bond is what it costs to part the surfaces
  prediction.apparent_work_of_adhesion = solution.apparent_work_of_adhesion;
  prediction.total_energy = std::isnan(solution.apparent_work_of_adhesion)
                                ? solution.energies.total()
                                : solution.apparent_work_of_adhesion * prediction.nominal_area;
  prediction.plastic_work = solution.energies.plastic_work;
  prediction.bonding_energy = prediction.total_energy / prediction.nominal_area;
  prediction.normalized_bonding_energy =
      work_of_adhesion > 0.0 ? prediction.bonding_energy / work_of_adhesion : kUnknown;

  prediction.contact_stiffness = solution.contact_stiffness;
  prediction.flattening_energy = solution.flattening_energy;
  prediction.pull_off_exponents = solution.pull_off_exponents;
  prediction.work_exponents = solution.work_exponents;
  const double gained = settings.gainedWork();
  prediction.flattening_ratio = gained > 0.0 ? solution.flattening_energy / gained : kUnknown;
  prediction.is_conforming = solution.is_conforming;
  prediction.is_bonded_by_load = solution.is_bonded_by_load;
  prediction.adhesion_parameter = solution.adhesion_parameter;
  prediction.bonding_regime = bondingRegimeOf(prediction.adhesion_parameter);
  prediction.composite_rms_height = problem.composite_rms_height;
  prediction.invalid_fraction = 1.0 - static_cast<double>(gap.validCount()) / gap.cellCount();
  summarizeAsperities(problem, solution, values, prediction);

  if (settings.output.asperities) prediction.asperities.swap(solution.asperities);
  prediction.pull_off_contacts.swap(solution.pull_off_contacts);
  prediction.energy_curve.swap(solution.energy_curve);
  prediction.curve.swap(solution.curve);
  std::swap(prediction.contact_map, solution.contact_map);
  std::swap(prediction.deformed_lower, solution.displaced_lower);
  std::swap(prediction.deformed_upper, solution.displaced_upper);
  std::swap(prediction.pressure, solution.pressure);
}

}  // namespace mems_stiction
