#pragma once

/// @file
/// Which pressure does it take to press a wave into the surface of a body of finite thickness?
///
///     p = K u,   K(q) = (E'/2) q / X(qt),   E' = E/(1 - nu^2)        u, p ~ cos(q x)
///     X = [1 + 4 b s e - a b e^2] / [(1 - a e)(1 - b e) - 4 b s^2 e],   s = qt,  e = exp(-2 s)
///     a = (r g0 - g)/(1 + r g0),  b = (r - 1)/(r + g),  g = 3 - 4 nu,
///             r = shear modulus over that of the substrate
///
/// X is the compliance over that of a half-space of the same material, for a layer that is bonded,
/// without friction on its upper side, to a half-space (g0). A rigid substrate is r = 0; a free
/// lower side is r -> infinity, a = b = 1:
///
///     thick, s >> 1             X = 1      K = (E'/2) q
///     free, s << 1              X = 6/s^3  K = D q^4,  D = E' t^3/12         a plate that bends
///     rigid substrate, s << 1              K = M/t,    M = E (1 - nu)/((1 + nu)(1 - 2 nu))
///                     nu = 1/2             K = E/(q^2 t^3)                   squeezed aside
///     substrate, s -> 0                    K = (E0'/2) q                     that of the substrate
///
/// The compliances 1/K of two bodies that face each other add. Assumptions: slopes are small,
/// layers homogeneous and isotropic. Sources: Burmister, J. Appl. Phys. 16 (1945) 89 for the layer;
/// Li and Chou, Int. J. Solids Struct. 34 (1997) 4463, and Perriot and Barthel, J. Mater. Res. 19
/// (2004) 600, for this form of it; Filon, Phil. Trans. R. Soc. A 201 (1903) 63 and Timoshenko and
/// Goodier, Theory of Elasticity (1970), section 24, for the free plate; Carbone and Mangialardi,
/// J. Mech. Phys. Solids 56 (2008) 684 for the rigid substrate.
///
///     const WaveStiffness stiffness(options.lower, options.upper);
///     const double pressure = stiffness.at(q) * amplitude;

#include "mems_stiction/mechanics/material.hpp"

namespace mems_stiction {

/// How much more one body yields to a wave than if it were thick.
class LayerCompliance {
 public:
  explicit LayerCompliance(const Material& material);

  /// X [-], > 0; exactly 1 where waves do not reach the other side.
  /// @param wave_number q [rad/m], >= 0; a free body and one on a rigid substrate have no X for q =
  /// 0: infinity and 0
  double ratio(double wave_number) const;
  /// Whether X is 1 for every wave.
  bool isThick() const { return thickness_ == 0.0; }
  double thickness() const { return thickness_; }  ///< [m]; 0: thick
  /// (1 - nu^2)/E: 1/K of the thick body is this times 2/q [1/Pa].
  double planeCompliance() const { return plane_compliance_; }

 private:
  double plane_compliance_;
  double thickness_;
  // a, b and what would cancel if it were made from them
  double a_ = 0.0;
  double b_ = 0.0;
  double one_less_a_ = 1.0;
  double one_less_b_ = 1.0;
  double one_less_ab_ = 1.0;
  double b_and_ab_ = 0.0;  ///< b + a b
};

/// The stiffness of both bodies together.
class WaveStiffness {
 public:
  WaveStiffness(const Material& lower, const Material& upper) : lower_(lower), upper_(upper) {}

  /// The contact modulus of two thick bodies that resist this wave as these do [Pa]: ContactPair's,
  /// to the bit, where both are thick against the wave.
  double modulus(double wave_number) const;
  /// K [Pa/m].
  /// @param wave_number q [rad/m], > 0
  double at(double wave_number) const { return 0.5 * modulus(wave_number) * wave_number; }

  bool isThick() const { return lower_.isThick() && upper_.isThick(); }
  const LayerCompliance& lower() const { return lower_; }
  const LayerCompliance& upper() const { return upper_; }

 private:
  LayerCompliance lower_;
  LayerCompliance upper_;
};

}  // namespace mems_stiction
