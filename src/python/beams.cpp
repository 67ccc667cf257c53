/// How long beams may be that come off by themselves, and where stuck ones rest.

#include <pybind11/pybind11.h>

#include <string>

#include "bindings.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/verdict/beam_adhesion.hpp"

namespace mems_stiction {
namespace python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

Beam beamOf(const std::string& type, double thickness, double gap, double modulus,
            double residual_stress) {
  if (type != "cantilever" && type != "doubly_clamped") {
    throw OptionsError(
        {"beam_type: '" + type + "' is not allowed, must be one of cantilever, doubly_clamped"});
  }
  Beam beam;
  beam.type = type == "cantilever" ? BeamType::kCantilever : BeamType::kDoublyClamped;
  beam.thickness = thickness;
  beam.gap = gap;
  beam.modulus = modulus;
  beam.residual_stress = residual_stress;
  return beam;
}

/// A length of a beam by the apparent work of adhesion.
void bindLength(py::module& module, const char* name, double (*length)(const Beam&, double),
                const char* text) {
  module.def(
      name,
      [length](const std::string& type, double thickness, double gap, double modulus,
               double residual_stress, double work) {
        return length(beamOf(type, thickness, gap, modulus, residual_stress), work);
      },
      "beam_type"_a, "thickness"_a, "gap"_a, "modulus"_a, "residual_stress"_a, "work"_a, text);
}

}  // namespace

void bindBeams(py::module& module) {
  bindLength(module, "detachment_length", &detachmentLength,
             "of the longest beam that comes off by itself [m]");
  bindLength(module, "crack_length", &unstuckLength,
             "of the arm of a stuck beam that is S-shaped, from its clamp to where it lies on the "
             "substrate [m]");
}

}  // namespace python
}  // namespace mems_stiction
