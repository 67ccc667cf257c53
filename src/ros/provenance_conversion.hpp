#pragma once

/// @file
/// Where a result comes from, into the fields that every message with a result has, and back.

#include "mems_stiction/configuration/provenance.hpp"

namespace mems_stiction {

/// What was scanned: between ScanIdentity, ScanInfo and the messages with results, which name it alike.
template <typename Source, typename Target>
void copyIdentity(const Source& source, Target& target) {
  target.scan_name = source.scan_name;
  target.part_id = source.part_id;
  target.serial_id = source.serial_id;
  target.lot_id = source.lot_id;
  target.wafer_id = source.wafer_id;
  target.site_x = source.site_x;
  target.site_y = source.site_y;
  target.acquisition_time = source.acquisition_time;
  target.instrument = source.instrument;
  target.operator_name = source.operator_name;
  target.checksum = source.checksum;
}

template <typename Message>
void fillProvenance(const Provenance& provenance, Message& message) {
  message.version = provenance.version;
  message.settings_hash = provenance.settings_hash;
  copyIdentity(provenance, message);
}

template <typename Message>
Provenance provenanceIn(const Message& message) {
  Provenance provenance;
  provenance.version = message.version;
  provenance.settings_hash = message.settings_hash;
  copyIdentity(message, provenance);
  return provenance;
}

}  // namespace mems_stiction
