#pragma once

/// @file
/// The parts of the module mems_stiction._core. What users see of it is in python/mems_stiction.

#include <pybind11/pybind11.h>

namespace mems_stiction {
namespace python {

void bindErrors(pybind11::module& module);
void bindSettings(pybind11::module& module);
void bindScans(pybind11::module& module);
void bindPrediction(pybind11::module& module);
void bindDevice(pybind11::module& module);
void bindMadeSurface(pybind11::module& module);
void bindHalfSpace(pybind11::module& module);
void bindStation(pybind11::module& module);
void bindBeams(pybind11::module& module);

}  // namespace python
}  // namespace mems_stiction
