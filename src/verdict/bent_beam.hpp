#pragma once

/// @file
/// How does a beam bend under the field of an electrode?
///
/// By Ritz's method: the deflection is a sum of polynomials, w(x) = sum a_i psi_i(x/s), that meet
/// the conditions at both ends. Where the beam is held down at its end, psi_0 has the deflection 1
/// there and a_0 is the gap; all others have 0. The a_i make the energy stationary:
///
///     (1/2) a.B a + s w t (sigma e + E e^2/2) - (1/2) eps0 w V^2 integral dx/d,   e = a.S a/(2 s)
///     B_ij = (E w t^3/12) integral psi_i'' psi_j'' dx,   S_ij = integral psi_i' psi_j' dx
///     d(x) = rest gap - w(x),   over the electrode
///
/// Residual stress sigma and stretching e count where both ends stay where they are.
///
/// Twelve polynomials are within 1 % of many, as pull-in goes
/// (test/core/verdict/beam_electrode_test.cpp). Assumptions: slender, small slopes, rigid clamps,
/// no fringes.

#include <Eigen/Dense>

#include "mems_stiction/verdict/beam_adhesion.hpp"

namespace mems_stiction {

/// What is at the end that is not the left clamp.
enum class BeamEnd {
  kFree,     ///< nothing
  kClamped,  ///< a clamp at the same height
  kResting,  ///< the substrate, touched by a tip that may turn
  kGuided,   ///< the substrate, on which the beam lies flat
};

/// From its clamp on, above a part of an electrode.
class BentBeam {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  /// The field's share of the energy's derivatives, over (1/2) eps0 w V^2.
  struct Field {
    Vector pull;          ///< by each a_i
    Matrix slope;         ///< of the pull
    double growth = 0.0;  ///< integral of x w'/(s d^2) dx [-]: minus that by s
  };

  /// - @p length s [m], > 0
  /// - @p from, to where the electrode lies, from the clamp [m]; what is beyond the beam is left
  /// out
  /// - @p rest_gap between beam and electrode at rest [m]
  /// - @p is_stretched both ends stay where they are
  BentBeam(const Beam& beam, double length, BeamEnd end, double from, double to, double rest_gap,
           bool is_stretched);

  int size() const { return static_cast<int>(bending_.rows()); }
  bool hasElectrode() const { return edges_.rows() > 1; }
  /// Derivative of the elastic energy by each a_i, and that of this.
  Vector resistance(const Vector& bent) const;
  Matrix stiffness(const Vector& bent) const;
  /// What the elastic energy loses when s grows while the shape over x/s stays [N].
  double release(const Vector& bent) const;
  /// False where the beam reaches the electrode.
  bool fieldOf(const Vector& bent, Field& field) const;
  /// Deflection at places of equal distance from the clamp to the end [m].
  Vector deflections(const Vector& bent) const;
  /// Shapes at one of these places.
  Vector shapesAt(int place) const;

 private:
  double tension(const Vector& bent) const;

  double length_;
  double rest_gap_;
  double section_;  ///< w t of a stretched beam, else 0 [m^2]
  double stress_;
  double modulus_;
  Matrix bending_;  ///< B
  Matrix slopes_;   ///< S
  BeamEnd end_;
  double cell_ = 0.0;  ///< length of the electrode's cells [m]
  Matrix edges_;       ///< shapes at the edges of the electrode's cells
  Matrix middles_;     ///< in their middles
  Matrix spread_;      ///< xi psi_i'(xi) there
};

}  // namespace mems_stiction
