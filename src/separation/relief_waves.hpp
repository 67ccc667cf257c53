#pragma once

/// @file
/// The relief between two surfaces in long and short waves, as a bonded interface feels them.
///
/// Pressed flat, the bodies pull at the interface with the tension
///
///     p_q = -(E/2) |q| h_q,
///
/// largest where the relief is low (Westergaard 1939 for one wave; Johnson, Contact Mechanics, 13.2). Over waves much
/// longer than the cohesive length l = E z0^2/Gamma the place where it is largest tears first, and all else follows it;
/// what is shorter is torn as a whole. The long part of a wave is
///
///     f(q) = 1/(1 + (l q)^2)

#include <opencv2/core.hpp>

#include "separation/relief_spectrum.hpp"

namespace mems_stiction {

/// What a relief is made of. Keeps its memory between frames.
class ReliefWaves {
 public:
  /// - @p relief in blocks no longer than blockLength()
  /// - @p cells columns and rows of the frame
  /// - @p contact_modulus E [Pa], > 0
  /// - @p cohesive_length l [m], > 0
  void split(ReliefSpectrum& relief, cv::Size cells, double contact_modulus, double cohesive_length);

  /// energy() and longHeights() alone, with another length in place of l [m], > 0.
  void splitHeights(ReliefSpectrum& relief, cv::Size cells, double contact_modulus, double length);

  /// Blocks that resolve what is long against a cohesive length [m].
  static double blockLength(double cohesive_length) { return 0.5 * cohesive_length; }

  /// Largest tension of the long waves when all is pressed flat [Pa], >= 0.
  double largestTension() const { return largest_tension_; }
  /// Where it pulls, in columns and rows of the frame from its corner; cell (i, j) lies at (i + 1/2, j + 1/2).
  cv::Point2d weakestPlace() const { return weakest_place_; }
  /// What flattening the relief takes more than flattening what the long waves leave of it, per area [J/m^2].
  double energy() const { return energy_; }
  /// Height of the long waves at each cell [m].
  const cv::Mat1d& longHeights() const { return long_heights_; }

 private:
  template <typename LongPart>
  void takeLong(ReliefSpectrum& relief, cv::Size cells, double contact_modulus, const LongPart& long_part);

  double largest_tension_ = 0.0;
  double energy_ = 0.0;
  cv::Point2d weakest_place_;
  cv::Mat1d long_heights_;
};

}  // namespace mems_stiction
