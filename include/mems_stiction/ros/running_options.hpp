#pragma once

/// @file
/// The settings that may change while the node runs: by ~set_load, by dynamic_reconfigure, through one setter
/// (LivePredictor::change()).

#include <dynamic_reconfigure/Config.h>

#include "mems_stiction/scan/configuration.hpp"

namespace mems_stiction {

/// Four sections of the configuration.
struct RunningOptions {
  InterfaceOptions interface;
  CapillaryOptions capillary;
  LoadOptions load;
  DeviceOptions device;

  RunningOptions() = default;
  explicit RunningOptions(const Configuration& configuration);

  void describe(OptionVisitor& visitor);
  void applyTo(Configuration& configuration) const;
};

/// For dynamic_reconfigure, whose names are the keys without their section (`voltage` for `load/voltage`).
dynamic_reconfigure::Config reconfigureMessage(const RunningOptions& options);

/// The described settings that the message holds are taken over; nothing is checked but the names of choices.
/// @throw OptionsError for a choice that is none.
void applyReconfigure(const dynamic_reconfigure::Config& message, RunningOptions& options);

}  // namespace mems_stiction
