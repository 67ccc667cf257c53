#pragma once

/// @file
/// How the surfaces are brought together and when a search ends.

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

enum class Connectivity { kFour, kEight };

/// Settings of the approach; keys approach/...
struct ApproachOptions {
  int max_steps = 100000;             ///< the search range ends after so many steps
  double max_contact_fraction = 0.5;  ///< beyond it the surfaces count as bonded, in (0, 1]
  Connectivity connectivity = Connectivity::kFour;

  void describe(OptionVisitor& visitor);
};

}  // namespace mems_stiction
