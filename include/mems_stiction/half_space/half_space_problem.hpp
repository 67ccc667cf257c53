#pragma once

/// @file
/// What the half-space is asked.

#include "mems_stiction/loads/capillary.hpp"
#include "mems_stiction/loads/interface.hpp"
#include "mems_stiction/mechanics/material.hpp"
#include "mems_stiction/surface/surface_pair.hpp"

namespace mems_stiction {

/// Two surfaces, their bodies, what acts between them and what presses them together.
struct HalfSpaceProblem {
  SurfacePair surfaces;
  Material lower_material;
  Material upper_material;
  InterfaceOptions interface;
  CapillaryOptions capillary;
  LoadOptions load;
};

}  // namespace mems_stiction
