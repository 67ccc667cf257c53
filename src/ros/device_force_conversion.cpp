#include "ros/device_force_conversion.hpp"

#include "device/device_force_fields.hpp"
#include "errors/one_line.hpp"
#include "ros/message_fields.hpp"
#include "ros/message_parts.hpp"

namespace mems_stiction {

DeviceAdhesion deviceMessage(const DeviceForce& force, const LoadOptions& load,
                             const std_msgs::Header& header) {
  DeviceAdhesion message;
  message.header = header;
  MessageFields fields;
  visitDeviceForceFields(force, fields);
  fields.fill(message);
  message.voltage = load.voltage;
  message.mechanical_load = load.mechanical_load;
  for (const Realisation& made : force.realisations)
    message.realisations.push_back(made.pull_off_force);
  message.warnings = withoutCommas(force.warnings);
  message.processing_time = DeviceForce::kUnknown;
  clearVerdict(message);
  return message;
}

void fillVerdict(const Verdict& verdict, DeviceAdhesion& message) {
  fillVerdict<DeviceAdhesion>(verdict, message);
  message.restoring_force = verdict.restoring_force;
}

DeviceAdhesion refusedDevice(const std::string& reason, const LoadOptions& load,
                             const std_msgs::Header& header) {
  DeviceAdhesion message = deviceMessage(DeviceForce(), load, header);
  message.status = DeviceAdhesion::REFUSED;
  message.message = withoutCommas(oneLine(reason));
  return message;
}

}  // namespace mems_stiction
