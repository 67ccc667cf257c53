#pragma once

/// @file
/// At which voltage does a beam snap down to its electrode?
///
/// The beam bends in one shape phi(x), that of an even load on the electrode, with max phi = 1. At
/// the amplitude a bending, residual stress and stretching pull it back, and the field between beam
/// and electrode pulls it down:
///
///     K1 a + K3 a^3 = (1/2) eps0 w V^2 integral over the electrode of
///             phi/(g + t_i/eps_i - a phi)^2 dx
///     K1 = (E w t^3/12) integral phi''^2 dx + sigma w t J,  K3 = E w t J^2/(2 l),
///             J = integral phi'^2 dx
///
/// (sigma and K3 of doubly clamped beams only). V(a) has its maximum at pull-in. A beam that lands
/// before it gets there is held down by the V of its landing. This is Rayleigh's method with one
/// shape, as Pamidighantam, Puers, Baert and Tilmans (J. Micromech. Microeng. 12 (2002) 458) use
/// it; against a finite-difference beam it is within 5 %
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
