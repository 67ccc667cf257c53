#pragma once

/// @file
/// What the cleaning of a scan has changed, for Python.

#include <pybind11/pybind11.h>

#include "mems_stiction/preprocess/pipeline.hpp"

namespace mems_stiction {
namespace python {

/// A dictionary for each step that ran, with the names of the records of predict_scan.
inline pybind11::list stepsOf(const PreprocessRecord& record) {
  pybind11::list steps;
  for (const PreprocessStep& step : record.steps) {
    pybind11::dict entry;
    entry["step"] = step.name;
    entry["parameters"] = step.parameters;
    entry["rms_change"] = step.rms_change;
    entry["changed_pixels"] = step.changed_pixels;
    entry["invalid_pixels"] = step.invalid_pixels;
    steps.append(entry);
  }
  return steps;
}

}  // namespace python
}  // namespace mems_stiction
