#include "mems_stiction/approach/approach_options.hpp"

namespace mems_stiction {

void ApproachOptions::describe(OptionVisitor& visitor) {
  visitor.integer("approach/max_steps", max_steps, Range::within(1, 10000000),
                  "the search ends after so many steps, without equilibrium");
  visitor.number("approach/max_contact_fraction", max_contact_fraction, "", Range{0.0, 1.0, true, false},
                 "a contact fraction beyond it counts as bonded");

  visitor.enumeration("approach/connectivity", connectivity, {{"4", Connectivity::kFour}, {"8", Connectivity::kEight}},
                      "neighbours that join cells into one patch");
}

}  // namespace mems_stiction
