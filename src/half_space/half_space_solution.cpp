#include "mems_stiction/half_space/half_space_solution.hpp"

namespace mems_stiction {

const char* word(HalfSpaceStatus status) {
  constexpr const char* kWords[] = {"SOLVED", "LOAD_NOT_REACHED", "NOT_CONVERGED",
                                    "TOO_MANY_STATES", "CANCELLED"};
  return kWords[static_cast<int>(status)];
}

}  // namespace mems_stiction
