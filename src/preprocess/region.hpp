#pragma once

/// @file
/// Which part of a scan counts: a rectangle, a polygon, a mask, or what lies in all that are
/// stated. The frame stays as large as it is. Pixels outside count as not measured, and take part
/// in no step and in no figure.
///
/// Places are in metres from the scan's upper left corner, x along columns and y along rows; a
/// pixel lies inside when its middle does.

#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/preprocess/pipeline_options.hpp"
#include "preprocess/working_surface.hpp"

namespace mems_stiction {

/// A region on whatever grid comes.
class Region {
 public:
  Region() = default;
  /// Reads the files. @throw OptionsError naming the key of a file that cannot be used.
  explicit Region(const RegionOptions& options);

  /// Not 0 where a pixel lies outside, rows x cols CV_8UC1; kept until another grid comes.
  /// @throw SurfaceError if the mask has another size, or nothing lies inside.
  const cv::Mat& outside(const cv::Size& size, double pitch_x, double pitch_y);

 private:
  RegionOptions options_;
  std::vector<cv::Point2d> corners_;  ///< [m]
  cv::Mat mask_;                      ///< not 0 inside
  cv::Mat outside_;
  double pitch_x_ = 0.0, pitch_y_ = 0.0;  ///< of outside_ [m]
};

/// The pixels outside become invalid.
HeightChange leaveOut(WorkingSurface& surface, const cv::Mat& outside);

}  // namespace mems_stiction
