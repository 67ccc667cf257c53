#include "mems_stiction/prediction/options.hpp"

#include <utility>

#include "loads/force_range.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "prediction/contact_solvers.hpp"

namespace mems_stiction {

void Options::describe(OptionVisitor& visitor) {
  lower.describe(visitor, "lower");
  upper.describe(visitor, "upper");
  interface.describe(visitor);
  capillary.describe(visitor);
  load.describe(visitor);
  approach.describe(visitor);
  visitor.choice("approach/formulation", formulation, formulationNames(),
                 "which solver: the separation curve, or the paper with roots and exponents "
                 "restored, or to the letter");
  visitor.enumeration(
      "approach/deformation", deformation,
      {{"three_regimes", Deformation::kThreeRegimes}, {"elastic", Deformation::kElastic}},
      "elastic, elasto-plastic and plastic asperities, or all of them elastic");
  describeOwnSettings(solver, visitor);
  output.describe(visitor);
}

std::vector<std::string> Options::validate() const {
  std::vector<std::string> violations = rangeViolations(*this);
  const std::string reason = retirement(formulation);
  if (!reason.empty()) violations.push_back(reason);
  if (interface.insulator_thickness == 0.0) {
    const std::string not_allowed = "interface/insulator_thickness: 0 m is not allowed with ";
    if (load.voltage != 0.0) {
      violations.push_back(
          not_allowed + "load/voltage " + numberText(load.voltage) +
          " V: bare surfaces in contact short-circuit; must be > 0 m, or the voltage 0 V");
    }
    if (load.contact_potential != 0.0) {
      violations.push_back(not_allowed + "load/contact_potential " +
                           numberText(load.contact_potential) +
                           " V: its field has no limit where bare surfaces touch; must be > 0 m, "
                           "such as the native oxides, or the potential 0 V");
    }
  }
  for (const auto& [name, body] : {std::pair("lower", &lower), std::pair("upper", &upper)}) {
    for (std::string& contradiction : body->contradictions(name))
      violations.push_back(std::move(contradiction));
  }
  for (std::string& contradiction : filmContradictions(interface, lower, upper))
    violations.push_back(std::move(contradiction));
  const int stated =
      (load.mechanical_load > 0.0) + (load.pressure > 0.0) + (load.device_force > 0.0);
  if (stated > 1) {
    violations.push_back("load/mechanical_load: " + numberText(load.mechanical_load) +
                         " N with load/pressure " + numberText(load.pressure) +
                         " Pa and load/device_force " + numberText(load.device_force) +
                         " N is not allowed; one of them presses, the others must be 0");
  }
  return violations;
}

void Options::check() const {
  std::vector<std::string> violations = validate();
  if (!violations.empty()) throw OptionsError(std::move(violations));
}

}  // namespace mems_stiction
