#pragma once

/// @file
/// Heights for missing pixels.
///
/// Missing pixels become the thin plate through the valid ones around them: the sum of z_xx^2 + 2
/// z_xy^2 + z_yy^2 over all differences that touch a missing pixel is least (the biharmonic
/// equation). A plane comes back exactly, and a hole in the top of an asperity is filled with a
/// dome, where a harmonic fill would cut it off. At the frame's border the plate ends free. A
/// membrane term of 1e-9 of the plate's decides where the plate alone does not. Holes are
/// 4-connected sets of missing pixels; those larger than max_hole stay invalid: nobody knows what
/// is there. When more than max_fraction of the frame is missing, the scan is refused.

#include "mems_stiction/preprocess/pipeline_options.hpp"
#include "preprocess/working_surface.hpp"

namespace mems_stiction {

/// The pixels of larger holes stay NaN.
/// - @p outside not 0 at pixels that do not belong to the frame: they are neither filled nor
/// counted; empty = none
/// @throw SurfaceError naming the fraction and the limit if too much is missing, or if no pixel is
/// valid.
HeightChange fillHoles(WorkingSurface& surface, const FillOptions& options,
                       const cv::Mat& outside = {});

/// Fills the marked pixels, whatever their number.
/// - @p heights rows x cols CV_64FC1 [m], NaN where missing
/// - @p wanted rows x cols CV_8UC1, not 0 at missing pixels that get a height; the other missing
/// ones stay NaN and
///        are to the plate as the outside of the frame
void fillPixels(cv::Mat& heights, const cv::Mat& wanted, double pitch_x, double pitch_y);

}  // namespace mems_stiction
