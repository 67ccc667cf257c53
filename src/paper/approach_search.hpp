#pragma once

/// @file
/// The iteration of the paper: bring the upper surface down step by step until the stopping
/// condition is met (force_balance.hpp), and find the place inside that step.
///
/// Step k has D = k delta (1), cells with g < D in contact. Inside the step that meets the
/// condition the cells are added level by level (cells of equal gap come together), and D is the
/// gap of the last one: the result does not hang on delta. The search ends
///   - in equilibrium;
///   - bonded, at the first level whose contact fraction reaches the limit;
///   - without equilibrium, after max_steps, or at that limit when all asperities are plastic, so
///   that nothing resists.

#include <cstdint>
#include <vector>

#include "mems_stiction/contact/contact_settings.hpp"
#include "mems_stiction/contact/contact_solution.hpp"
#include "mems_stiction/loads/capillary.hpp"
#include "mems_stiction/paper/paper_options.hpp"
#include "paper/cap_couple.hpp"
#include "paper/cell_forces.hpp"
#include "paper/force_balance.hpp"
#include "paper/patch_sweep.hpp"

namespace mems_stiction {

/// Delta of (1) [m]: as set, or a fiftieth of the composite rms height, or the cut-off distance for
/// surfaces without relief.
double approachStep(const PaperOptions& options, double composite_rms_height);

/// What the approach ends with, and what it passed on the way: the first contact_count cells in
/// order of gap touch.
struct EquilibriumState {
  Status status = Status::kNoEquilibrium;
  double approach = 0.0;  ///< D [m]
  int contact_count = 0;
  int steps = 0;  ///< steps of the approach that were begun
  NormalLoad load;
  ForceBalance balance;
  double plastic_work = 0.0;  ///< sum of plastic_force dD along the approach [J]
  std::vector<EnergyPoint> curve;
};

/// What the search needs to know beside the surfaces.
struct SearchSetting {
  AsperityLaw law;
  CellForces forces;
  double mechanical_load = 0.0;  ///< [N]
  double step = 0.0;             ///< delta [m], > 0
  int max_steps = 0;
  double cutoff_distance = 0.0;  ///< D0 [m], > 0
  bool record_curve = false;
  WaterLaw capillary;  ///< of condensed water
};

/// Runs one approach at a time; keeps its memory between frames. After run() the sweep and the
/// responses are those of the state that was found.
class ApproachSearch {
 public:
  void run(const GapField& field, GapOrder& order, Connectivity connectivity,
           const SearchSetting& setting, EquilibriumState& state);

  PatchSweep& sweep() { return sweep_; }
  const PatchSweep& sweep() const { return sweep_; }
  /// Caps and responses of the live patches, in the order of sweep().livePatches().
  const std::vector<CapCouple>& caps() const { return caps_; }
  const std::vector<AsperityResponse>& responses() const { return responses_; }

 private:
  /// Steps until the search ends.
  void search(EquilibriumState& state);
  /// Brings the state's cells into contact and balances the forces there.
  void moveTo(double approach, int contact_count, EquilibriumState& state);
  /// Replaces the state by the first level in equilibrium after `previous_count` cells, if there is
  /// one.
  void refine(int previous_count, EquilibriumState& state);
  /// Caps and response of a patch that has changed.
  void describe(std::int32_t patch_id);
  /// The centre of the patch's box if it belongs to the patch, else its deepest cell.
  PatchCentre centreOf(std::int32_t patch_id);
  /// To the letter of the paper nothing resists a plastic asperity: when all are, no extremum can
  /// come.
  bool nothingResists() const;
  void record(EquilibriumState& state) const;

  const GapField* field_ = nullptr;
  GapOrder* order_ = nullptr;
  const SearchSetting* setting_ = nullptr;
  PatchSweep sweep_;
  GapLoads loads_;
  std::vector<CapCouple> caps_;
  std::vector<AsperityResponse> responses_;
  std::vector<std::int32_t> level_ends_;
};

}  // namespace mems_stiction
