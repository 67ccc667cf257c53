#pragma once

/// @file
/// Between the running settings and dynamic_reconfigure, whose names are the keys without their section (`voltage` for
/// `load/voltage`).

#include <dynamic_reconfigure/Config.h>

#include "configuration/running_settings.hpp"

namespace mems_stiction {

dynamic_reconfigure::Config reconfigureMessage(const RunningSettings& settings);

/// The described settings that the message has are taken over; nothing is checked but the names of choices.
/// @throw OptionsError for a choice that is none.
void applyReconfigure(const dynamic_reconfigure::Config& message, RunningSettings& settings);

}  // namespace mems_stiction
