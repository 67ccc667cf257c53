#pragma once

/// @file
/// How is an equilibrium searched for?

#include <atomic>
#include <functional>

namespace mems_stiction {

/// Settings of the search.
struct MinimiserSettings {
  double tolerance = 1e-4;  ///< largest residual of an equilibrium [-]
  int max_newton_steps = 200;
  int threads = 1;
  const std::atomic<bool>* cancel = nullptr;
  std::function<void()> give_way;  ///< before each product; may be empty
};

}  // namespace mems_stiction
