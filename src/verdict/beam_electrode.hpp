#pragma once

/// @file
/// At which voltage does a beam snap down to its electrode?
///
/// The voltage V(a) that holds one place of the beam at the deflection a has its maximum at
/// pull-in. A beam that lands before it gets there is held down by the V of its landing. For each a
/// bending, residual stress and stretching balance the field over the whole beam, by Ritz's method
/// (bent_beam.hpp); within 2 % of a finite-difference beam
/// (test/core/verdict/beam_electrode_test.cpp). No fringes; slender beam, small slopes, rigid
/// clamps.

#include <optional>

#include "mems_stiction/verdict/beam_adhesion.hpp"
#include "mems_stiction/verdict/device_options.hpp"

namespace mems_stiction {

/// What lies below the beam.
struct BeamElectrode {
  double start = 0.0;          ///< from the clamp, or from the left one [m], >= 0
  double length = 0.0;         ///< along the beam [m], > 0
  double gap = 0.0;            ///< g between beam and insulator at rest [m], >= the beam's gap
  double insulator_gap = 0.0;  ///< t_i/eps_i [m], >= 0
};

/// That of a device that states a beam alone, its width and where the electrode lies; nothing for
/// others.
std::optional<BeamElectrode> electrodeOf(const DeviceOptions& device,
                                         const InterfaceOptions& interface);

/// Voltage at which the beam closes its gap [V]. NaN for BeamType::kNone or no width.
double beamClosingVoltage(const Beam& beam, const BeamElectrode& electrode);

}  // namespace mems_stiction
