#include "paper/asperity_solver.hpp"

#include <cmath>

#include "contact/prepared_maps.hpp"
#include "paper/asperity_summary.hpp"
#include "paper/contact_growth.hpp"
#include "paper/formulation_share.hpp"

namespace mems_stiction {
namespace {

/// Mean gap over the cells that stay apart [m]; 0 when every cell touches.
double meanGapApart(const EquilibriumState& state, const GapField& field, const GapOrder& order) {
  const int apart = field.validCount() - state.contact_count;
  if (apart == 0) return 0.0;
  double touching = 0.0;
  for (int i = 0; i < state.contact_count; ++i)
    touching += order.cells()[static_cast<std::size_t>(i)].gap;
  return (field.meanGap() * field.validCount() - touching) / apart - state.approach;
}

}  // namespace

void PaperOptions::describe(OptionVisitor& visitor) {
  visitor.formerName("approach/step", "paper/step");
  visitor.number("paper/step", step, "m", Range::nonNegative(),
                 "approach per step; 0 = a fiftieth of the composite rms height");
  visitor.formerName("interface/cutoff_distance", "paper/cutoff_distance");
  visitor.number("paper/cutoff_distance", cutoff_distance, "m", Range::positive(),
                 "interatomic cut-off: smaller gaps count as this in van der Waals sums");
}

void AsperitySolver::solve(const ContactProblem& problem, ContactSolution& solution) {
  const ContactSettings& settings = problem.settings;
  const auto& own = settings.solver.of<PaperOptions>();
  const double cutoff = own.cutoff_distance;
  const double step = approachStep(own, problem.composite_rms_height);
  order_.build(problem.gap, settings.approach.max_contact_fraction, step);

  const ContactPair pair(settings.lower, settings.upper);
  const SearchSetting setting{
      AsperityLaw(pair, settings.interface.work_of_adhesion, problem.composite_rms_height,
                  formulation_, settings.deformation),
      CellForces(settings.interface, cutoff, settings.load.fieldVoltage(), problem.gap.cellArea()),
      settings.load.mechanical_load,
      step,
      settings.approach.max_steps,
      cutoff,
      settings.output.energy_curve,
      settings.capillary.law()};
  search_.run(problem.gap, order_, settings.approach.connectivity, setting, state_);

  solution.clear();
  solution.model.respond = contactGrowth;
  solution.status = state_.status;
  solution.steps = state_.steps;
  solution.approach = state_.approach;
  solution.mean_gap = meanGapApart(state_, problem.gap, order_);
  solution.contact_area = state_.contact_count * problem.gap.cellArea();
  solution.contact_fraction = static_cast<double>(state_.contact_count) / problem.gap.validCount();
  solution.load = state_.load;
  const Energies energies = totalEnergies(search_.responses(), state_.balance, setting.law);
  solution.energies = {energies.mechanical, energies.surface, energies.elastic,
                       state_.plastic_work};
  listAsperities(problem, setting.law, solution);
  sumAsperities(setting.law, solution);
  solution.pull_off_force = solution.pull_off_force_jkr + solution.load.van_der_waals +
                            solution.load.capillary +
                            settings.load.lastingFieldShare() * solution.load.electrostatic;
  solution.energy_curve.assign(state_.curve.begin(), state_.curve.end());
  fillMaps(problem, setting.law, solution);
}

void AsperitySolver::listAsperities(const ContactProblem& problem, const AsperityLaw& law,
                                    ContactSolution& solution) const {
  const std::vector<std::int32_t>& patches = search_.sweep().livePatches();
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const CapCouple& caps = search_.caps()[i];
    solution.asperities.push_back(asperityAt(search_.sweep().patch(patches[i]), caps,
                                             search_.responses()[i], state_.balance.load_share,
                                             problem.gap, law, problem.settings.interface));
    solution.asperities.back().z = problem.surfaces.lower.height(caps.centre.row, caps.centre.col);
  }
  solution.has_asperities = true;
}

void AsperitySolver::fillMaps(const ContactProblem& problem, const AsperityLaw& law,
                              ContactSolution& solution) {
  const GapField& field = problem.gap;
  const ContactSettings& settings = problem.settings;
  const bool wants_map = settings.output.contact_map;
  const bool wants_surfaces = settings.output.deformed_surfaces;
  prepareMaps(problem, solution);
  if (!wants_map && !wants_surfaces) return;

  const FormulationShare share(settings.lower, settings.upper,
                               settings.interface.hardness_ratio_limit, law.formulation,
                               law.deformation);
  changes_.clear();
  for (const AsperityResponse& asperity : search_.responses()) {
    const double plasticity_index = law.plasticityIndexOf(asperity.radius);
    changes_.push_back({share.lower(plasticity_index), share.upper(plasticity_index),
                        static_cast<std::uint8_t>(regimeOf(plasticity_index))});
  }

  PatchSweep& sweep = search_.sweep();
  columns_.resize(static_cast<std::size_t>(field.cols()));
  gaps_.resize(columns_.size());
  const double past_contact = std::nextafter(state_.approach, GapField::kInvalidGap);
  for (int row = 0; row < field.rows(); ++row) {
    field.gapsOfRow(row, gaps_.data());
    const int count =
        columnsBetween(0.0, past_contact, gaps_.data(), field.cols(), columns_.data());
    std::uint8_t* map = wants_map ? solution.contact_map.ptr<std::uint8_t>(row) : nullptr;
    double* lower_line = wants_surfaces ? solution.displaced_lower.ptr<double>(row) : nullptr;
    double* upper_line = wants_surfaces ? solution.displaced_upper.ptr<double>(row) : nullptr;
    for (int i = 0; i < count; ++i) {
      const std::int32_t col = columns_[static_cast<std::size_t>(i)];
      const std::int32_t patch = sweep.patchOf(field.cellAt(row, col));
      if (patch < 0) continue;
      const Change& change = changes_[static_cast<std::size_t>(sweep.livePlace(patch))];
      if (wants_map) map[col] = change.regime;
      if (wants_surfaces) {
        const double interference = state_.approach - gaps_[static_cast<std::size_t>(col)];
        lower_line[col] -= change.lower_share * interference;
        upper_line[col] += change.upper_share * interference;
      }
    }
  }
}

}  // namespace mems_stiction
