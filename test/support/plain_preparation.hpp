#pragma once

/// Cleaning written down plainly, one pixel after the other and by sorting, in the memory of each
/// step: what the fast steps are compared with.

#include "mems_stiction/height_map/height_map.hpp"
#include "preprocess/spike_removal.hpp"
#include "preprocess/stage_offset.hpp"

namespace mems_stiction {
namespace plain {

/// Each returns rows x cols CV_64FC1 [m], invalid pixels NaN.
cv::Mat1d withoutStageOffset(const cv::Mat1d& heights);
cv::Mat1d withoutLineMedians(const cv::Mat1d& heights);
/// Window of 2 half + 1 pixels, threshold in robust standard deviations; pixels on a square grid.
cv::Mat1d withoutSpikes(const cv::Mat1d& heights, int half, double threshold);
/// The least-squares plane through the valid pixels comes off.
cv::Mat1d withoutPlane(const cv::Mat1d& heights);

}  // namespace plain
}  // namespace mems_stiction
