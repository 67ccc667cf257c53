#include "ros/part_verdict_conversion.hpp"

#include "ros/message_fields.hpp"
#include "ros/message_text.hpp"
#include "verdict/part_verdict_fields.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {

PartVerdict partVerdictMessage(const PooledVerdict& part, const ScanOfPart& last) {
  PartVerdict message;
  message.header = last.header;
  message.version = last.provenance.version;
  message.settings_hash = last.pool_settings_hash;
  message.scan_name = last.provenance.scan_name;
  message.part_id = last.provenance.part_id;
  message.serial_id = last.provenance.serial_id;
  MessageFields fields;
  visitPartVerdictFields(part, fields);
  fields.fill(message);
  message.reason = withoutCommas(part.reason);
  message.flags = regimeFlagList(part.regime_flags);
  message.warnings = withoutCommas(part.warnings);
  return message;
}

}  // namespace mems_stiction
