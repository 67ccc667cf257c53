#include "verdict/contact_size.hpp"

#include <algorithm>

#include "errors/short_number.hpp"
#include "numeric/rounding.hpp"

namespace mems_stiction {
bool hasSizeOfScan(const Prediction& prediction, const DeviceOptions& device) {
  if (!(device.contact_area > 0.0) || !(prediction.nominal_area > 0.0)) return true;
  const double ratio = device.contact_area / device.contacts / prediction.nominal_area;
  return !exceeds(std::max(ratio, 1.0 / ratio), kTrustedAreaRatio);
}

std::string whatSizeLacks(const Prediction& prediction, const DeviceOptions& device,
                          const std::string& why) {
  const std::string whose =
      device.contacts == 1
          ? "the contact (device/contacts: 1)"
          : "each of the " + std::to_string(device.contacts) + " contacts (device/contacts)";
  return "the device's own force has not been found" + (why.empty() ? "" : " (" + why + ")") +
         ": " + whose + " has " + shortNumber(device.contact_area / device.contacts) +
         " m^2 and the scan " + shortNumber(prediction.nominal_area) +
         " m^2, and forces do not go with area beyond a factor of 2" +
         (why.empty() ? "; set device_force/enabled, or ask predict_device" : "");
}

}  // namespace mems_stiction
