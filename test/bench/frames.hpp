#pragma once

/// The frames that the benchmarks run on: rough surfaces from smooth to jagged, and the worst
/// cases.

#include <string>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {
namespace bench {

enum class Frame {
  kGaussian,    ///< correlation length of 8 pixels: tens of patches per thousand cells in contact
  kSmooth,      ///< correlation length of 32 pixels
  kRough,       ///< correlation length of 3 pixels
  kSpheres,     ///< 16 x 16 spheres of two radii
  kWhiteNoise,  ///< a patch per few pixels
  kPlane,       ///< everything touches at once
};

std::string frameName(Frame frame);

/// size x size, CV_32FC1 as from a driver, 10 nm pitch, 5 nm rms height (the plane: none).
const HeightMap& frameOf(Frame frame, int size);

}  // namespace bench
}  // namespace mems_stiction
