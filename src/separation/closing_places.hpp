#pragma once

/// @file
/// Do places of a frame close by themselves, though the frame as a whole does not, and what would
/// they hold?
///
/// A place is a block of the frame, of half of its sides down to a sixteenth. It closes where
/// flattening its own relief, and drawing its mean plane up to the other body, cost less than
/// adhesion gives:
///
///     U/A + E d^2/(pi a) < Gamma,   pi a^2 = A                                               (S9a)
///
/// U/A is (S9) of the block. d is the distance of its mean plane from contact, and 2 E a d the
/// force of a round flat punch that is drawn by d (Sneddon), whose work is the second term. So it
/// pulls with
///
///     f(D) = min(2 E a d, s A),   s the strength of the law                                  (S9b)
///
/// and all places of one size together, less what pushes the surfaces apart at this displacement,
/// hold the part. What is in contact (d = 0) pulls nothing: the curve has it. Derivation and
/// figures: doc/separation_curve.md.

#include <cstddef>
#include <vector>

#include "approach/gap_field.hpp"
#include "separation/contact_traction.hpp"
#include "separation/flattening.hpp"
#include "separation/separation_curve.hpp"

namespace mems_stiction {

/// Keeps its memory between frames.
class ClosingPlaces {
 public:
  /// What the places of the size that holds most would hold [N]: the largest, over the way from the
  /// rest without a load to the rest; 0 where no more than `least` can come of it.
  /// - @p contact_modulus E [Pa], > 0
  /// - @p curve of the unloading branch
  /// - @p least what the force is compared with [N]; below, nothing is measured that takes longer
  double force(const GapField& field, const ContactTraction& law, double contact_modulus,
               const SeparationCurve& curve, double least);
  /// U/A of the quarter of the frame, half of each side, that has most of it [J/m^2].
  double largestEnergy(const GapField& field, double contact_modulus);

 private:
  /// Cells [from, to).
  struct Range {
    int from;
    int to;
    int length() const { return to - from; }
  };
  struct Place {
    Range rows;
    Range cols;
    double area = 0.0;      ///< of its valid cells [m^2]
    double mean_gap = 0.0;  ///< [m]
    double energy = 0.0;    ///< U/A [J/m^2]
  };

  /// Over the lines of a block.
  struct GapSum {
    double cells = 0.0;
    double known = 0.0;  ///< of them
    double gaps = 0.0;   ///< of those [m]
  };

  void start(const GapField& field, double contact_modulus);
  void readRows();
  void sumBlocks();
  std::size_t blockAt(int row, int col) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(along_) +
           static_cast<std::size_t>(col);
  }
  void readColumns();
  /// The places of one size; none if their sides would be too short.
  void takePlaces(int divisions);
  /// Without those that do not close at the end of the way even if flattening costs nothing.
  void onlyNear(double nearest);
  /// What drawing a place up from its distance [m] takes, per area [J/m^2].
  double drawingEnergy(const Place& place, double distance) const;
  void measureEnergy(Place& place);
  /// (S9b) less what pushes, the largest on the way.
  double largestForce() const;
  double forceAt(double approach) const;

  const GapField* field_ = nullptr;
  const ContactTraction* law_ = nullptr;
  double contact_modulus_ = 0.0;
  std::vector<const SeparationState*> way_;  ///< from the rest without a load on
  std::vector<Place> places_;
  std::vector<int> row_of_line_;
  std::vector<int> col_of_line_;
  std::vector<double> rows_;     ///< lines, one behind the other [m]
  std::vector<double> columns_;  ///< the same; empty until they are asked for
  int down_ = 1;                 ///< the smallest blocks, by rows and columns
  int along_ = 1;
  std::vector<GapSum> blocks_;  ///< of these, row by row
  StructureFunctions structure_;
};

}  // namespace mems_stiction
