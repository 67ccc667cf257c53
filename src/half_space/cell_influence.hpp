#pragma once

/// @file
/// How far does a surface with free edges give way at some distance from a cell under uniform
/// pressure?
///
///     half-spaces  integral of 1/(pi E r) over the cell
///                          (Love; Johnson, Contact Mechanics, (3.25))
///     films        and for each, (1/(pi E' t)) h(r/t) with
///                  h(y) = integral over s from 0 to infinity of (X(s) - 1) J0(s y)
///                          X: mechanics/wave_stiffness.hpp
///
/// X - 1 falls off as exp(-2 s), so h is as smooth as the film is thick; h y -> X(0) - 1 far away,
/// where a film on a rigid substrate takes back all that the half-space gives. A plate with a free
/// back has no such form: how far it gives way under a single load depends on where it is held.
///
///     const CellInfluence influence(contact_modulus, layers, pitch_x, pitch_y);
///     const double displacement = influence.at(row, col);

#include <vector>

#include "mechanics/wave_stiffness.hpp"

namespace mems_stiction {

/// Of one cell under an even pressure, by the distance from it.
class CellInfluence {
 public:
  /// A film is to be thicker than this share of a pixel.
  static constexpr double kThinnestFilm = 0.1;

  /// - @p contact_modulus E of the bodies if they were thick [Pa], > 0
  /// - @p layers the bodies, none of which is a free plate, nor a film too thin; null for
  /// half-spaces
  /// - @p pitch_x, @p pitch_y [m], > 0
  CellInfluence(double contact_modulus, const WaveStiffness* layers, double pitch_x,
                double pitch_y);

  /// Displacement of the middle of a cell that is (row, col) cells away from the one under 1 Pa
  /// [m/Pa].
  double at(int row, int col) const;

 private:
  /// h of one body, over asinh(y), and how much of it is added.
  struct Film {
    double factor;     ///< 1/(pi E' t) [1/(Pa m)]
    double thickness;  ///< [m]
    double far;        ///< X(0) - 1
    double next;       ///< of the next term, far/y + next/y^3
    std::vector<double> values;

    double at(double distance) const;
  };
  static void addFilm(const LayerCompliance& layer, std::vector<Film>& films);
  double ofFilm(const Film& film, double x, double y) const;

  double contact_modulus_;
  double pitch_x_;
  double pitch_y_;
  std::vector<Film> films_;
};

}  // namespace mems_stiction
