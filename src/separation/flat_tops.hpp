#pragma once

/// @file
/// Do contacts with flat tops of nearly one height hold together?
///
/// A flat contact of radius a lets go only when it has been drawn out by
///
///     e = min(pi a s/(2 E), sqrt(2 pi a Gamma/E)),   s the strength of the law
///
/// where 2 E a e (Sneddon) reaches s pi a^2, or Kendall's sqrt(8 pi E Gamma a^3). Tops with the
/// gaps g_i at first touch therefore hold, at the displacement D,
///
///     together     sum of 2 E a_i (g_i - D)   over those with g_i - D <= e_i                 (S9c)
///     one by one   the same where g_i < D, and 2 E a_i e_i t(g_i - D)/s of the others        (S9d)
///
/// A top that is still pressed (g_i < D) pushes. The curve knows (S9d), surfaces that hold no
/// farther than the law reaches. Both are equal for tops of one height. Figures:
/// doc/separation_curve.md.

#include <vector>

#include "separation/frame_sums.hpp"

namespace mems_stiction {

/// Of the contacts at one approach. Keeps its memory between frames.
class FlatTops {
 public:
  /// - @p frame outlives what is asked of it
  /// - @p approach from which the surfaces part [m]
  void start(FrameSums& frame, double approach);

  /// The largest sum (S9c) [N].
  double pullTogether() const;
  /// The largest sum (S9d) [N].
  double pullOneByOne() const;

 private:
  /// The cells of a contact within z0 of its highest one.
  struct Top {
    double gap;     ///< g, of the highest [m]
    double radius;  ///< a [m]
    double reach;   ///< e [m]

    /// D at which it lets go [m].
    double end() const { return gap - reach; }
  };

  const FrameSums* frame_ = nullptr;
  std::vector<int> flat_cells_;  ///< of each contact
  std::vector<Top> tops_;        ///< the last to let go first
};

}  // namespace mems_stiction
