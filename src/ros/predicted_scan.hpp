#pragma once

/// @file
/// All that is said about one scan.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <std_msgs/Header.h>

#include "evaluation/half_space_call.hpp"
#include "evaluation/part_scans.hpp"
#include "mems_stiction/configuration/provenance.hpp"
#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/verdict/verdict.hpp"
#include "verdict/part_verdict.hpp"

namespace mems_stiction {

/// Which scan it was, and to which pool of a part's scans it belongs.
struct ScanOfPart {
  std_msgs::Header header;
  Provenance provenance;           ///< what was scanned, and what it was predicted with
  std::string pool_settings_hash;  ///< of the settings that the scans of the pool share
  std::uint64_t id =
      0;  ///< tells it from the others: its stamp, or a number of its own if it has none
};

/// Whether both state the same part, or are one scan.
inline bool areOfOnePart(const ScanOfPart& one, const ScanOfPart& other) {
  const Provenance& of = one.provenance;
  const bool has_part = PartKey{of.part_id, of.serial_id, ""}.isStated();
  return one.id == other.id || (has_part && of.part_id == other.provenance.part_id &&
                                of.serial_id == other.provenance.serial_id);
}

/// What all scans of a part say, and the last of them.
struct PartNews {
  PooledVerdict verdict;
  ScanOfPart last;
};

/// A prediction with what belongs to it in the message.
struct PredictedScan {
  Prediction prediction;
  Verdict verdict;                    ///< on the device, from this prediction
  PreprocessRecord preprocessing;     ///< what was done to the scan before
  std::string formulation;            ///< approach/formulation
  std::vector<std::string> warnings;  ///< about scan and settings, in words
  Provenance provenance;              ///< what was scanned, and what it was predicted with
  std::optional<PooledVerdict>
      part;  ///< what all scans of its part say with it; nothing if it states no part
  std::string pool_settings_hash;  ///< of the settings that those scans share
  std::uint64_t scan_id = 0;       ///< ScanOfPart::id; 0: not from the topic
  HalfSpaceCall half_space;        ///< whether it is to be solved as a half-space
};

}  // namespace mems_stiction
