#pragma once

/// @file
/// Surfaces on a rigid plane under the 9-3 law with z0 stated: what closed forms of the half-space
/// are about.

#include "mems_stiction/half_space/half_space_solver.hpp"

namespace mems_stiction {
namespace half_space_cases {

/// A lower body with this contact modulus [Pa] against a rigid plane.
inline HalfSpaceProblem onRigidPlane(const HeightMap& lower, double contact_modulus,
                                     double work_of_adhesion = 0.05) {
  HalfSpaceProblem problem;
  problem.surfaces.lower = lower;
  problem.lower_material.youngs_modulus = contact_modulus;
  problem.lower_material.poisson_ratio = 0.0;
  problem.upper_material.youngs_modulus = 1e30;
  problem.interface.work_of_adhesion = work_of_adhesion;
  return problem;
}

/// z0 stated [m], no flow.
inline HalfSpaceOptions elastic(double range) {
  HalfSpaceOptions options;
  options.range = range;
  options.flow = false;
  return options;
}

}  // namespace half_space_cases
}  // namespace mems_stiction
