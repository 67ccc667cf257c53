#pragma once

/// @file
/// Where do two rough surfaces flow that a load presses together, and which heights does that
/// leave?
///
///     E(p) = sum of dA [ p (C p)/2 + p (g + s p/Ha) ]  is least,  0 <= p <= Ha,
///             sum of p dA = P  (S15)
///     w = D - g - C p - s   where p = Ha, else 0                                             (S16)
///
/// Each cell has a pressure of its own: what its gap g, the cells beside it and the bodies'
/// compliance give it. C is that of two thick bodies, 2/(E q) of a wave of number q (Johnson,
/// Contact Mechanics, chapter 13); the frame repeats itself, as that of the half-space. s is how
/// far the law of adhesion gives way under Ha, taken in proportion below. P is all that contacts
/// carry, D the displacement that E's condition P gives. Cells that bear Ha flow until the others
/// carry the rest, and keep what they have lost, w. Where nothing flows this is Polonsky and Keer's
/// problem (Wear 231 (1999) 206); with a largest pressure it is that of Almqvist, Sahlin, Larsson,
/// Glavatskih (Tribol. Int. 40 (2007) 574). (Both recalled.)
///
/// Assumptions: those of a largest pressure, neither hardening nor pile-up; attraction presses
/// where surfaces touch, and nowhere bends them apart from that. Where P is more than all cells
/// carry at Ha, nothing is answered.
///
/// Found by projected gradients whose steps follow Barzilai and Borwein (IMA J. Numer. Anal. 8
/// (1988) 141, recalled), with C on blocks of cells: pressures that hardness bounds leave little to
/// find, and a few steps suffice. C in (S16) is by cells.
///
///     FlowingPlaces places;
///     if (places.press(field, law, {contact_modulus, hardness, load, approach}))
///         use(places.changed());

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "approach/gap_field.hpp"
#include "separation/contact_traction.hpp"

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

  /// By which the gap has grown, w [m]; of the last press() under which something has flowed, as
  /// what follows.
  const cv::Mat1d& flowed() const { return flowed_; }
  /// The gap of the surfaces as flow leaves them.
  const GapField& changed() const { return changed_; }
  /// By how much later than before these touch first [m].
  double lowering() const { return lowering_; }
  /// p of each cell [Pa].
  const cv::Mat1d& pressure() const { return pressure_map_; }

 private:
  /// Where a row or column of cells lies between the middles of the blocks on both sides.
  struct Between {
    int before;
    int behind;
    double share;  ///< of the one behind
  };

  /// The cells that may touch, row by row.
  void takeCells(const GapField& field, double approach);
  /// - @p cells_per_side of a block, about
  void takeBlocks(const GapField& field, double contact_modulus, int cells_per_side);
  static std::vector<Between> betweenBlocks(int cells, int blocks);
  /// C p + s p/Ha of pressures of the cells [m].
  void yield(const std::vector<double>& pressures, std::vector<double>& yields);
  /// Pressures of the cells on the blocks beside them.
  void spread(const std::vector<double>& pressures);
  /// D at which cells bear the load with t (D - x) between 0 and Ha, x = r - p/t.
  /// - @p stiffness t [Pa/m]
  double displacement(double stiffness) const;
  /// @return the last step's stiffness [Pa/m]
  double solve(double stiffness);
  bool takeFlowed(const GapField& field, double displacement);

  double hardness_ = 0.0;
  double total_ = 0.0;              ///< P/dA [Pa]
  double compliance_of_law_ = 0.0;  ///< s/Ha [m/Pa]
  double short_compliance_ = 0.0;   ///< of waves that blocks are too large for [m/Pa]
  std::vector<int> row_begin_;      ///< of each row's cells, and the end of the last one's
  std::vector<std::int32_t> columns_;
  std::vector<double> gaps_;
  std::vector<double> pressures_;
  std::vector<double> rises_;  ///< r, what its gap has become [m]
  std::vector<double> moves_;
  std::vector<double> yields_;
  std::vector<double> line_;
  std::vector<Between> rows_;
  std::vector<Between> cols_;
  bool is_by_cell_ = false;  ///< blocks are cells
  double cells_per_block_ = 1.0;
  cv::Mat1d compliance_;  ///< C of each number of a transform, as cv::dft packs them [m/Pa]
  cv::Mat1d blocks_;
  cv::Mat1d spectrum_;
  cv::Mat1d yield_of_blocks_;
  cv::Mat1d flowed_;
  cv::Mat1d pressure_map_;
  GapField changed_;
  double lowering_ = 0.0;
};

}  // namespace mems_stiction
