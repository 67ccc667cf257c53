#pragma once

/// @file
/// How much do two bodies attract each other across a gap D, when native films of another material
/// cover them and light takes time from one to the other?
///
///     w(D) = A(D)/(12 pi D^2)
///     A(D) = [ f^2 + f b1 D^2/(D + T1)^2 + f b2 D^2/(D + T2)^2 + b1 b2 D^2/(D + T1 + T2)^2 ]
///            / (1 + D/lambda)
///     f = sqrt(H),   b_i = sqrt(H_i) - f
///
/// H is the Hamaker constant of the films, H_i that of what lies under the film of thickness T_i. A
/// narrow gap sees the films alone, a wide one what is under them. Assumptions: combining relations
/// (each pair of layers attracts with the root of its constants' product), flat and wide layers,
/// one length lambda for the loss by retardation. Holds within 3.5 % of Lifshitz' theory for
/// silicon under 2 nm of oxide, lambda = 20 nm, from 0.5 to 100 nm. Outside: w falls as D^-3
/// forever, while at room temperature it falls as D^-2 again beyond some micrometres. Sources:
/// Israelachvili, Intermolecular and Surface Forces (3rd ed., 2011), chapter 13, for coated bodies
/// and combining relations; Gregory, J. Colloid Interface Sci. 83 (1981) 138, for retardation (both
/// recalled).
///
///     const LayeredAttraction attraction(65e-21, {2e-9, 261e-21}, {2e-9, 261e-21}, 20e-9);
///     const double constant = attraction.hamakerConstant(21e-9);

#include <cstddef>

#include "numeric/vectorized.hpp"

namespace mems_stiction {

/// What lies under the surface of a body.
struct CoatedBody {
  double film_thickness = 0.0;    ///< T [m], >= 0; 0 = no film: all is as the film would be
  double hamaker_constant = 0.0;  ///< of what is under the film [J], >= 0; 0 = as the film
};

/// w and its derivatives by the gap. Its functions take one number or several (Packet).
class LayeredAttraction {
 public:
  /// Of one gap.
  template <typename Real>
  struct Point {
    Real energy;     ///< w, what separation to infinity costs [J/m^2]
    Real traction;   ///< -dw/dD, positive attracts [Pa]
    Real slope;      ///< -d^2w/dD^2 [Pa/m]
    Real curvature;  ///< -d^3w/dD^3 [Pa/m^2]
  };

  LayeredAttraction() = default;  ///< there is none
  /// - @p hamaker_constant H of the films, or of bodies without [J], >= 0
  /// - @p retardation_length lambda [m], >= 0; 0 = not retarded
  LayeredAttraction(double hamaker_constant, const CoatedBody& lower, const CoatedBody& upper,
                    double retardation_length);

  /// H [J]
  double filmConstant() const { return film_constant_; }
  /// Whether it is that of bodies of one material each, not retarded: H/(12 pi D^2).
  bool isPlain() const;
  /// How much faster than D^-3 its traction falls at most, as a ratio of both powers [-], >= 1: by
  /// retardation, and where films are stronger than what is under them.
  double steepness() const;
  /// A [J]; @param gap D [m], > 0
  double hamakerConstant(double gap) const;
  /// By a factor.
  LayeredAttraction times(double factor) const;
  /// Less that of bodies of one material each, not retarded.
  /// - @p traction that they have at a gap of 1 m [Pa], H/(6 pi)
  LayeredAttraction less(double traction) const;

  /// What is not asked for is not computed. @param gap D [m], > 0, finite
  template <typename Real>
  MEMS_STICTION_INLINE Point<Real> at(const Real& gap) const {
    // one division for all: each inverse is the product of the others over that of all
    const Real second = gap + shifts_[0];
    const Real third = gap + shifts_[1];
    const Real fourth = gap + shifts_[2];
    const Real late = 1.0 + gap * inverse_length_;
    const Real first_two = gap * second;
    const Real last_two = third * fourth;
    const Real inverse = 1.0 / (first_two * last_two * late);
    const Real inverse_of_gaps = inverse * late;
    const Real by_first_two = inverse_of_gaps * last_two;
    const Real by_last_two = inverse_of_gaps * first_two;
    const Real inverses[] = {by_first_two * second, by_first_two * gap, by_last_two * fourth,
                             by_last_two * third};
    const Real share = inverse * first_two * last_two;  // that is left by retardation
    const Real loss = share * inverse_length_;          // -d ln(share)/dD
    Real second_power = 0.0;
    Real third_power = 0.0;
    Real fourth_power = 0.0;
    Real fifth_power = 0.0;
    for (std::size_t i = 0; i < kPairs; ++i) {
      const Real square = weights_[i] * inverses[i] * inverses[i];
      const Real cube = square * inverses[i];
      const Real fourth_of_it = cube * inverses[i];
      second_power += square;
      third_power += cube;
      fourth_power += fourth_of_it;
      fifth_power += fourth_of_it * inverses[i];
    }
    const Real plain = plain_ * inverses[0] * inverses[0];
    const Real plain_cube = plain * inverses[0];
    Point<Real> point;
    point.energy = share * second_power - plain;
    point.traction = share * (2.0 * third_power + loss * second_power) - 2.0 * plain_cube;
    point.slope =
        6.0 * plain_cube * inverses[0] -
        share * (6.0 * fourth_power + loss * (4.0 * third_power + 2.0 * loss * second_power));
    point.curvature = share * (24.0 * fifth_power +
                               loss * (18.0 * fourth_power +
                                       loss * (12.0 * third_power + 6.0 * loss * second_power))) -
                      24.0 * plain_cube * inverses[0] * inverses[0];
    return point;
  }

 private:
  static constexpr std::size_t kPairs = 4;  ///< of layers, one of each body

  double film_constant_ = 0.0;
  double shifts_[kPairs - 1] = {};  ///< by which pairs are further apart than the gap [m]
  double weights_[kPairs] = {};     ///< of each pair, over 12 pi [J]
  double inverse_length_ = 0.0;     ///< 1/lambda [1/m]
  double plain_ = 0.0;              ///< what is taken off, over 12 pi [J]
};

}  // namespace mems_stiction
