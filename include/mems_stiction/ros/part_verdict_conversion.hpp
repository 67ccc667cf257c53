#pragma once

/// @file
/// What a part's scans say together, as a message.

#include <std_msgs/Header.h>

#include "mems_stiction/PartVerdict.h"
#include "mems_stiction/ros/predicted_scan.hpp"

namespace mems_stiction {

/// - @p scan the part's last one; its `part` must be there
PartVerdict partVerdictMessage(const PredictedScan& scan, const std_msgs::Header& header);

}  // namespace mems_stiction
