#pragma once

/// Settings with the paper's solver, for tests of what it computes: they hold whatever the default
/// formulation is.

#include "mems_stiction/configuration/configuration.hpp"

namespace mems_stiction {

inline Options paperOptions() {
  Options options;
  options.formulation = "paper";
  return options;
}

inline Configuration paperConfiguration() {
  Configuration configuration;
  configuration.model = paperOptions();
  return configuration;
}

}  // namespace mems_stiction
