#pragma once

/// @file
/// What the approach ends with, and what it passed on the way.

#include <cstdint>
#include <vector>

#include "mems_stiction/equilibrium/force_balance.hpp"
#include "mems_stiction/loads/normal_load.hpp"

namespace mems_stiction {

/// How the search for equilibrium ended.
enum class Status : std::uint8_t {
  kEquilibrium = 0,    ///< the free energy has its extremum and the contacts carry the load
  kBonded = 1,         ///< no extremum before the contact fraction limit: forces are lower bounds
  kNoEquilibrium = 2,  ///< the search range ended first: results are those of the last step
};

/// One step of the approach, for the energy curve.
struct EnergyPoint {
  double approach = 0.0;           ///< D [m]
  double contact_fraction = 0.0;   ///< [-]
  double normal_load = 0.0;        ///< F [N]
  double carried_load = 0.0;       ///< what the contacts can carry [N]
  double generalized_force = 0.0;  ///< dE_t/dD [N]
  double mechanical_energy = 0.0;  ///< (10.1) [J]
  double surface_energy = 0.0;     ///< (10.1) [J]
  double elastic_energy = 0.0;     ///< (10.2) [J]
  double total_energy = 0.0;       ///< (8) [J]
};

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
