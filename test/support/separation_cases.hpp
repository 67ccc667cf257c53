#pragma once

/// What the tests of the separation curve share: bodies that do not flow, and one call of the
/// model, or of the half-space.

#include <cmath>

#include "mems_stiction/half_space/half_space_solver.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace separation_cases {

constexpr double kWork = 0.05;
/// z0 of the default Hamaker constant at this work [m].
inline double rangeOf(const Options& options) {
  return std::sqrt(options.interface.hamaker_constant /
                   (16.0 * kPi * options.interface.work_of_adhesion));
}

/// Elastic bodies with this contact modulus, the upper one rigid.
inline Options elastic(double contact_modulus, double load = 0.0) {
  Options options;
  options.formulation = "separation_curve";
  options.lower.youngs_modulus = contact_modulus;
  options.lower.poisson_ratio = 0.0;
  options.upper.youngs_modulus = 1e30;
  options.deformation = Deformation::kElastic;
  options.interface.work_of_adhesion = kWork;
  options.load.mechanical_load = load;
  return options;
}

/// The same bodies, which flow at this hardness.
inline Options flowing(double contact_modulus, double hardness, double load) {
  Options options = elastic(contact_modulus, load);
  options.deformation = Deformation::kThreeRegimes;
  options.lower.hardness = options.upper.hardness = hardness;
  return options;
}

/// What the half-space says of the same surface.
inline SolvedHalfSpace halfSpaceOf(const HeightMap& surface, const Options& options,
                                   bool flows = false) {
  HalfSpaceProblem problem;
  problem.surfaces.lower = surface;
  problem.lower_material = options.lower;
  problem.upper_material = options.upper;
  problem.interface = options.interface;
  problem.capillary = options.capillary;
  problem.load = options.load;
  HalfSpaceOptions half_space;
  half_space.flow = flows;
  return HalfSpaceSolver(half_space).solve(problem);
}

/// As equal bits as results can be.
inline bool sameFigures(const Prediction& one, const Prediction& other) {
  if (one.curve.size() != other.curve.size()) return false;
  for (std::size_t i = 0; i < one.curve.size(); ++i) {
    if (one.curve[i].displacement != other.curve[i].displacement ||
        one.curve[i].force != other.curve[i].force) {
      return false;
    }
  }
  return one.pull_off_force == other.pull_off_force && one.contact_area == other.contact_area &&
         one.apparent_work_of_adhesion == other.apparent_work_of_adhesion &&
         one.approach == other.approach && one.asperity_count == other.asperity_count;
}

}  // namespace separation_cases
}  // namespace mems_stiction
