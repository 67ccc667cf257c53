#pragma once

/// @file
/// A patch of cells that overlap when the surfaces are brought together undeformed, and what it
/// takes to press it flat.
///
///     P = (3/5) E V/rc,   V = sum of (D - g) dA,   rc = sqrt(A/pi)
///
/// is Hertz by volume and area: for a paraboloid A = 2 pi R delta, V = A delta/2 and P = (4/3) E
/// sqrt(R) delta^(3/2). For a flat punch it is 0.94 of 2 E a delta. When patches meet, the larger
/// one would carry less than both by this formula, though nothing has let go: what they carried
/// stays, P = P0 + (3/5) E V/rc, and only what comes on top has the stiffness of the larger patch.
/// (The stiffness of a contact depends on where it touches, not on how it came about: Pohrt and
/// Popov, Phys. Rev. E 87 (2013) 022402 and references there.)
///
/// All attributes add up when patches meet.

#include <cstdint>

#include "numeric/packet_functions.hpp"

namespace mems_stiction {

/// V/(dA sqrt(cells)) [m] by number of cells and the sum of their gaps [m], of one patch or of
/// several: what a patch carries, without what it has merged_term, over 0.6 E sqrt(pi dA).
template <typename Real>
MEMS_STICTION_INLINE Real volumeTerm(const Real& cells, const Real& gap_sum, double approach) {
  return (cells * approach - gap_sum) / squareRoot(cells);
}

/// One patch.
struct OverlapPatch {
  std::int32_t cells = 0;
  std::int32_t summits = 0;     ///< patches that have met in it, 1 if none have
  std::int32_t first_cell = 0;  ///< of its smallest gap
  double first_gap = 0.0;       ///< [m]
  double gap_sum = 0.0;         ///< of its cells [m]
  double merged_term = 0.0;     ///< P0/(0.6 E sqrt(pi dA)) [m]

  /// Mean overlap at an approach, V/A [m].
  double depth(double approach) const { return approach - gap_sum / cells; }
  /// P/(0.6 E sqrt(pi dA)) at an approach [m].
  double loadTerm(double approach) const {
    return merged_term + volumeTerm<double>(cells, gap_sum, approach);
  }
  /// R = A^2/(4 pi V) [m]: of the paraboloid with this area and volume.
  double radius(double approach, double cell_area) const;

  /// Takes another patch in that meets this one at an approach [m].
  void merge(const OverlapPatch& other, double approach);
};

inline double OverlapPatch::radius(double approach, double cell_area) const {
  constexpr double kFourPi = 12.566370614359172;
  return cells * cell_area / (kFourPi * depth(approach));
}

inline void OverlapPatch::merge(const OverlapPatch& other, double approach) {
  const double carried = loadTerm(approach) + other.loadTerm(approach);
  if (other.first_gap < first_gap ||
      (other.first_gap == first_gap && other.first_cell < first_cell)) {
    first_gap = other.first_gap;
    first_cell = other.first_cell;
  }
  cells += other.cells;
  summits += other.summits;
  gap_sum += other.gap_sum;
  merged_term = carried - volumeTerm<double>(cells, gap_sum, approach);
}

}  // namespace mems_stiction
