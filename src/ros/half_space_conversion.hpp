#pragma once

/// @file
/// From the half-space's answer to its message; field by field, no figure is computed here.

#include <string>

#include <std_msgs/Header.h>

#include "mems_stiction/HalfSpaceSolution.h"
#include "mems_stiction/half_space/half_space_solution.hpp"
#include "mems_stiction/loads/interface.hpp"

namespace mems_stiction {

/// Points of the message's curve each way; longer curves are thinned out evenly, the ends and the
/// largest force stay.
inline constexpr std::size_t kMostCurvePoints = 4096;

/// Without a verdict.
HalfSpaceSolution halfSpaceMessage(const SolvedHalfSpace& solved, const LoadOptions& load,
                                   const std_msgs::Header& header);

/// REFUSED, with every figure NaN and no verdict.
/// - @p reason becomes the message, on one line
HalfSpaceSolution refusedMessage(const std::string& reason, const LoadOptions& load,
                                 const std_msgs::Header& header);

}  // namespace mems_stiction
