#pragma once

/// @file
/// What a solver says of its own answer, for those who judge by it: they need not know which solver it was.

#include "mems_stiction/contact/contact_response.hpp"

namespace mems_stiction {

/// How far figures lie from the half-space's: standard deviation of the logarithm of their ratio [-]; 0: not known.
struct ModelError {
  double pull_off = 0.0;
  double work = 0.0;
};

/// A setting without effect on a solver's answer, nor on the intervals of that.
struct UnusedSetting {
  const char* key;
  const char* why = nullptr;  ///< nullptr: the solver has no use for it, whatever the others are
};

/// A solver that says nothing claims nothing.
struct ModelStatement {
  ModelError error;
  bool is_bound_where_bonded = true;  ///< bonded surfaces hold with the pull-off force or more: the search ended there
  bool knows_every_load = false;  ///< the contact at another load is found by asking again, for surfaces that bore more
  bool assumes_jkr = true;        ///< of each contact, whatever Tabor's parameter says
  /// Why the pull-off force may be out by more than 1.3 against the half-space, as a sentence without its full stop; nullptr: it is
  /// within the range of the model.
  const char* doubt = nullptr;
  /// How the figures move with the constants; nullptr: with the exponents of the solution.
  MakeContactResponse respond = nullptr;
};

}  // namespace mems_stiction
