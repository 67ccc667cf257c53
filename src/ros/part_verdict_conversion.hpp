#pragma once

/// @file
/// What a part's scans say together, as a message.

#include "mems_stiction/PartVerdict.h"
#include "ros/predicted_scan.hpp"

namespace mems_stiction {

/// - @p last the part's last scan
PartVerdict partVerdictMessage(const PooledVerdict& part, const ScanOfPart& last);

}  // namespace mems_stiction
