#include "mems_stiction/loads/force_range.hpp"

#include <cmath>

#include "mems_stiction/base/constants.hpp"

namespace mems_stiction {

double forceRange(const InterfaceOptions& interface) {
  if (interface.work_of_adhesion > 0.0 && interface.hamaker_constant > 0.0) {
    return std::sqrt(interface.hamaker_constant / (16.0 * kPi * interface.work_of_adhesion));
  }
  return interface.equilibrium_distance;
}

}  // namespace mems_stiction
