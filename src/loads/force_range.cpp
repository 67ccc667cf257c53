#include "loads/force_range.hpp"

#include <utility>

namespace mems_stiction {

CoatedBody coatedBody(const Material& body) { return {body.film_thickness, body.hamaker_constant}; }

AdhesionLaw adhesionLaw(const InterfaceOptions& interface, const Material& lower,
                        const Material& upper) {
  const double work = interface.work_of_adhesion;
  if (work > 0.0 && interface.hamaker_constant > 0.0) {
    const LayeredAttraction attraction(interface.hamaker_constant, coatedBody(lower),
                                       coatedBody(upper), interface.retardation_length);
    return {work, AdhesionLaw::rangeOf(work, attraction), attraction};
  }
  // by which constant does not matter: the range tells it
  return {work, interface.equilibrium_distance,
          LayeredAttraction(1.0, CoatedBody(), CoatedBody(), interface.retardation_length)};
}

FieldLaw fieldLaw(double voltage, const InterfaceOptions& interface) {
  return {voltage, interface.insulator_thickness, interface.insulator_relative_permittivity};
}

double forceRange(const InterfaceOptions& interface, const Material& lower, const Material& upper) {
  return adhesionLaw(interface, lower, upper).range();
}

std::vector<std::string> filmContradictions(const InterfaceOptions& interface,
                                            const Material& lower, const Material& upper) {
  std::vector<std::string> lines;
  if (interface.hamaker_constant > 0.0) return lines;
  for (const auto& [name, body] : {std::pair("lower", &lower), std::pair("upper", &upper)}) {
    if (body->film_thickness == 0.0 || body->hamaker_constant == 0.0) continue;
    lines.push_back(name + ("/film_thickness: " + numberText(body->film_thickness)) +
                    " m with interface/hamaker_constant 0 J is not allowed: the film attracts by "
                    "that constant; must be 0 m, or the constant > 0 J");
  }
  return lines;
}

}  // namespace mems_stiction
