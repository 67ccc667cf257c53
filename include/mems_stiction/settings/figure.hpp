#pragma once

/// @file
/// What a table of figures says of each: its name, its unit and what it is. The tables are the one
/// place where a figure is declared; records, rows, messages and the attributes of Python follow
/// from them.
///
///     const Figure figure{"mean_gap", "m", "of the surfaces at rest"};
///     print(figure.name, figure.unit);

#include <type_traits>

namespace mems_stiction {

/// The declaration of a figure beside its value, whose type says whether it is a number, a count, a
/// word or a yes.
struct Figure {
  const char* name;  ///< of the field in records, rows, messages and Python
  const char* unit = "";
  const char* meaning = "";  ///< for people, behind name and unit
};

/// The value as records and rows show it: an enumeration by its word().
template <typename Value>
auto shown(const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    return word(value);
  } else {
    return value;
  }
}

}  // namespace mems_stiction
