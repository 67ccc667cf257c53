#pragma once

/// @file
/// How one asperity answers the approach that is imposed on it: the forces of section 2.2 of the
/// paper, before the load is shared.
///
/// The approach imposes the patch's radius rc, so the apparent load is JKR's for that contact
/// radius,
///
///     P1 = K rc^3/R,                       K = 4E/3
///
/// and the generalised force along the approach, under its share P0 = F_i cos(theta) of the load,
/// is the derivative of (8) with (10), where chi of (10.2) takes stored energy away and nothing
/// takes its place:
///
///     r = (1/3) [ 2 P0 - 2 P0^2/P1 - chi (P1 - P0^2/P1) + 6 pi Gamma R ]
///       = chi r_e + (1 - chi) r_p
///     r_e = -(1/3) [ (P1 - P0)^2/P1 - 6 pi Gamma R ],              elastic: zero where (7) applies
///     r_p =  (1/3) [ 2 P0 (P1 - P0)/P1 + 6 pi Gamma R ],      plastic: above zero wherever P1 > P0
///
/// The load that it can carry is chi P1 + (1 - chi) min(P1, Ha pi rc^2).

#include "mems_stiction/mechanics/material.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"
#include "paper/cap_couple.hpp"
#include "paper/formulation.hpp"

namespace mems_stiction {

/// What all asperities of one frame have in common.
struct AsperityLaw {
  double contact_modulus = 0.0;       ///< E [Pa]
  double stiffness = 0.0;             ///< K = 4E/3 [Pa]
  double hardness = 0.0;              ///< Ha [Pa]
  double work_of_adhesion = 0.0;      ///< Gamma [J/m^2]
  double composite_rms_height = 0.0;  ///< sigma [m]
  Formulation formulation = Formulation::kPaper;
  Deformation deformation = Deformation::kThreeRegimes;

  AsperityLaw() = default;
  AsperityLaw(const ContactPair& pair, double work_of_adhesion, double composite_rms_height,
              Formulation formulation, Deformation deformation);

  /// phi of (9) in the formulation that is set; 0 when all deformation is elastic.
  double plasticityIndexOf(double radius) const;
};

/// Everything about one asperity that does not depend on the load.
struct AsperityResponse {
  double radius = 0.0;      ///< R_i [m]
  double cap_radius = 0.0;  ///< rc [m]
  double load_weight =
      0.0;  ///< V_i of (6), the caps' volume, by which it shares the load [m^3] (printed: [m^4])
  double cos_tilt = 1.0;       ///< cos(theta)
  double imposed_load = 0.0;   ///< P1 [N]
  double yield_load = 0.0;     ///< Ha pi rc^2 [N]
  double elastic_share = 1.0;  ///< chi [-]

  AsperityResponse() = default;
  AsperityResponse(const CapCouple& caps, const AsperityLaw& law);

  double carriedLoad() const;
  /// dE_t/dD under the load P0 that acts along its axis [N]; positive pulls the surfaces together.
  double generalizedForce(double axial_load, const AsperityLaw& law) const;
};

}  // namespace mems_stiction
