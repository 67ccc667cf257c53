#include "mems_stiction/height_map/scan_identity.hpp"

#include <cmath>
#include <cstring>
#include <type_traits>

namespace mems_stiction {
namespace {

template <typename Value>
constexpr bool kIsText = std::is_same_v<std::decay_t<Value>, std::string>;

}  // namespace

void ScanIdentity::describe(OptionVisitor& visitor) {
  visitScanIdentityFields(*this, [&](const Figure& figure, auto& value) {
    if (std::strcmp(figure.name, "checksum") == 0) return;
    const std::string key = std::string("scan/") + figure.name;
    if constexpr (kIsText<decltype(value)>) {
      visitor.text(key, value, figure.meaning);
    } else {
      visitor.number(key, value, figure.unit, Range::anyOrNone(), figure.meaning);
    }
  });
  visitor.formerName("scan/operator", "scan/operator_name");
}

ScanIdentity commonIdentity(const ScanIdentity& one, const ScanIdentity& other) {
  ScanIdentity common;
  for (std::string ScanIdentity::*text :
       {&ScanIdentity::part_id, &ScanIdentity::serial_id, &ScanIdentity::lot_id,
        &ScanIdentity::wafer_id, &ScanIdentity::instrument, &ScanIdentity::operator_name}) {
    if (one.*text == other.*text) common.*text = one.*text;
  }
  return common;
}

std::vector<std::string> identityComplaints(const ScanIdentity& identity,
                                            const std::string& prefix) {
  std::vector<std::string> lines;
  visitScanIdentityFields(identity, [&](const Figure& figure, const auto& value) {
    if constexpr (kIsText<decltype(value)>) {
      if (value.size() <= kLongestName) return;
      lines.push_back(prefix + figure.name + ": a name of " + std::to_string(value.size()) +
                      " bytes is not allowed, must have at most " + std::to_string(kLongestName));
    } else if (std::isinf(value)) {
      lines.push_back(prefix + figure.name + ": " + numberText(value) +
                      " is not allowed, must be a finite number, or nan for none");
    }
  });
  const bool has_x = isStated(identity.site_x);
  if (has_x != isStated(identity.site_y)) {
    lines.push_back(prefix + (has_x ? "site_x" : "site_y") + ": " +
                    numberText(has_x ? identity.site_x : identity.site_y) + " is stated without " +
                    (has_x ? "site_y" : "site_x") + ": state both, or none");
  }
  return lines;
}

}  // namespace mems_stiction
