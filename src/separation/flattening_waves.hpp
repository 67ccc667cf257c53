#pragma once

/// @file
/// The flattening energy (flattening.hpp) wave by wave:
///
///     U/A = (E/4) sum |q| |h_q|^2
///
/// Each wave has its direction here. Lines along rows and columns see 0.79 of grooves along one of
/// them and 1.11 of diagonal ones, and no waves that are long against the frame. Heights are means
/// over blocks, 512 along a side at most; what is short against a block has no direction and is
/// told by lines. Cells without a height lie at the mean. The frame repeats itself where its
/// opposite edges differ by no more than its rms height, and is mirrored where they differ by more.

#include <vector>

#include <opencv2/core.hpp>

#include "approach/gap_field.hpp"
#include "separation/flattening.hpp"

namespace mems_stiction {

/// Keeps its memory between frames.
class FlatteningWaves {
 public:
  /// U/A [J/m^2].
  /// - @p contact_modulus E [Pa], > 0
  double of(const GapField& field, double contact_modulus);

 private:
  void takeBlocks(const GapField& field);
  bool repeatsItself() const;
  /// The spectrum of the frame and, where it is mirrored, of its images.
  void takeSpectrum();
  /// Splits off the waves that are long against a block.
  /// @return what flattening them takes [J/m^2]; their heights are long_heights_
  double takeLongWaves(cv::Size cells, double contact_modulus);

  cv::Size blocks_;
  double block_width_ = 0.0;   ///< along x [m]
  double block_height_ = 0.0;  ///< along y [m]
  cv::Mat1d heights_;
  cv::Mat1i counts_;
  std::vector<double> line_;
  cv::Mat1d frame_;  ///< with mirror images
  cv::Mat2d spectrum_;
  cv::Mat1d long_frame_;
  cv::Mat1d long_heights_;  ///< at each cell [m]
  FlatteningEnergy of_lines_;
};

}  // namespace mems_stiction
