#pragma once

/// @file
/// Which long waves does a surface have at the place that a wide scan shows?
///
/// They are taken in place of random ones, as far as the scan's pixels know them. What
/// samples say of a wave is its best estimate among those that look alike in them (Wiener), and
/// what they leave open of its power is random. Whether pixels are points or means over their area,
/// their shorter waves tell (Whittle's likelihood).

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/height_map/height_map.hpp"
#include "roughness/merged_spectrum.hpp"

namespace mems_stiction {

/// The waves of the widest scan that are long against its pixels.
struct OwnLongWaves {
  cv::Mat heights;       ///< or numbers, CV_64FC1
  double pitch_x = 0.0;  ///< [m]
  double pitch_y = 0.0;  ///< [m]
  double tilt_x =
      0.0;  ///< rms height of the plane that levelling takes off such a scan, along the rows
  double tilt_y = 0.0;  ///< and along the columns
  /// Share of a wave's power that it leaves open [-], by wave number at equal steps from 0; all of
  /// it beyond.
  std::vector<double> open_shares;
  double open_step = 0.0;  ///< [rad/m]

  double openShare(double wave_number) const {
    const double place = wave_number / open_step;
    if (!(place < static_cast<double>(open_shares.size() - 1))) return 1.0;
    const auto below = static_cast<std::size_t>(place);
    return open_shares[below] +
           (place - static_cast<double>(below)) * (open_shares[below + 1] - open_shares[below]);
  }
};

/// Share of a wave's height that is above a split, as a filter.
double highPass(double wave_number, double split);
/// Over the split: from here on the filter passes all, to the last bit [-].
constexpr double kHighPassEnd = 2.5;

/// Whether the pixels of a scan are means over their area, by the likelihood of its shorter waves,
/// from an eighth of its pixels along the side on.
bool areMeans(const HeightMap& scan, const ScanWaves& waves, const MergedSpectrum& spectrum);

/// - @p scan levelled heights, or numbers in their place, CV_64FC1
/// - @p spectrum of these values
/// - @p split only longer waves are wanted [rad/m]; 0 = all
OwnLongWaves ownLongWaves(const HeightMap& scan, const MergedSpectrum& spectrum, double split,
                          bool are_means);

}  // namespace mems_stiction
