#pragma once

/// @file
/// The maps of the state that the search ended in: both surfaces after contact, and the regime of every cell.

#include <cstdint>
#include <vector>

#include "contact/contact_problem.hpp"
#include "mems_stiction/contact/contact_solution.hpp"
#include "paper/approach_search.hpp"

namespace mems_stiction {

/// Writes the maps; keeps its memory from frame to frame, so that nothing is allocated.
class ContactMaps {
 public:
  /// Fills those maps of the solution that output asks for, and releases the others.
  void fill(const ContactProblem& problem, const EquilibriumState& state, ApproachSearch& search,
            const AsperityLaw& law, ContactSolution& solution);

 private:
  /// What one patch does to its cells.
  struct Change {
    double lower_share = 0.0;  ///< of the interference that the lower surface gives way [-]
    double upper_share = 0.0;  ///< of the interference that the upper surface gives way [-]
    std::uint8_t regime = 0;   ///< as in the contact map
  };

  std::vector<Change> changes_;        ///< in the order of the live patches
  std::vector<double> gaps_;           ///< of one row
  std::vector<std::int32_t> columns_;  ///< of its cells in contact
};

}  // namespace mems_stiction
