#pragma once

/// @file
/// How far does a surface resemble itself, and is that the same in every direction?
///
///     acf(tx, ty) = <z(x, y) z(x + tx, y + ty)> / <z^2>
///
/// Sal, the autocorrelation length, is the shortest lag at which the central lobe of acf falls to
/// s; Str, the texture aspect ratio, is Sal over the longest such lag: near 1 isotropic, near 0 a
/// lay (ISO 25178-2, 4.2; s = 0.2 there).
///
/// Heights are taken about their mean; levelling is the caller's. By FFT. `open` pads with nothing
/// around the frame and divides each lag by the number of pairs of valid pixels, so that neither
/// the border nor invalid pixels bias it; lags up to half of the frame are used. `periodic` wraps
/// around, for synthetic surfaces that do. Where acf stays above s in a direction up to half of the
/// frame (grooves, a residual tilt), the longest lag is cut off there: Str is then an upper bound
/// and `decayed` is false. If no direction decays, Sal is that limit: a lower bound.

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

enum class FrameBoundary { kOpen, kPeriodic };

/// @return acf [-], (2 half_rows + 1) x (2 half_cols + 1) CV_64FC1 with lag 0 in the middle; half
/// of each side of the
///         frame, rounded down. A lag that no pair of valid pixels has is NaN. All 0 for a constant
///         surface.
/// @throw SurfaceError if no pixel is valid.
cv::Mat autocorrelation(const HeightMap& surface, FrameBoundary boundary = FrameBoundary::kOpen);

/// How far heights are alike.
struct SpatialParameters {
  double sal = 0.0;      ///< autocorrelation length [m]; 0 for a constant surface
  double str = 0.0;      ///< texture aspect ratio [-], in (0, 1]; 0 for a constant surface
  double longest = 0.0;  ///< the longest lag of decay [m]
  bool decayed = false;  ///< acf fell to s in every direction
};

/// - @p s in (0, 1)
/// @throw SurfaceError if no pixel is valid; OptionsError if s is out of range.
SpatialParameters spatialParameters(const HeightMap& surface,
                                    FrameBoundary boundary = FrameBoundary::kOpen, double s = 0.2);

}  // namespace mems_stiction
