#pragma once

/// @file
/// What does the mechanics of the whole surface say about its adhesion?
///
/// Both surfaces as one elastic half-space with the composite roughness, a traction between them
/// that depends on the gap (traction_law.hpp), equilibrium by minimising the energy
/// (contact_minimiser.hpp), heights from apart to rest under voltage and mechanical load, and back
/// without them (contact_path.hpp). A body with a thickness bends, or feels its substrate.
/// Assumptions: slopes are small, no friction, no time. Pixels must resolve the length over which a
/// contact parts, E z0^2/Gamma, or its edge is caught by the lattice: is_resolved says so.
/// One-pixel contacts are flat punches: no better than the scan. The asperity model answers the
/// same question a thousand times faster, with what it assumes about contacts. Sources: see the
/// parts; Medina and Dini, Int. J. Solids Struct. 51 (2014) 2620 for spheres that jump under such a
/// law.
///
///     HalfSpaceProblem problem;
///     problem.surfaces = scan;  // against a plane
///     const SolvedHalfSpace solution = HalfSpaceSolver(HalfSpaceOptions()).solve(problem);
///     if (solution.status == HalfSpaceStatus::kSolved) use(solution.pull_off_force);

#include <atomic>
#include <cstddef>
#include <functional>

#include "mems_stiction/half_space/half_space_options.hpp"
#include "mems_stiction/half_space/half_space_solution.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/loads/capillary.hpp"
#include "mems_stiction/loads/interface.hpp"
#include "mems_stiction/mechanics/material.hpp"

namespace mems_stiction {

/// Two surfaces, their bodies, what acts between them and what presses them together.
struct HalfSpaceProblem {
  SurfacePair surfaces;
  Material lower_material;
  Material upper_material;
  InterfaceOptions interface;
  CapillaryOptions capillary;
  LoadOptions load;
  bool may_tilt = false;  ///< the plate of its own; solved as it lies in the frame nevertheless
};

/// How a caller watches and stops a solution.
struct HalfSpaceControl {
  std::function<void(const ForcePoint&)>
      on_state;                               ///< after each height; may be empty, must not throw
  const std::atomic<bool>* cancel = nullptr;  ///< looked at after each transform; may be null
  std::function<void()>
      give_way;  ///< before each product, which may wait there (solution_pause.hpp); may be empty
};

/// Solves one problem after the other with the same settings; for any number of threads at a time.
class HalfSpaceSolver {
 public:
  /// @throw OptionsError for options out of range
  explicit HalfSpaceSolver(const HalfSpaceOptions& options);

  const HalfSpaceOptions& options() const { return options_; }

  /// @throw OptionsError for a work of adhesion, Hamaker constant, material or load that has no
  /// solution;
  ///        SurfaceError for a frame without a valid pixel, of more than max_pixels, or grids that
  ///        differ
  SolvedHalfSpace solve(const HalfSpaceProblem& problem,
                        const HalfSpaceControl& control = HalfSpaceControl()) const;

 private:
  HalfSpaceOptions options_;
};

/// The largest pixels [m] that are small enough for the edges of contacts: two per cohesive length.
/// @throw OptionsError as solve()
double resolvingPitch(const HalfSpaceProblem& problem, const HalfSpaceOptions& options);

/// Whether those of the frame are (SolvedHalfSpace::is_resolved): known before it is solved.
/// @throw OptionsError as solve()
bool isResolved(const HalfSpaceProblem& problem, const HalfSpaceOptions& options);

}  // namespace mems_stiction
