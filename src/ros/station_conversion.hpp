#pragma once

/// @file
/// From sweeps and cycles to messages; field by field, no figure is computed here.

#include "mems_stiction/CycleContactResult.h"
#include "mems_stiction/SweepLoadResult.h"
#include "station/contact_cycles.hpp"
#include "station/load_sweep.hpp"

namespace mems_stiction {

/// Header and message are the caller's.
SweepLoadResult sweepMessage(const LoadSweepResult& sweep);
CycleContactResult cyclesMessage(const ContactCyclesResult& cycles);

}  // namespace mems_stiction
