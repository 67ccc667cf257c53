#pragma once

/// @file
/// A surface on a regular grid: heights, pitch and validity; and two of them that meet.
///
/// Axes: column index grows along +x, row index grows along +y (row 0 is the top of the image), z
/// points out of the lower body towards the upper one. Heights are metres; a pixel that is not
/// finite (NaN, +-Inf; REP 117) is invalid.
///
///     const HeightMap scan(heights, 10e-9, 10e-9);  // [m]; NaN: not measured
///     print(heightStatistics(scan).rms_height);
///     const SurfacePair pair(scan);  // on a level plane; with a second map, on that

#include <memory>
#include <utility>

#include <opencv2/core.hpp>

namespace mems_stiction {

/// Whatever must live as long as the pixels that lie inside it, such as a message.
using PixelOwner = std::shared_ptr<const void>;

/// Heights on a regular grid [m] with pitch [m]; pixels that are not finite were not measured.
/// Shares its pixels when copied, and shares them: they live as long as any map that shows them.
class HeightMap {
 public:
  HeightMap() = default;

  /// @param heights rows x cols, CV_32FC1 or CV_64FC1, metres, non-finite = invalid. The pixels are
  /// never written to.
  ///        They are shared if the matrix owns them itself; pixels that it only points to are
  ///        copied.
  /// @param pitch_x, pitch_y distance of neighbouring columns and rows [m], > 0.
  /// @throw SurfaceError if the type, size or pitch is not as above.
  HeightMap(const cv::Mat& heights, double pitch_x, double pitch_y);
  /// The same for pixels inside something else: shared, not copied.
  /// - @p owner what the pixels lie in; kept as long as they are shown. Null is the same as no
  /// owner.
  HeightMap(const cv::Mat& heights, double pitch_x, double pitch_y, PixelOwner owner);

  int rows() const { return heights_.rows; }
  int cols() const { return heights_.cols; }
  bool empty() const { return heights_.empty(); }
  double pitchX() const { return pitch_x_; }
  double pitchY() const { return pitch_y_; }
  /// dx dy [m^2]
  double cellArea() const { return pitch_x_ * pitch_y_; }
  const cv::Mat& heights() const { return heights_; }

  /// Height at one cell [m]; for single look-ups, not for loops over the frame.
  double height(int row, int col) const {
    return heights_.depth() == CV_32F ? heights_.at<float>(row, col)
                                      : heights_.at<double>(row, col);
  }

  /// The same surface as CV_64FC1: shares the pixels if they are double already.
  HeightMap asDouble() const;

 private:
  PixelOwner owner_;  ///< of the pixels, where the matrix only points to them
  cv::Mat heights_;
  double pitch_x_ = 0.0;
  double pitch_y_ = 0.0;
};

/// Two surfaces in one frame: z of both points from lower to upper. Without an upper surface there
/// is a level plane at z = 0 in its place. An empty `upper` is the one way to say so.
struct SurfacePair {
  SurfacePair() = default;
  SurfacePair(
      HeightMap lower_in,
      HeightMap upper_in = {})  // NOLINT(google-explicit-constructor): one surface is a pair
      : lower(std::move(lower_in)), upper(std::move(upper_in)) {}

  bool upperIsPlane() const { return upper.empty(); }

  HeightMap lower;
  HeightMap upper;  ///< same rows, cols and pitch; empty for a level plane
};

/// Height figures of one surface over its valid pixels.
struct HeightStatistics {
  int valid_count = 0;
  double mean = 0.0;        ///< [m]
  double rms_height = 0.0;  ///< Sq: root mean square about the mean [m] (ISO 25178-2, 4.1.1)
  double min = 0.0;         ///< [m]
  double max = 0.0;         ///< [m]
};

/// @throw SurfaceError if no pixel is valid.
HeightStatistics heightStatistics(const HeightMap& surface);

}  // namespace mems_stiction
