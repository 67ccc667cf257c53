#pragma once

/// @file
/// The setting of how the part is led, which is a prediction's and changes while the node runs.

#include "mems_stiction/contact/contact_settings.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

inline void describeGuidance(OptionVisitor& visitor, Guidance& guidance) {
  visitor.enumeration(
      "device/guidance", guidance, {{"guided", Guidance::kGuided}, {"free", Guidance::kFree}},
      "whether the part stays level as it touches, or tilts until it rests on three contacts");
}

}  // namespace mems_stiction
