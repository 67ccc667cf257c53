#include "mems_stiction/half_space/half_space_options.hpp"

namespace mems_stiction {

void HalfSpaceOptions::describe(OptionVisitor& visitor) {
  visitor.enumeration("half_space/enabled", enabled,
                      {{"false", HalfSpaceUse::kNever},
                       {"flagged", HalfSpaceUse::kFlagged},
                       {"true", HalfSpaceUse::kAlways}},
                      "which scans are solved so, and their device judged by it: none; where a "
                      "device is stated those whose flags say "
                      "that the model's force may be far out; every one (the node: the newest)");
  visitor.enumeration("half_space/path", path,
                      {{"whole", HalfSpacePath::kWhole}, {"rest", HalfSpacePath::kRest}},
                      "what is solved: down to rest and apart again; or the rest alone, which "
                      "knows contact area, gap, "
                      "pressure and stiffness, but no pull-off force");
  visitor.number("half_space/range", range, "m", Range::nonNegative(),
                 "z0, the gap at which the traction between the surfaces changes sign; 0 = from "
                 "interface/work_of_adhesion and interface/hamaker_constant");
  visitor.flag("half_space/attraction", attraction,
               "whether the surfaces attract each other at all");
  visitor.flag("half_space/flow", flow,
               "whether pressures above the hardness change the surfaces for good");
  visitor.enumeration(
      "half_space/boundary", boundary,
      {{"periodic", HalfSpaceBoundary::kPeriodic}, {"free", HalfSpaceBoundary::kFree}},
      "what lies beyond the frame: copies of it, or nothing that touches");
  visitor.number("half_space/step", step, "", Range::within(0.01, 2.0),
                 "usual change of the height between two states, over z0; it adapts to the curve");
  visitor.number("half_space/tolerance", tolerance, "", Range::within(kFinestTolerance, 1e-3),
                 "largest traction out of balance in an equilibrium, over 8 Gamma/(3 z0)");
  visitor.integer("half_space/max_states", max_states, Range::within(10, 1000000),
                  "states on the path before it is given up");
  visitor.integer("half_space/max_newton_steps", max_newton_steps, Range::within(10, 100000),
                  "Newton steps of one state before it is given up");
  visitor.integer("half_space/max_pixels", max_pixels, Range::within(1, 1000000000),
                  "larger frames are refused; a pixel takes up to 300 bytes");
  visitor.integer("half_space/max_flagged_pixels", max_flagged_pixels, Range::within(1, 1000000000),
                  "larger frames are not solved for their flags alone");
  visitor.integer("half_space/max_flagged_products", max_flagged_products,
                  Range::within(1, 2000000000),
                  "pairs of Fourier transforms: limit of a solution that only flags asked for, at "
                  "the largest such frame; half as many pixels may take twice as many");
  visitor.integer("half_space/threads", threads, Range::within(1, 64),
                  "threads of one solution; its bits do not change");
}

}  // namespace mems_stiction
