#pragma once

/// @file
/// What can the surface look like that a tip of known shape has drawn so?
///
/// An image is the surface dilated by the tip, i(x) = max over p of s(p) - depth(p - x); depth(r)
/// is how far the tip has receded at the distance r from its axis. Eroding the image by the same
/// tip,
///
///     r(p) = min over x of i(x) + depth(p - x)  >=  s(p),
///
/// gives the highest surface that leads to this image; it is s itself where the tip has touched s
/// alone (J. S. Villarrubia, J. Res. Natl. Inst. Stand. Technol. 102 (1997) 425, sections 4 and 6).
///
/// Tip: a sphere, going on tangentially in a cone of the given half-angle beyond R cos(half_angle)
/// from the axis; with the half-angle 0, in a cylinder. It points along -z of the instrument, so
/// correct before tilt is taken off.
///
/// Reached: for every position of the tip, the pixels that it all but touches (closer than the tip
/// recedes within one pixel) are looked up. If they lie together (within two pixels of their
/// middle) the tip touched there and nowhere else, and they are certain. Pixels that no position
/// makes certain were bridged by the tip: their height is an upper bound. Valleys with less than
/// 4/3 of the tip's radius count as bridged.
///
/// Assumptions: the tip's axis is vertical and its shape is known; noise below the tip's depth at
/// one pixel. Noise spikes upward come out as tips turned over, pits of one pixel drag their
/// surroundings down: remove spikes before. Invalid pixels constrain nothing and stay invalid.
/// Beyond the frame nothing is known, so it constrains nothing.

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/preprocess/pipeline_options.hpp"

namespace mems_stiction {

/// How far the tip has receded at a distance from its axis [m]; infinite beyond a cylinder.
double tipDepth(const TipOptions& tip, double distance);

/// The surface below the tip, and how much of it the tip could not reach.
struct TipCorrection {
  HeightMap surface;  ///< CV_64FC1 [m]; invalid pixels are NaN
  cv::Mat reached;  ///< rows x cols CV_8UC1: 255 where the tip touched, 0 elsewhere and at invalid
                    ///< pixels
  double unreached_fraction =
      0.0;  ///< share of valid pixels whose height is only an upper bound [-]
};

/// Erosion by the tip. Time grows with pixels of the surface x pixels of the tip that are less deep
/// than the surface's height range: about a second for 10^6 x 10^3.
/// @throw SurfaceError if no pixel is valid.
TipCorrection tipCorrected(const HeightMap& image, const TipOptions& tip);

/// Dilation: what an instrument with this tip makes of the surface.
HeightMap tipImaged(const HeightMap& surface, const TipOptions& tip);

}  // namespace mems_stiction
