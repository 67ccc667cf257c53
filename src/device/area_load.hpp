#pragma once

/// @file
/// The load that presses a part of a surface, or a larger one of the same surface, with the same
/// pressure.

#include <algorithm>

#include "mems_stiction/prediction/options.hpp"

namespace mems_stiction {

/// - @p model its mechanical load presses an area of `loaded_area` [m^2]
/// - @p area of the other surface [m^2]; its load is allowed, whatever the limit
inline Options loadedOn(const Options& model, double loaded_area, double area) {
  Options options = model;
  options.load.setShareOfLoad(model.load.mechanical_load * area / loaded_area);
  options.load.max_mechanical_load =
      std::max(options.load.max_mechanical_load, options.load.mechanical_load);
  return options;
}

}  // namespace mems_stiction
