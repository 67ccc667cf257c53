#include "mems_stiction/contact/contact_settings.hpp"

#include "mechanics/traction_law.hpp"

namespace mems_stiction {

void ApproachOptions::describe(OptionVisitor& visitor) {
  visitor.integer("approach/max_steps", max_steps, Range::within(1, 10000000),
                  "the search ends after so many steps, without equilibrium");
  visitor.number("approach/max_contact_fraction", max_contact_fraction, "",
                 Range{0.0, 1.0, true, false},
                 "a share of overlapping cells beyond it counts as bonded");

  visitor.enumeration("approach/connectivity", connectivity,
                      {{"4", Connectivity::kFour}, {"8", Connectivity::kEight}},
                      "neighbours that join cells into one patch");
}

void OutputOptions::describe(OptionVisitor& visitor) {
  visitor.flag("output/deformed_surfaces", deformed_surfaces,
               "compute both surfaces after contact");
  visitor.flag("output/contact_map", contact_map, "compute the map of deformation regimes");
  visitor.flag("output/asperities", asperities, "compute one record per contact");
  visitor.flag("output/roughness", roughness,
               "compute the ISO 25178 figures of the scanned surface");
  visitor.flag("output/energy_curve", energy_curve,
               "keep the energies at every step of the approach");
}

double ContactSettings::gainedWork() const {
  return interface.work_of_adhesion + capillary.law().energy(0.0);
}

}  // namespace mems_stiction
