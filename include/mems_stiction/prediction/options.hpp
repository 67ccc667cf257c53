#pragma once

/// @file
/// Everything that a prediction depends on beside the surfaces. Keys, units, ranges: describe(); sources:
/// config/*.yaml.

#include <string>
#include <vector>

#include "mems_stiction/approach/approach_options.hpp"
#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/loads/capillary.hpp"
#include "mems_stiction/loads/interface.hpp"
#include "mems_stiction/mechanics/material.hpp"

namespace mems_stiction {

/// What predict() returns beside the figures; each costs time.
struct OutputOptions {
  bool deformed_surfaces = true;  ///< both surfaces after contact
  bool contact_map = true;        ///< 0 apart, 1 elastic, 2 elasto-plastic, 3 fully plastic
  bool asperities = true;         ///< one record per contact
  bool roughness = true;          ///< ISO 25178 figures of the lower surface
  bool energy_curve = false;      ///< one record per step of the approach

  void describe(OptionVisitor& visitor);
};

/// What AdhesionModel is constructed with.
struct Options {
  Material lower;
  Material upper;
  InterfaceOptions interface;
  CapillaryOptions capillary;
  LoadOptions load;
  ApproachOptions approach;
  OutputOptions output;

  void describe(OptionVisitor& visitor);

  /// One line per violated constraint: key, value, what is allowed. Empty when all is well.
  std::vector<std::string> validate() const;
  /// @throw OptionsError with the lines of validate(), if there are any.
  void check() const;
};

}  // namespace mems_stiction
