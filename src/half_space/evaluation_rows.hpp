#pragma once

/// @file
/// One row's share of the energy of a contact, of its residual and of the derivative of its
/// tractions.

#include <limits>

#include "half_space/traction_law.hpp"

namespace mems_stiction {
namespace evaluation_rows {

/// What rows add to an evaluation; per cell, without the cell's area.
struct Sums {
  double traction = 0.0;
  double elastic = 0.0;  ///< u K u
  double energy = 0.0;   ///< phi
  double positive_slope = 0.0;
  double residual = 0.0;
  double residual_squared = 0.0;
  double highest = -std::numeric_limits<double>::infinity();    ///< residual
  double lowest = std::numeric_limits<double>::infinity();      ///< residual
  double gap = 0.0;                                             ///< where it is known [m]
  double contacts = 0.0;                                        ///< cells that repel each other
  double lowest_gap = std::numeric_limits<double>::infinity();  ///< [m]

  Sums& operator+=(const Sums& other);
};

/// The arrays of a row: u, K u, a step s and K s; and what is written, t - K (u + length s) - fixed
/// and t'.
struct RowArrays {
  const double* displacement;
  const double* elastic_traction;
  const float* step;
  const float* step_traction;
  float* residual;
  float* slope;        ///< null where nobody asks for it
  const float* fixed;  ///< a further elastic traction that does not change with u; null for none
  double mean;         ///< traction that K does not resist, as far as it is known [Pa]
};

/// Cells of the frame, with relief and a traction.
/// - @p level height of the upper body over first touch [m]
Sums evaluate(const TractionLaw& law, int count, double level, const double* relief, double length,
              const RowArrays& arrays);
/// Cells beyond the frame: nothing acts on them.
Sums evaluateFree(int count, double length, const RowArrays& arrays);

}  // namespace evaluation_rows
}  // namespace mems_stiction
