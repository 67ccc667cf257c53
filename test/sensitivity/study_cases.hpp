#pragma once

/// Which settings the study changes, one at a time, and what a prediction with each of them says.

#include <string>
#include <vector>

#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/scan/configuration.hpp"
#include "study_surfaces.hpp"

namespace mems_stiction {
namespace study {

enum class Kind {
  kNumerical,  ///< how the model is computed
  kModel,      ///< which equations are used
  kPhysical,   ///< a constant of the pair, changed by its standard uncertainty: a yardstick for the others
};

/// One value of one setting, everything else as configured.
struct Case {
  std::string key;    ///< of the configuration, or "pitch"
  std::string value;  ///< as people read it
  Kind kind = Kind::kNumerical;
  bool is_default = false;    ///< the key's other cases are compared with it
  std::string yaml;           ///< what it changes; empty: nothing
  int steps_per_rms = 0;      ///< > 0: approach/step is the composite rms height over this
  double pitch_factor = 1.0;  ///< pitch over that of the scan: a power of two
};

/// Every case; the default of a key is one of its cases.
/// @param has_finer whether the surfaces are known at half of the scan's pitch
std::vector<Case> allCases(const Configuration& configuration, bool has_finer);

/// A prediction, and the pitch of the scan that it is of [m].
struct Outcome {
  Prediction prediction;
  double pitch = 0.0;
};

/// @param pressure mechanical load over the scanned area [Pa]
Outcome predictCase(const Case& change, const Configuration& configuration, double pressure, const Place& place);

/// How far the ends of the 95 % interval of the pull-off force scatter from seed to seed.
struct IntervalScatter {
  int samples = 0;
  double lower = 0.0, upper = 0.0;                  ///< mean ends, over the predicted force [-]
  double lower_scatter = 0.0, upper_scatter = 0.0;  ///< standard deviation over the mean [-]
};

std::vector<IntervalScatter> intervalScatter(const Configuration& configuration, double pressure, const Place& place);

}  // namespace study
}  // namespace mems_stiction
