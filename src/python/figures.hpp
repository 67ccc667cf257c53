#pragma once

/// @file
/// The figures of the core as a dictionary: names of the records of predict_scan, numbers, and words for enumerations.

#include <pybind11/pybind11.h>

#include <string>
#include <type_traits>
#include <utility>

#include "mems_stiction/half_space/half_space_fields.hpp"
#include "mems_stiction/prediction/prediction_fields.hpp"
#include "mems_stiction/verdict/verdict.hpp"
#include "mems_stiction/verdict/verdict_fields.hpp"

namespace mems_stiction {
namespace python {

/// Visitor that adds fields to a dictionary.
class DictionaryFields {
 public:
  template <typename Value>
  void operator()(const char* name, const Value& value, const char* /*unit*/) {
    if constexpr (std::is_same_v<Value, Sticks>) {
      dictionary[name] = sticksText(value);
    } else if constexpr (std::is_enum_v<Value>) {
      dictionary[name] = word(value);
    } else {
      dictionary[name] = value;
    }
  }

  pybind11::dict dictionary;
};

/// Visitor that lists names and units.
class UnitFields {
 public:
  template <typename Value>
  void operator()(const char* name, const Value& /*value*/, const char* unit) {
    units[name] = unit;
  }

  pybind11::dict units;
};

/// Its figures, and who judged: verdict_by.
inline pybind11::dict verdictFigures(const Verdict& verdict) {
  DictionaryFields fields;
  visitVerdictFields(verdict, fields);
  fields("verdict_by", judgeText(verdict.judge), "");
  return std::move(fields.dictionary);
}

}  // namespace python
}  // namespace mems_stiction
