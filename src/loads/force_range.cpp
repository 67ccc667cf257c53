#include "loads/force_range.hpp"

#include "mechanics/traction_law.hpp"

namespace mems_stiction {

double forceRange(const InterfaceOptions& interface) {
  if (interface.work_of_adhesion > 0.0 && interface.hamaker_constant > 0.0) {
    return AdhesionLaw::rangeOf(interface.work_of_adhesion, interface.hamaker_constant);
  }
  return interface.equilibrium_distance;
}

}  // namespace mems_stiction
