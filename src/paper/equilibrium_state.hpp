#pragma once

/// @file
/// What the approach ends with, and what it passed on the way.

#include <vector>

#include "mems_stiction/contact/contact_solution.hpp"
#include "paper/force_balance.hpp"

namespace mems_stiction {

/// The surfaces at one approach: the first contact_count cells in order of gap touch.
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

}  // namespace mems_stiction
