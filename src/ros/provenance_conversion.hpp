#pragma once

/// @file
/// Where a result comes from, into the fields that every message with a result has, and back.

#include "mems_stiction/configuration/provenance.hpp"

namespace mems_stiction {

template <typename Message>
void fillProvenance(const Provenance& provenance, Message& message) {
  message.version = provenance.version;
  message.settings_hash = provenance.settings_hash;
  message.scan_name = provenance.scan_name;
  message.part_id = provenance.part_id;
  message.serial_id = provenance.serial_id;
}

template <typename Message>
Provenance provenanceIn(const Message& message) {
  Provenance provenance;
  provenance.version = message.version;
  provenance.settings_hash = message.settings_hash;
  provenance.scan_name = message.scan_name;
  provenance.part_id = message.part_id;
  provenance.serial_id = message.serial_id;
  return provenance;
}

}  // namespace mems_stiction
