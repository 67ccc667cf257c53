#include "paper/approach_search.hpp"

#include <algorithm>

#include "paper/level_search.hpp"
#include "settings/time_limit.hpp"

namespace mems_stiction {
namespace {

/// Cells whose gaps differ by less than this share of a step come into contact together. Else
/// round-off decides which part of a symmetrical ring of cells comes first, and a contact of few
/// pixels gets the radius of half a ring.
constexpr double kLevelWidth = 1e-6;

}  // namespace

double approachStep(const PaperOptions& options, double composite_rms_height) {
  constexpr double kStepsPerRmsHeight = 50.0;
  if (options.step > 0.0) return options.step;
  const double step = composite_rms_height / kStepsPerRmsHeight;
  return step > 0.0 ? step : options.cutoff_distance;
}

void ApproachSearch::run(const GapField& field, GapOrder& order, Connectivity connectivity,
                         const SearchSetting& setting, EquilibriumState& state) {
  field_ = &field;
  order_ = &order;
  setting_ = &setting;
  sweep_.start(field, order, connectivity);
  loads_.prepare(order);
  search(state);
}

void ApproachSearch::search(EquilibriumState& state) {
  GapOrder& order = *order_;
  const SearchSetting& setting = *setting_;
  const double limit_gap = order.cells()[static_cast<std::size_t>(order.contactLimit() - 1)].gap;
  state.approach = 0.0;
  state.contact_count = 0;
  state.steps = 0;
  state.plastic_work = 0.0;
  state.curve.clear();
  while (state.steps < setting.max_steps) {
    TimeLimit::check();
    ++state.steps;
    const int previous_count = state.contact_count;
    const double previous_approach = state.approach;
    double approach = state.steps * setting.step;
    int contact_count = order.sortBelow(approach);
    const bool reaches_limit = contact_count >= order.contactLimit();
    if (reaches_limit) {
      approach = limit_gap;
      contact_count = order.contactLimit();
    }
    moveTo(approach, contact_count, state);
    const bool is_equilibrium = state.balance.is_equilibrium;
    if (is_equilibrium) refine(previous_count, state);
    state.plastic_work += state.balance.plastic_force * (state.approach - previous_approach);
    if (setting.record_curve) record(state);
    if (is_equilibrium) {
      state.status = Status::kEquilibrium;
      return;
    }
    if (reaches_limit) {
      state.status = nothingResists() ? Status::kNoEquilibrium : Status::kBonded;
      return;
    }
  }
  state.status = Status::kNoEquilibrium;
}

void ApproachSearch::moveTo(double approach, int contact_count, EquilibriumState& state) {
  sweep_.advanceTo(contact_count);
  caps_.resize(sweep_.livePatches().size());
  responses_.resize(sweep_.livePatches().size());
  for (const std::int32_t id : sweep_.takeChangedPatches()) describe(id);
  state.approach = approach;
  state.contact_count = contact_count;
  state.load = loads_.at(approach, contact_count, setting_->forces, setting_->mechanical_load);
  state.load.capillary =
      capillaryForce(*order_, approach, contact_count, setting_->capillary, field_->cellArea());
  state.balance = forceBalance(responses_, state.load.total(), setting_->law);
}

void ApproachSearch::describe(std::int32_t patch_id) {
  const auto place = static_cast<std::size_t>(sweep_.livePlace(patch_id));
  caps_[place] =
      capCouple(sweep_.patch(patch_id), *field_, centreOf(patch_id), setting_->cutoff_distance);
  responses_[place] = AsperityResponse(caps_[place], setting_->law);
}

PatchCentre ApproachSearch::centreOf(std::int32_t patch_id) {
  const ContactPatch& patch = sweep_.patch(patch_id);
  const PatchCentre centre = boxCentre(patch, *field_);
  return sweep_.patchOf(centre.cell) == patch_id ? centre : deepestCentre(patch, *field_);
}

bool ApproachSearch::nothingResists() const {
  return std::all_of(responses_.begin(), responses_.end(), [](const AsperityResponse& asperity) {
    return asperity.elastic_share == 0.0;
  });
}

void ApproachSearch::refine(int previous_count, EquilibriumState& state) {
  order_->sortBetween(previous_count, state.contact_count);
  const LargePageVector<OrderedCell>& cells = order_->cells();
  level_ends_.clear();
  const double level_width = kLevelWidth * setting_->step;
  const auto end_of_step = static_cast<std::size_t>(state.contact_count);
  for (auto cell = static_cast<std::size_t>(previous_count); cell < end_of_step;) {
    const double highest_gap = cells[cell].gap + level_width;
    while (cell < end_of_step && cells[cell].gap <= highest_gap) ++cell;
    level_ends_.push_back(static_cast<std::int32_t>(cell));
  }
  const double step_end_approach = state.approach;
  const int step_end_count = state.contact_count;
  const auto level_count = static_cast<int>(level_ends_.size());
  const int level = firstLevelThat(level_count, [&](int candidate) {
    const std::int32_t end = level_ends_[static_cast<std::size_t>(candidate)];
    moveTo(cells[static_cast<std::size_t>(end - 1)].gap, end, state);
    return state.balance.is_equilibrium;
  });
  if (level == level_count) moveTo(step_end_approach, step_end_count, state);
}

void ApproachSearch::record(EquilibriumState& state) const {
  const Energies energies = totalEnergies(responses_, state.balance, setting_->law);
  EnergyPoint point;
  point.approach = state.approach;
  point.contact_fraction = static_cast<double>(state.contact_count) / field_->validCount();
  point.normal_load = state.balance.normal_load;
  point.carried_load = state.balance.carried_load;
  point.generalized_force = generalizedForce(responses_, state.balance, setting_->law);
  point.mechanical_energy = energies.mechanical;
  point.surface_energy = energies.surface;
  point.elastic_energy = energies.elastic;
  point.total_energy = energies.total();
  state.curve.push_back(point);
}

}  // namespace mems_stiction
