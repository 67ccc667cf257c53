#pragma once

/// @file
/// Height and hybrid parameters of ISO 25178-2 over the valid pixels of one surface, heights about
/// their mean (levelling is the caller's).
///
///     const ArealParameters figures = arealParameters(scan);
///     print(figures.sq, figures.sdq);

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// Height and hybrid parameters; NaN without a valid pixel.
struct ArealParameters {
  double sa = 0.0;   ///< arithmetical mean height [m]
  double sq = 0.0;   ///< root mean square height [m]
  double ssk = 0.0;  ///< skewness [-]
  double sku = 0.0;  ///< kurtosis [-], 3 for a Gaussian surface
  double sp = 0.0;   ///< maximum peak height [m]
  double sv = 0.0;   ///< maximum pit height [m]
  double sz = 0.0;   ///< maximum height, sp + sv [m]
  double sdq = 0.0;  ///< root mean square gradient by central differences over pixels with four
                     ///< valid neighbours [-]
  double sdr = 0.0;  ///< developed interfacial area ratio by the same gradients [-]
};

/// Skewness and kurtosis of a constant surface are 0; gradients are 0 where no pixel has four valid
/// neighbours.
/// @throw SurfaceError if no pixel is valid.
ArealParameters arealParameters(const HeightMap& surface);

}  // namespace mems_stiction
