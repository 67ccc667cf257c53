#pragma once

/// @file
/// Where do two rough surfaces flow that a load presses together, and which heights does that
/// leave?
///
///     E(p) = sum of dA [ p (C p)/2 + p g + integral of s dp ]  is least,  0 <= p <= Ha,
///             sum of p dA = P  (S15)
///     w = D - g - C p - s   where p = Ha, else 0                                             (S16)
///
/// Each cell has a pressure of its own: what its gap g, the cells beside it and the bodies'
/// compliance C (periodic_compliance.hpp) give it. s(p) is how far the law of adhesion gives way
/// under it. P is all that contacts carry, D the displacement that E's condition P gives. Cells
/// that bear Ha flow until the others carry the rest, and keep what they have lost, w. Where
/// nothing flows this is Polonsky and Keer's problem (Wear 231 (1999) 206); with a largest pressure
/// it is that of Almqvist, Sahlin, Larsson, Glavatskih (Tribol. Int. 40 (2007) 574). (Both
/// recalled.)
///
/// Assumptions: those of a largest pressure, neither hardening nor pile-up; attraction presses
/// where surfaces touch, and nowhere bends them apart from that. Where P is more than all cells
/// carry at Ha, all flow until the surfaces are flat.
///
/// Found by projected gradients whose steps follow Barzilai and Borwein (IMA J. Numer. Anal. 8
/// (1988) 141, recalled), with C on blocks of cells, then by cells: pressures that hardness bounds
/// leave little to find, and a few steps suffice.
///
///     FlowingPlaces places;
///     if (places.press(field, law, {contact_modulus, hardness, load, approach}))
///         use(places.changed());

#include <vector>

#include "approach/gap_field.hpp"
#include "separation/contact_traction.hpp"
#include "separation/periodic_compliance.hpp"

namespace mems_stiction {

/// Keeps its memory between frames.
class FlowingPlaces {
 public:
  /// What presses, and what bears it.
  struct Press {
    double contact_modulus;  ///< E [Pa]
    double hardness;         ///< Ha of the softer body [Pa]
    double load;             ///< P [N]
    double approach;         ///< cells with a smaller gap may touch [m]
  };

  /// - @p field the gap of the surfaces as they were
  /// @return whether anything flows
  bool press(const GapField& field, const ContactTraction& law, const Press& press);
  /// Of the last press(): whether it is more than all cells of the frame carry at Ha.
  bool isOverloaded() const { return is_overloaded_; }

  /// Calls take(column, w [m], p [Pa]) for the cells of a row that may touch: by which the gap has
  /// grown, and what presses; others have neither. Of the last press() under which something has
  /// flowed, as what follows.
  template <typename Taker>
  void visitRow(int row, const Taker& take) const;
  /// The same of all cells of a row.
  void readRow(int row, double* flowed, double* pressures) const;
  /// The gap of the surfaces as flow leaves them.
  const GapField& changed() const { return changed_; }
  /// By how much later than before these touch first [m].
  double lowering() const { return lowering_; }

 private:
  /// The cells that may touch, row by row.
  void takeCells(const GapField& field, double approach);
  /// s of pressures up to Ha.
  void takeLayer(const ContactTraction& law);
  /// What its gap becomes under the pressures, g + C p + s [m].
  void raise(PeriodicCompliance& bodies);
  /// D at which cells bear the load with t (D - x) between 0 and Ha, x = r - p/t.
  /// - @p stiffness t [Pa/m]
  double displacement(double stiffness);
  /// What the pressures change by if cells at rises r bear t (D - r) more, between 0 and Ha [Pa].
  /// - @p place D [m], of displacement() with this t
  /// - @p stiffness t [Pa/m]
  void moveTo(double place, double stiffness);
  /// Steps towards the least E, from the pressures that there are and their rises.
  /// @return the stiffness of the next step [Pa/m]
  double follow(PeriodicCompliance& bodies, int steps, double stiffness);
  bool takeFlowed(const GapField& field, double displacement);
  /// All cells at Ha, which have lost what they stood out by.
  bool flatten(const GapField& field);

  double hardness_ = 0.0;
  double total_ = 0.0;            ///< P/dA [Pa]
  double contact_modulus_ = 0.0;  ///< E [Pa]
  std::vector<double> layer_;     ///< s of equal steps of the pressure from 0 to Ha [m]
  PressedCells cells_;
  std::vector<double> gaps_;
  std::vector<double> pressures_;
  std::vector<double> rises_;  ///< r, what its gap has become [m]
  double displacement_ = 0.0;  ///< the last D [m]
  std::vector<double> open_;   ///< p - t r, which t D is added to [Pa]
  std::vector<double> moves_;
  std::vector<double> layers_;       ///< s of the pressures [m]
  std::vector<double> next_layers_;  ///< after the moves
  std::vector<double> yields_;
  std::vector<double> line_;
  PeriodicCompliance by_blocks_;
  PeriodicCompliance by_cells_;
  PressedCells flowed_cells_;  ///< those of the last press under which something has flowed
  std::vector<double> flowed_pressures_;
  std::vector<double> flowed_;  ///< w [m]
  GapField changed_;
  double lowering_ = 0.0;
  bool is_overloaded_ = false;
};

template <typename Taker>
void FlowingPlaces::visitRow(int row, const Taker& take) const {
  const auto place = static_cast<std::size_t>(row);
  for (int i = flowed_cells_.row_begin[place]; i < flowed_cells_.row_begin[place + 1]; ++i) {
    const auto cell = static_cast<std::size_t>(i);
    take(flowed_cells_.columns[cell], flowed_[cell], flowed_pressures_[cell]);
  }
}

}  // namespace mems_stiction
