#include "mems_stiction/ros/part_verdict_conversion.hpp"

#include "mems_stiction/ros/message_text.hpp"
#include "mems_stiction/ros/provenance_conversion.hpp"
#include "mems_stiction/verdict/regime_flags.hpp"

namespace mems_stiction {

PartVerdict partVerdictMessage(const PooledVerdict& part, const ScanOfPart& last) {
  PartVerdict message;
  message.header = last.header;
  fillProvenance(last.provenance, message);
  message.settings_hash = last.pool_settings_hash;
  message.scan_count = static_cast<std::uint32_t>(part.scan_count);
  message.counted_scans = static_cast<std::uint32_t>(part.counted_scans);
  message.sticks = static_cast<std::uint8_t>(part.sticks);
  message.reason = withoutCommas(part.reason);
  message.verdict_by = part.verdict_by;

  message.margin = part.margin.value;
  message.margin_lower = part.margin.lower;
  message.margin_upper = part.margin.upper;
  message.margin_spread = part.margin.spread;
  message.margin_place_spread = part.margin.place_spread;
  message.worst_margin = part.margin.worst;
  message.worst_margin_scan = part.margin.worst_scan;

  message.peel_number = part.peel_number.value;
  message.peel_number_lower = part.peel_number.lower;
  message.peel_number_upper = part.peel_number.upper;
  message.peel_number_spread = part.peel_number.spread;
  message.peel_number_place_spread = part.peel_number.place_spread;
  message.worst_peel_number = part.peel_number.worst;
  message.worst_peel_number_scan = part.peel_number.worst_scan;

  message.regime_flags = part.regime_flags;
  message.flags = regimeFlagList(part.regime_flags);
  message.warnings = withoutCommas(part.warnings);
  return message;
}

}  // namespace mems_stiction
