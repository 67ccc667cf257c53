#pragma once

/// What each benchmark case predicts.

#include <string>

#include "bench/frames.hpp"
#include "mems_stiction/prediction/options.hpp"

namespace mems_stiction {
namespace bench {

struct Case {
  Frame frame;
  int size;   ///< rows and columns
  int steps;  ///< of the approach, up to 30 % contact

  std::string name() const { return frameName(frame) + "/" + std::to_string(size) + "/" + std::to_string(steps); }
};

/// Approach at which the frame reaches 30 % contact [m].
double fullApproach(const HeightMap& frame);

/// Steps that end at fullApproach(), under a load that no contact can carry: every case goes through all of them.
Options optionsFor(const Case& setting, bool all_outputs);

}  // namespace bench
}  // namespace mems_stiction
