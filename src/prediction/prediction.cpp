#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

const char* word(BondingRegime regime) {
  constexpr const char* kWords[] = {"BONDING", "ADHERENCE", "NON_BONDING", "UNKNOWN"};
  return kWords[static_cast<int>(regime)];
}

const char* word(ContactTheory theory) {
  constexpr const char* kWords[] = {"DMT", "TRANSITION", "JKR", "UNKNOWN"};
  return kWords[static_cast<int>(theory)];
}

bool Prediction::isLowerBound() const {
  return status == Status::kBonded && model.is_bound_where_bonded;
}

bool Prediction::listsContacts() const {
  return has_asperities && static_cast<int>(asperities.size()) == asperity_count;
}

bool Prediction::listsHoldingContacts() const {
  return !pull_off_contacts.empty() || listsContacts();
}

const std::vector<Asperity>& Prediction::holdingContacts() const {
  return pull_off_contacts.empty() ? asperities : pull_off_contacts;
}

}  // namespace mems_stiction
