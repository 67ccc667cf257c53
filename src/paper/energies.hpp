#pragma once

/// @file
/// The energies along the approach, (8) and (10) with JKR's exponents, which the print lost.
///
///     p   = 1/(K^(2/3) R^(1/3))
///     E_m = sum p P0 [ P1^(2/3)/3 + (2/3) P0 P1^(-1/3) ]               (10.1)
///     E_s = pi Gamma sum rc^2                                          (10.1)
///     E_e = sum p chi [ P1^(5/3)/15 + P0^2 P1^(-1/3)/3 ]               (10.2)
///     E_t = E_m + E_s - E_e                                            (8)
///
/// E_t is minus JKR's total energy: equilibrium is a maximum of E_t.
/// Source: Johnson, Kendall and Roberts 1971 for the exponents; equations of Deladi et al. 2002.

#include "paper/asperity_response.hpp"

namespace mems_stiction {

/// The terms of (8), summed over the asperities [J].
struct Energies {
  double mechanical = 0.0;  ///< E_m [J]
  double surface = 0.0;     ///< E_s [J]
  double elastic = 0.0;     ///< E_e [J]

  double total() const { return mechanical + surface - elastic; }
  Energies& operator+=(const Energies& other);
};

/// Energies of one asperity under the axial load P0 [N].
Energies asperityEnergies(const AsperityResponse& asperity, double axial_load,
                          const AsperityLaw& law);

}  // namespace mems_stiction
