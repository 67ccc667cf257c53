#pragma once

/// @file
/// What does it cost to press the gap between two surfaces flat, all of it?
///
///     U/A = (E/4) sum |q| |h_q|^2 = (E/4) integral from 0 to infinity of S(r)/(2 r^2) dr
///     S(r) = mean of (h(x + r) - h(x))^2
///
/// the elastic energy of two bodies whose composite surface h takes the other's shape (Persson,
/// Tosatti, J. Chem. Phys. 115 (2001) 5597, eq. 3; the second form is its Fourier transform for a
/// surface without direction, and the mean over rows and columns stands for others). S is measured
/// at distances that grow by a quarter, along some of the rows and columns; beyond a quarter of the
/// frame it is taken as constant. Surfaces that give less than Gamma can lie against each other
/// everywhere.

#include <vector>

#include <opencv2/core.hpp>

#include "approach/gap_field.hpp"

namespace mems_stiction {

/// Mean squared differences of lines at some distances.
class StructureFunction {
 public:
  /// Forgets all lines; the next ones have this length [cells].
  void start(int length);
  /// - @p line of the length that start() was given [m]; what is not finite is left out
  void add(const double* line);
  /// Integral of S(r)/(2 r^2) dr [m]; S grows as r^2 up to the first distance.
  double integral(double pitch) const;

 private:
  struct Lag {
    int cells;
    double sum;
    double count;
  };
  int length_ = 0;
  std::vector<Lag> lags_;
};

/// The same along both directions of a frame.
struct StructureFunctions {
  StructureFunction along_rows;
  StructureFunction along_columns;

  /// Forgets all lines; the next ones are of a frame of this size [cells].
  void start(int rows, int cols);
  /// U/A [J/m^2], of the mean over both; 0 of a single cell.
  /// - @p contact_modulus E [Pa], > 0
  double energy(double contact_modulus, double pitch_x, double pitch_y) const;

 private:
  int directions_ = 0;
};

/// Keeps its memory between frames.
class FlatteningEnergy {
 public:
  /// U/A [J/m^2].
  /// - @p contact_modulus E [Pa], > 0
  double of(const GapField& field, double contact_modulus);
  /// The same of the gap with these heights added to it [m], cell by cell.
  double of(const GapField& field, const cv::Mat1d& raised, double contact_modulus);

 private:
  /// - @p read gives the gap of a cell by its index [m]
  template <typename ReadCell>
  double measure(const GapField& field, double contact_modulus, const ReadCell& read);

  StructureFunctions structure_;
  std::vector<double> row_;
  std::vector<double> columns_;  ///< some columns of the frame, one behind the other
};

}  // namespace mems_stiction
