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
///     f(q) = 1/(1 + (2 l q)^4),
///
/// its two numbers chosen on frames of the half-space (doc/separation_curve.md). Cells without a height lie at the mean.
/// The frame repeats itself where its opposite edges fit each other as neighbours do, and is mirrored where they do not.

#include <opencv2/core.hpp>

#include "mems_stiction/approach/gap_field.hpp"

namespace mems_stiction {

/// What a relief is made of. Keeps its memory between frames.
class ReliefWaves {
 public:
  /// - @p contact_modulus E [Pa], > 0
  /// - @p cohesive_length l [m], > 0
  void split(const GapField& field, double contact_modulus, double cohesive_length);

  /// Largest tension of the long waves when all is pressed flat [Pa], >= 0.
  double largestTension() const { return largest_tension_; }
  /// Height of the long waves at each cell [m].
  const cv::Mat1d& longHeights() const { return long_heights_; }

 private:
  /// Means over blocks of cells that are no longer than the cohesive length.
  void takeBlocks(const GapField& field, double cohesive_length);
  bool repeatsItself() const;

  cv::Size blocks_;
  double block_width_ = 0.0;   ///< along x [m]
  double block_height_ = 0.0;  ///< along y [m]
  cv::Mat1d heights_;
  cv::Mat1i counts_;
  std::vector<double> line_;
  cv::Mat2d spectrum_;
  cv::Mat2d tension_;
  double largest_tension_ = 0.0;
  cv::Mat1d long_heights_;
};

}  // namespace mems_stiction
