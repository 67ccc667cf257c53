#pragma once

/// @file
/// From the core's prediction to messages; no figure is computed here.

#include <std_msgs/Header.h>

#include "mems_stiction/AsperityArray.h"
#include "mems_stiction/StictionPrediction.h"
#include "ros/predicted_scan.hpp"

namespace mems_stiction {

StictionPrediction predictionMessage(const PredictedScan& scan, const std_msgs::Header& header);

AsperityArray asperitiesMessage(const Prediction& prediction, const std_msgs::Header& header);

}  // namespace mems_stiction
