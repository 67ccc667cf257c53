#pragma once

/// @file
/// A random rough surface made by one transform: the way for small surfaces, which are made before
/// a kernel is.
///
/// White noise on a periodic frame is multiplied with the root of the spectrum, wave by wave (Hu
/// and Tonder, Int. J. Mach. Tools Manufact. 32 (1992) 83; Newland, An Introduction to Random
/// Vibrations, ch. 9). The frame is half as wide again as the surface, so that opposite edges do
/// not meet. A wave of the frame stands for all waves around it: the longest ones have the mean
/// density of those, so that the variance is the spectrum's.
///
///     WholeFrame frame(gain, 192, 192);
///     frame.make(NumberedNoise(seed, 0));
///     const cv::Mat& heights = frame.heights();  // 192 x 192, CV_32FC1

#include <cstdint>
#include <functional>

#include <opencv2/core.hpp>

#include "surface/frame_filter.hpp"
#include "surface/numbered_noise.hpp"

namespace mems_stiction {

/// Density of the power of a wave [rad/pixel], over that of white noise of variance 1 [m^2].
using WavePower = std::function<double(double wave_x, double wave_y)>;

/// The surfaces of one spectrum and size, one seed after the other.
class WholeFrame {
 public:
  /// - @p is_even whether waves along (x, y) and (x, -y) have one power: half of them are asked for
  /// then
  WholeFrame(const WavePower& power, int rows, int cols, bool is_even = false);

  void make(NumberedNoise noise);
  /// CV_32FC1, rows x cols [m]; empty before the first make().
  const cv::Mat& heights() const { return heights_; }
  /// Mean square over all surfaces [m^2].
  double variance() const { return variance_; }

 private:
  cv::Size size_;
  cv::Size frame_;
  cv::Mat gains_;  ///< of the frame's waves over the number of its pixels, as FrameFilter has them
  FrameFilter filter_;
  cv::Mat heights_;
  double variance_ = 0.0;
};

}  // namespace mems_stiction
