#include "separation/contact_traction.hpp"

#include "loads/force_range.hpp"

namespace mems_stiction {
ContactTraction::ContactTraction(const InterfaceOptions& interface)
    : work_of_adhesion_(interface.work_of_adhesion), law_(work_of_adhesion_, forceRange(interface)) {}

}  // namespace mems_stiction
