#pragma once

/// @file
/// How does a beam bend under a load that is even on a part of it? By its bending moment,
/// integrated twice from the clamp.

#include <vector>

#include "mems_stiction/verdict/beam_adhesion.hpp"

namespace mems_stiction {

/// On cells of equal length along the beam, without a scale: under a load per length of its
/// rigidity E I.
struct BeamShape {
  double step = 0.0;               ///< length of a cell [m]
  std::vector<double> curvature;   ///< of each cell
  std::vector<double> slope;       ///< in the middle of each cell
  std::vector<double> deflection;  ///< in the middle of each cell
  std::vector<double> at_edges;    ///< the deflection where cells begin, and at the end of the last
};

/// - @p beam cantilever or doubly clamped; without what stretching and residual stress do to its
/// shape
/// - @p start, length where the load lies, from the (left) clamp [m]
/// - @p cells along the beam, > 0
BeamShape shapeUnder(const Beam& beam, double start, double length, int cells);

}  // namespace mems_stiction
