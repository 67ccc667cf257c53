#pragma once

/// @file
/// How the half-space is solved, beside what it consists of.
///
///     HalfSpaceOptions options;
///     options.path = HalfSpacePath::kRest;
///     options.threads = 4;

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// What lies beyond the frame: copies of it, or a free, flat half-space.
enum class HalfSpaceBoundary { kPeriodic, kFree };

/// Which scans are solved as a half-space beside their predictions, and judged by it.
enum class HalfSpaceUse {
  kNever,
  kFlagged,  ///< where a device is stated, those whose flags say that the model's force may be far
             ///< out
  kAlways,
};

/// How much of the path is solved.
enum class HalfSpacePath {
  kWhole,  ///< down to rest and apart again
  kRest,   ///< down to rest, in longer steps
};

/// Settings of HalfSpaceSolver; keys half_space/...
struct HalfSpaceOptions {
  static constexpr double kFinestTolerance = 1e-6;  ///< the least that a tolerance may be

  HalfSpaceUse enabled = HalfSpaceUse::kFlagged;
  HalfSpacePath path = HalfSpacePath::kWhole;
  double range = 0.0;  ///< z0 of the traction law [m], >= 0; 0 derives it from work of adhesion and
                       ///< Hamaker constant
  bool attraction = true;  ///< false: surfaces only repel each other, closer than z0
  bool flow = true;        ///< false: no pressure is too high
  HalfSpaceBoundary boundary = HalfSpaceBoundary::kPeriodic;
  double step = 0.4;  ///< usual change of the height between two states, of z0 [-], in [0.01, 2]
  double tolerance =
      1e-4;  ///< largest residual of an equilibrium, of 8 Gamma/(3 z0) [-], in [1e-6, 1e-3]
  int max_states = 2000;             ///< solved on the path before it is given up, in [10, 1000000]
  int max_newton_steps = 10000;      ///< of one state, in [10, 100000]
  int max_pixels = 4194304;          ///< larger frames are refused, >= 1
  int max_flagged_pixels = 262144;   ///< of frames that are solved for their flags alone, >= 1
  int max_flagged_products = 20000;  ///< of the largest of them, >= 1
  int threads = 1;                   ///< in [1, 64]; results do not depend on it

  void describe(OptionVisitor& visitor);
};

}  // namespace mems_stiction
