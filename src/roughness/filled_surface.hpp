#pragma once

/// @file
/// A surface without holes, for what needs every pixel: spectra, and what is made by them.
///
/// Missing pixels near a measured one get the height of a thin plate through their surroundings
/// (fill_holes.hpp). Those further inside a hole get that of the same surface with half as many
/// pixels along each side, filled in the same way: the wider a hole, the longer the shortest waves
/// in it. Lines at the border without a measured pixel are cut off.
///
/// A filled pixel knows the waves that reach it from a measured one, and no shorter ones. So the
/// power of a wave is divided by the squared weights of the pixels that know it (KnownShare).

#include <string>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// Copies share their pixels.
struct FilledSurface {
  HeightMap surface;  ///< CV_64FC1, every pixel finite
  /// CV_32FC1: from each pixel to the nearest measured one [pixels], 0 at those; empty where none
  /// is missing.
  cv::Mat distances;
};

/// A surface of which nothing is missing shares its pixels, if they are double.
/// @throw SurfaceError if no pixel is valid
FilledSurface filledSurface(const HeightMap& surface);

/// What a spectrum does with the missing pixels of a surface, in words; empty where none is
/// missing.
std::string filledSentence(const HeightMap& surface);

/// Which share of the squared weights of a frame knows a wave?
class KnownShare {
 public:
  /// - @p distances of FilledSurface
  /// - @p weights_x, weights_y the weight of a pixel is the product of both
  KnownShare(const cv::Mat& distances, const std::vector<double>& weights_x,
             const std::vector<double>& weights_y);

  /// Whether no pixel is missing.
  bool isWhole() const { return shares_.empty(); }

  /// 1 where no pixel is missing.
  /// - @p wave_number along rows and columns [rad/pixel]
  double of(double wave_number) const;

 private:
  std::vector<double> shares_;  ///< of pixels up to a distance, by its steps
};

}  // namespace mems_stiction
