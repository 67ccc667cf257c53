#pragma once

/// @file
/// From the core's prediction to messages; no figure is computed here.

#include <string>

#include <std_msgs/Header.h>

#include "mems_stiction/AsperityArray.h"
#include "mems_stiction/PartVerdict.h"
#include "mems_stiction/StictionPrediction.h"
#include "ros/predicted_scan.hpp"

namespace mems_stiction {

StictionPrediction predictionMessage(const PredictedScan& scan, const std_msgs::Header& header);

/// What matters of it in one line, for `rostopic echo`: name, verdict with its reason, force,
/// contacts, what speaks against it.
std::string summaryOf(const PredictedScan& scan);

/// What a part's scans say together.
/// - @p last the part's last scan
PartVerdict partVerdictMessage(const PooledVerdict& part, const ScanOfPart& last);

AsperityArray asperitiesMessage(const Prediction& prediction, const std_msgs::Header& header);

}  // namespace mems_stiction
