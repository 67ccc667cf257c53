#include "mems_stiction/prediction/configuration.hpp"

#include "mems_stiction/base/errors.hpp"

namespace mems_stiction {

void Configuration::describe(OptionVisitor& visitor) {
  model.describe(visitor);
  scan.describe(visitor);
  preprocessing.describe(visitor);
  counter_surface.describe(visitor);
  device.describe(visitor);
  uncertainty.describe(visitor);
}

std::vector<std::string> Configuration::validate() const {
  std::vector<std::string> violations = model.validate();
  Configuration copy = *this;  // describe() shows mutable fields; the validator only reads them
  OptionValidator validator;
  copy.scan.describe(validator);
  copy.preprocessing.describe(validator);
  copy.counter_surface.describe(validator);
  copy.uncertainty.describe(validator);
  violations.insert(violations.end(), validator.violations().begin(), validator.violations().end());
  const std::vector<std::string> of_device = device.validate();
  violations.insert(violations.end(), of_device.begin(), of_device.end());
  if (scan.height_scale == 0.0) {
    violations.push_back(
        "scan/height_scale: 0 m per unit of the pixel is not allowed, it makes every surface flat; must not be 0");
  }
  if ((scan.pitch_x > 0.0) != (scan.pitch_y > 0.0)) {
    violations.push_back("scan/pitch_x: " + numberText(scan.pitch_x) + " m with scan/pitch_y " +
                         numberText(scan.pitch_y) + " m is not allowed; both must be > 0 m, or both 0");
  }
  return violations;
}

void Configuration::check() const {
  std::vector<std::string> violations = validate();
  if (!violations.empty()) throw OptionsError(std::move(violations));
}

}  // namespace mems_stiction
