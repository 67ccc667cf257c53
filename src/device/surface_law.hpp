#pragma once

/// @file
/// The law that the scans of a surface say it follows: from which random surfaces they may have been cut.
///
///     z = T(g)                       g a Gaussian field: where the heights as a whole are not Gaussian, or
///     z = T(g of short waves) + long waves, Gaussian    where it is only the short ones that are not
///
/// Whether heights are Gaussian is asked by their skewness and kurtosis, against what few long waves make of those by chance:
/// 6/A times the integral of rho^3 and 24/A times that of rho^4 are their variances over an area A of a Gaussian surface with
/// the autocorrelation rho. The widest scan that has most of the variance is asked first, then the finest ones, then these
/// without their longer waves; the first clear answer counts. An unclear one is taken by 1 - 4/chi^2.
///
/// Scans are levelled again so that it is their numbers g, and not their heights, that have no slope; the spectrum of the
/// field is the one of these numbers. So the short waves of a polished top count as they are on the top.
/// A scan as large as the device has long waves of its own: they are taken in place of random ones, as far as its pixels know them. What
/// samples say of a wave is its best estimate among those that look alike in them (Wiener), and what they leave open of its power is
/// random. Whether pixels are points or means over their area, their shorter waves tell (Whittle's likelihood).

#include <optional>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "roughness/height_marginal.hpp"
#include "roughness/merged_spectrum.hpp"

namespace mems_stiction {

/// The waves of the widest scan that are long against its pixels.
struct OwnLongWaves {
  cv::Mat heights;       ///< or numbers, CV_64FC1
  double pitch_x = 0.0;  ///< [m]
  double pitch_y = 0.0;  ///< [m]
  double tilt_x = 0.0;   ///< rms height of the plane that levelling takes off such a scan, along the rows
  double tilt_y = 0.0;   ///< and along the columns
  /// Share of a wave's power that it leaves open [-], by wave number at equal steps from 0; all of it beyond.
  std::vector<double> open_shares;
  double open_step = 0.0;  ///< [rad/m]

  double openShare(double wave_number) const {
    const double place = wave_number / open_step;
    if (!(place < static_cast<double>(open_shares.size() - 1))) return 1.0;
    const auto below = static_cast<std::size_t>(place);
    return open_shares[below] + (place - static_cast<double>(below)) * (open_shares[below + 1] - open_shares[below]);
  }
};

/// What random surfaces the scans may have been cut from.
struct SurfaceLaw {
  MergedSpectrum heights;             ///< of z
  MergedSpectrum numbers;             ///< of g; that of z where all is Gaussian
  HeightMarginal marginal{0.0, 1.0};  ///< T
  double non_gaussian_share = 0.0;    ///< 0: all is Gaussian
  double split_wave_number = 0.0;     ///< longer waves are Gaussian in any case [rad/m]
  double join_wave_number = 0.0;      ///< longer ones are the widest scan's own [rad/m]
  std::optional<OwnLongWaves> own;
  double slope = 0.0;            ///< -d ln C/d ln q at the longest waves that are believed [-]
  double slope_deviation = 0.0;  ///< standard error of it [-]

  double longestWave() const { return 2.0 * kPi / heights.bands.front().wave_number; }  ///< that is believed [m]
};

/// Share of a wave's height that is above a split, as a filter.
double highPass(double wave_number, double split);

/// - @p scans of one surface, levelled or not, at least one
/// - @p form of the tail of their heights, which they hardly tell
/// @throw SurfaceError if they show no roughness
SurfaceLaw surfaceLawOf(const std::vector<HeightMap>& scans, TailForm form = TailForm::kExponential);

}  // namespace mems_stiction
