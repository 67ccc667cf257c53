#pragma once

/// @file
/// The paper's formulations have settings of their own:
///
///     options.solver.of<PaperOptions>().step = 0.1e-9;

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// Settings that the formulations `paper` and `printed` use alone; keys paper/...
struct PaperOptions {
  double step = 0.0;  ///< delta of (1) [m]; 0 = composite rms height / 50
  double cutoff_distance =
      0.165e-9;  ///< D0: gaps are not taken smaller in van der Waals sums [m], > 0

  void describe(OptionVisitor& visitor);
};

}  // namespace mems_stiction
