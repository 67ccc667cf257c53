#pragma once

/// @file
/// The periodogram of one scan, wave by wave: mean plane off, Hann's window, powers over the mean
/// square of the window.
///
/// Hann's window mixes a wave with its neighbours, and levelling takes most off the longest ones.
/// waveTransfer() says what reaches each of them, so that what a spectrum would give there can be
/// compared with what is found.

#include <cmath>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/height_map/height_map.hpp"
#include "numeric/constants.hpp"
#include "roughness/filled_surface.hpp"

namespace mems_stiction {

/// A wave of a frame, by how many of it lie along its sides.
struct FrameWave {
  double x = 0.0;  ///< along the rows [-]
  double y = 0.0;  ///< along the columns [-]

  double count() const { return std::hypot(x, y); }
};

/// The waves of one scan.
class ScanWaves {
 public:
  /// - @p surface its heights, or numbers in their place; missing ones are filled
  explicit ScanWaves(const HeightMap& surface);
  explicit ScanWaves(const FilledSurface& filled);

  double sideX() const { return side_x_; }
  double sideY() const { return side_y_; }
  double longerSide() const { return std::max(side_x_, side_y_); }
  double longerPitch() const { return std::max(side_x_ / cols_, side_y_ / rows_); }
  bool isAlike(const ScanWaves& other) const {
    return side_x_ == other.side_x_ && side_y_ == other.side_y_ && rows_ == other.rows_ &&
           cols_ == other.cols_;
  }
  double waveNumberX(double wave_x) const { return 2.0 * kPi * wave_x / side_x_; }
  double waveNumberY(double wave_y) const { return 2.0 * kPi * wave_y / side_y_; }

  /// visit(FrameWave, power [m^4], weight): weight 2 for a wave and its mirror image; without the
  /// wave 0.
  template <typename Visit>
  void visit(const Visit& visit) const;
  /// The same of scans that are alike, at least one, with the sum of their powers.
  template <typename Visit>
  static void visit(const std::vector<const ScanWaves*>& alike, const Visit& visit);

 private:
  int rows_ = 0;
  int cols_ = 0;
  double side_x_ = 0.0;  ///< [m]
  double side_y_ = 0.0;  ///< [m]
  cv::Mat powers_;       ///< by x from 0 to cols/2, and y, CV_32FC1 over unit_
  double unit_ = 1.0;    ///< [m^4]
};

template <typename Visit>
void ScanWaves::visit(const Visit& visit) const {
  ScanWaves::visit({this}, visit);
}

template <typename Visit>
void ScanWaves::visit(const std::vector<const ScanWaves*>& alike, const Visit& visit) {
  const ScanWaves& first = *alike.front();
  for (int x = 0; x < first.powers_.rows; ++x) {
    const double weight = x > 0 && 2 * x < first.cols_ ? 2.0 : 1.0;
    for (int y = 0; y < first.rows_; ++y) {
      if (x == 0 && y == 0) continue;
      const FrameWave wave{static_cast<double>(x),
                           static_cast<double>(2 * y <= first.rows_ ? y : y - first.rows_)};
      double power = 0.0;
      for (const ScanWaves* scan : alike) {
        power += scan->unit_ * static_cast<double>(scan->powers_.ptr<float>(x)[y]);
      }
      visit(wave, power, weight);
    }
  }
}

/// Below so many waves along a side, what a spectrum gives is computed and not taken as the
/// spectrum itself [-].
constexpr int kLongWaves = 8;

/// What of a spectrum reaches the long waves of a scan.
struct WaveTransfer {
  std::vector<FrameWave> waves;  ///< with up to kLongWaves along the sides, a half of the plane
  std::vector<double>
      weights;  ///< 2, or 1 for those with x = 0 whose mirror image is there as well
  std::vector<double> sources;  ///< places of the waves of the surface, along either axis [-]
  cv::Mat shares;  ///< waves x (sources of y and x), CV_64FC1: share of the density that arrives
  /// The same of round spectra on square frames, where sources of one length have one density: a
  /// twelfth of the work.
  std::vector<double> lengths;  ///< of the sources [waves along a side]
  cv::Mat round_shares;         ///< waves x lengths, CV_64FC1
};
const WaveTransfer& waveTransfer();

}  // namespace mems_stiction
