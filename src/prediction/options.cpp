#include "mems_stiction/prediction/options.hpp"

#include "mems_stiction/base/errors.hpp"

namespace mems_stiction {

void OutputOptions::describe(OptionVisitor& visitor) {
  visitor.flag("output/deformed_surfaces", deformed_surfaces, "compute both surfaces after contact");
  visitor.flag("output/contact_map", contact_map, "compute the map of deformation regimes");
  visitor.flag("output/asperities", asperities, "compute one record per contact");
  visitor.flag("output/roughness", roughness, "compute the ISO 25178 figures of the scanned surface");
  visitor.flag("output/energy_curve", energy_curve, "keep the energies at every step of the approach");
}

void Options::describe(OptionVisitor& visitor) {
  lower.describe(visitor, "lower");
  upper.describe(visitor, "upper");
  interface.describe(visitor);
  capillary.describe(visitor);
  load.describe(visitor);
  approach.describe(visitor);
  output.describe(visitor);
}

std::vector<std::string> Options::validate() const {
  Options copy = *this;  // describe() shows mutable fields; the validator only reads them
  OptionValidator validator;
  copy.describe(validator);
  std::vector<std::string> violations = validator.violations();
  if (load.voltage != 0.0 && interface.insulator_thickness == 0.0) {
    violations.push_back("interface/insulator_thickness: 0 m is not allowed with load/voltage " +
                         numberText(load.voltage) +
                         " V: bare surfaces in contact short-circuit; must be > 0 m, or the voltage 0 V");
  }
  return violations;
}

void Options::check() const {
  std::vector<std::string> violations = validate();
  if (!violations.empty()) throw OptionsError(std::move(violations));
}

}  // namespace mems_stiction
