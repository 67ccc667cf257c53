#pragma once

/// @file
/// Does an asperity deform elastically, plastically, or in between?
///
///     phi = (E/Ha) sqrt(sigma/R)                            (9), with the root that its print lost
///     chi = 1 for phi < 0.6,  1 - 2 (phi - 0.6) between,  0 for phi > 1.1             (10.2)
///
/// Assumptions: spherical summits of one radius, Gaussian heights; phi compares the rms height with
/// the depth at which such a summit starts to flow. Applies to nominally flat rough surfaces. Below
/// 0.6 flow needs very high loads, above 1.1 it starts at almost none; the straight line between is
/// an interpolation. Outside: radius = infinity gives phi = 0 (elastic); hardness = infinity does
/// too. A NaN stays NaN in phi. Source: Greenwood and Williamson, Proc. R. Soc. A 295 (1966) 300
/// for phi and both limits; Deladi et al. 2002, (9) and (10.2) for chi.
///
///     const double phi = plasticityIndex(pair.contact_modulus, pair.hardness,
///         composite_rms_height, radius);
///     const double stored_share = regimeFactor(phi);

#include <cstdint>

namespace mems_stiction {

/// Plasticity indices below it are elastic [-].
inline constexpr double kElasticLimit = 0.6;
/// Plasticity indices above it are fully plastic [-].
inline constexpr double kPlasticLimit = 1.1;

/// The values are those of the contact map.
enum class Regime : std::uint8_t { kApart = 0, kElastic = 1, kElastoPlastic = 2, kPlastic = 3 };

/// "APART", "ELASTIC", "ELASTO_PLASTIC", "PLASTIC"
const char* word(Regime regime);

/// Whether hardness plays a part. kElastic keeps every contact elastic.
enum class Deformation { kThreeRegimes, kElastic };

/// That of one asperity.
Regime regimeOf(double plasticity_index);

/// phi of (9) [-].
/// @param contact_modulus E [Pa], > 0
/// @param hardness Ha of the softer body [Pa], > 0
/// @param composite_rms_height sigma of the pair [m], >= 0
/// @param radius composite radius R of the asperity [m], > 0
double plasticityIndex(double contact_modulus, double hardness, double composite_rms_height,
                       double radius);

/// chi of (10.2), the elastic share [-]: 1 elastic, 0 fully plastic.
/// @param plasticity_index phi of (9) [-]
double regimeFactor(double plasticity_index);

}  // namespace mems_stiction
