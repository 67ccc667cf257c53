#include "mems_stiction/prediction/contact_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mems_stiction/base/constants.hpp"
#include "mems_stiction/mechanics/jkr.hpp"
#include "mems_stiction/mechanics/transition.hpp"

namespace mems_stiction {
namespace {

/// Limits of the adhesion parameter by Gui et al. 1999 (J. Appl. Phys. 85, 7448).
constexpr double kBondingLimit = 1.0;
constexpr double kNonBondingLimit = 12.0;
/// Limits of Tabor's parameter in Johnson and Greenwood's adhesion map (J. Colloid Interface Sci. 192 (1997) 326).
constexpr double kDmtLimit = 0.1;
constexpr double kJkrLimit = 5.0;

BondingRegime bondingRegimeOf(double adhesion_parameter) {
  if (adhesion_parameter < kBondingLimit) return BondingRegime::kBonding;
  return adhesion_parameter <= kNonBondingLimit ? BondingRegime::kAdherence : BondingRegime::kNonBonding;
}

ContactTheory contactTheoryOf(double tabor_parameter) {
  if (tabor_parameter < kDmtLimit) return ContactTheory::kDmt;
  return tabor_parameter <= kJkrLimit ? ContactTheory::kTransition : ContactTheory::kJkr;
}

double median(std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// Mean gap over the cells that stay apart [m]; 0 when every cell touches.
double meanGapApart(const EquilibriumState& state, const GapField& field, const GapOrder& order) {
  const int apart = field.validCount() - state.contact_count;
  if (apart == 0) return 0.0;
  double touching = 0.0;
  for (int i = 0; i < state.contact_count; ++i) touching += order.cells()[static_cast<std::size_t>(i)].gap;
  return (field.meanGap() * field.validCount() - touching) / apart - state.approach;
}

}  // namespace

Asperity asperityAt(const ContactPatch& patch, const CapCouple& caps, const AsperityResponse& response,
                    double load_share, const GapField& field, const AsperityLaw& law,
                    const InterfaceOptions& interface) {
  Asperity asperity;
  asperity.x = caps.centre.col * field.pitchX();
  asperity.y = caps.centre.row * field.pitchY();
  asperity.cap_radius = caps.base_radius;
  asperity.composite_radius = caps.composite_radius;
  asperity.load = load_share * response.volume;
  const double apparent_load =
      jkr::apparentLoad(asperity.load * caps.cos_tilt, law.work_of_adhesion, caps.composite_radius);
  asperity.contact_radius = jkr::contactRadius(apparent_load, caps.composite_radius, law.contact_modulus);
  asperity.tilt = caps.tilt();
  asperity.plasticity_index = law.plasticityIndexOf(caps.composite_radius);
  asperity.tabor_parameter =
      taborParameter(caps.composite_radius, law.work_of_adhesion, law.contact_modulus, interface.equilibrium_distance);
  asperity.area = patch.area * field.cellArea();
  asperity.regime = regimeOf(asperity.plasticity_index);
  return asperity;
}

void addContact(const Asperity& asperity, const AsperityLaw& law, Prediction& prediction) {
  const double adhesion = kPi * law.work_of_adhesion * asperity.composite_radius;
  prediction.pull_off_force_jkr += 1.5 * adhesion;
  prediction.pull_off_force_transition += pullOffPrefactor(asperity.tabor_parameter) * adhesion;
  prediction.contact_area_jkr += kPi * asperity.contact_radius * asperity.contact_radius;
  const double sigma = law.composite_rms_height;
  prediction.adhesion_parameter +=
      law.contact_modulus / law.work_of_adhesion * std::sqrt(sigma * sigma * sigma / asperity.composite_radius);
  prediction.max_tilt = std::max(prediction.max_tilt, asperity.tilt);
  ++prediction.asperity_count;
  if (asperity.regime == Regime::kElastic) ++prediction.elastic_count;
  if (asperity.regime == Regime::kElastoPlastic) ++prediction.elasto_plastic_count;
  if (asperity.regime == Regime::kPlastic) ++prediction.plastic_count;
}

void summarizeContact(const HeightMap& lower, const EquilibriumState& state, ApproachSearch& search,
                      const GapField& field, const GapOrder& order, const AsperityLaw& law, const Options& options,
                      std::vector<double>& tabor_parameters, Prediction& prediction) {
  prediction.status = state.status;
  prediction.steps = state.steps;
  prediction.van_der_waals_force = state.load.van_der_waals;
  prediction.electrostatic_force = state.load.electrostatic;
  prediction.normal_load = state.load.total();
  prediction.capillary_force = state.load.capillary;
  prediction.contact_area = state.contact_count * field.cellArea();
  prediction.nominal_area = field.validCount() * field.cellArea();
  prediction.contact_fraction = static_cast<double>(state.contact_count) / field.validCount();
  prediction.approach = state.approach;
  prediction.mean_gap = meanGapApart(state, field, order);
  prediction.plastic_work = state.plastic_work;

  const Energies energies = totalEnergies(search.responses(), state.balance, law);
  prediction.mechanical_energy = energies.mechanical;
  prediction.surface_energy = energies.surface;
  prediction.elastic_energy = energies.elastic;
  prediction.total_energy = energies.total();
  prediction.bonding_energy = energies.total() / prediction.nominal_area;
  prediction.normalized_bonding_energy = law.work_of_adhesion > 0.0 ? prediction.bonding_energy / law.work_of_adhesion
                                                                    : std::numeric_limits<double>::quiet_NaN();

  tabor_parameters.clear();
  const std::vector<std::int32_t>& patches = search.sweep().livePatches();
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const CapCouple& caps = search.caps()[i];
    Asperity asperity = asperityAt(search.sweep().patch(patches[i]), caps, search.responses()[i],
                                   state.balance.load_share, field, law, options.interface);
    asperity.z = lower.height(caps.centre.row, caps.centre.col);
    addContact(asperity, law, prediction);
    tabor_parameters.push_back(asperity.tabor_parameter);
    if (options.output.asperities) prediction.asperities.push_back(asperity);
  }
  prediction.adhesion_parameter = law.work_of_adhesion > 0.0 ? prediction.adhesion_parameter / prediction.asperity_count
                                                             : std::numeric_limits<double>::infinity();
  prediction.bonding_regime = bondingRegimeOf(prediction.adhesion_parameter);
  prediction.median_tabor_parameter = median(tabor_parameters);
  prediction.contact_theory = contactTheoryOf(prediction.median_tabor_parameter);

  std::vector<double>& values = tabor_parameters;  // the same memory, its figures are used up
  values.clear();
  for (const std::int32_t patch : patches) values.push_back(search.sweep().patch(patch).area);
  prediction.median_contact_pixels = median(values);
  values.clear();
  for (std::size_t i = 0; i < patches.size(); ++i) values.push_back(search.caps()[i].composite_radius);
  prediction.median_composite_radius = median(values);

  prediction.pull_off_force =
      prediction.pull_off_force_jkr + prediction.van_der_waals_force + prediction.capillary_force;
}

}  // namespace mems_stiction
