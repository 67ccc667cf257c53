#pragma once

/// @file
/// Where a result comes from, into the fields that every message with a result has.

#include "mems_stiction/scan/provenance.hpp"

namespace mems_stiction {

template <typename Message>
void fillProvenance(const Provenance& provenance, Message& message) {
  message.version = provenance.version;
  message.settings_hash = provenance.settings_hash;
  message.scan_name = provenance.scan_name;
  message.part_id = provenance.part_id;
  message.serial_id = provenance.serial_id;
}

}  // namespace mems_stiction
