#pragma once

/// @file
/// Everything that a prediction depends on beside the surfaces. Keys, units, ranges: describe();
/// sources: config/*.yaml.
///
///     Options options;
///     options.formulation = "paper";
///     options.check();

#include <string>
#include <vector>

#include "mems_stiction/contact/contact_settings.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// The formulation that is used if none is stated.
extern const char* const kDefaultFormulation;

/// Names of the formulations, in the order of the documentation.
const std::vector<std::string>& formulationNames();

/// What AdhesionModel is constructed with.
struct Options : ContactSettings {
  std::string formulation = kDefaultFormulation;  ///< which solver: one of formulationNames()

  void describe(OptionVisitor& visitor);

  /// One line per violated constraint: key, value, what is allowed. Empty when all is well.
  std::vector<std::string> validate() const;
  /// @throw OptionsError with the lines of validate(), if there are any.
  void check() const;
};

}  // namespace mems_stiction
