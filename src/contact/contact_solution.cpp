#include "mems_stiction/contact/contact_solution.hpp"

#include <utility>

namespace mems_stiction {

const char* word(Status status) {
  constexpr const char* kWords[] = {"EQUILIBRIUM", "BONDED", "NO_EQUILIBRIUM"};
  return kWords[static_cast<int>(status)];
}

void ContactSolution::clear() {
  ContactSolution fresh;
  fresh.asperities.swap(asperities);
  fresh.pull_off_contacts.swap(pull_off_contacts);
  fresh.energy_curve.swap(energy_curve);
  fresh.curve.swap(curve);
  fresh.asperities.clear();
  fresh.pull_off_contacts.clear();
  fresh.energy_curve.clear();
  fresh.curve.clear();
  std::swap(fresh.contact_map, contact_map);
  std::swap(fresh.displaced_lower, displaced_lower);
  std::swap(fresh.displaced_upper, displaced_upper);
  std::swap(fresh.pressure, pressure);
  *this = std::move(fresh);
}

}  // namespace mems_stiction
