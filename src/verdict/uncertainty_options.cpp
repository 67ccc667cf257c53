#include "mems_stiction/verdict/uncertainty_options.hpp"

namespace mems_stiction {

void UncertaintyOptions::describe(OptionVisitor& visitor) {
  const Range relative = Range::within(0.0, 1.0);
  visitor.number("uncertainty/work_of_adhesion", work_of_adhesion, "", relative,
                 "relative standard uncertainty of the work of adhesion");
  visitor.number("uncertainty/hardness", hardness, "", relative,
                 "relative standard uncertainty of the hardness");
  visitor.number("uncertainty/youngs_modulus", youngs_modulus, "", relative,
                 "relative standard uncertainty of Young's modulus");
  visitor.number("uncertainty/pitch", pitch, "", relative,
                 "relative standard uncertainty of the scan's pitch");
  visitor.number("uncertainty/cutoff_distance", cutoff_distance, "", relative,
                 "relative standard uncertainty of the cut-off distance");
  visitor.number("uncertainty/hamaker_constant", hamaker_constant, "", relative,
                 "relative standard uncertainty of the Hamaker constant");
  visitor.number("uncertainty/contact_potential", contact_potential, "", relative,
                 "relative standard uncertainty of the contact potential");
  visitor.flag("uncertainty/scan_sampling", scan_sampling,
               "count that another place of the surface would have other contacts");
  visitor.integer("uncertainty/samples", samples, Range::within(20, 100000),
                  "samples of the uncertain constants");
  visitor.integer("uncertainty/seed", seed, Range::nonNegative(),
                  "the same seed gives the same samples");
}

}  // namespace mems_stiction
