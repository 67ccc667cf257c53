#include "verdict/contact_size.hpp"

#include <algorithm>

#include "errors/short_number.hpp"

namespace mems_stiction {
namespace {

constexpr double kRounding = 1e-9;  // of areas that were typed

}  // namespace

std::string contactSizeObjection(const Prediction& prediction, const DeviceOptions& device) {
  if (!(device.contact_area > 0.0) || !(prediction.nominal_area > 0.0)) return "";
  const double contact = device.contact_area / device.contacts;
  const double ratio = contact / prediction.nominal_area;
  if (std::max(ratio, 1.0 / ratio) <= kTrustedAreaRatio * (1.0 + kRounding)) return "";
  const std::string whose = device.contacts == 1
                                ? "the contact (device/contacts: 1)"
                                : "each of the " + std::to_string(device.contacts) + " contacts (device/contacts)";
  return whose + " has " + shortNumber(contact) + " m^2 and the scan " + shortNumber(prediction.nominal_area) +
         " m^2: forces do not go with area beyond a factor of 2; scan as much as one contact has or state in "
         "device/contacts how many separate contacts share device/contact_area";
}

}  // namespace mems_stiction
