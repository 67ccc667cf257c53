#pragma once

/// @file
/// The law that the scans of a surface say it follows: from which random surfaces they may have
/// been cut.
///
///     z = T(g)               g a Gaussian field: where the heights as a whole are not Gaussian, or
///     z = T(g of short waves) + long waves, Gaussian  where it is only the short ones that are not
///
/// Whether heights are Gaussian is asked by their skewness and kurtosis, against what few long
/// waves make of those by chance: 6/A times the integral of rho^3 and 24/A times that of rho^4 are
/// their variances over an area A of a Gaussian surface with the autocorrelation rho. The widest
/// scan that has most of the variance is asked first, then the finest ones, then these without
/// their longer waves; the first clear answer counts. An unclear one is taken by 1 - 4/chi^2.
///
/// Scans are levelled again so that it is their numbers g, and not their heights, that have no
/// slope; the spectrum of the field is the one of these numbers. So the short waves of a polished
/// top count as they are on the top. A scan as large as the device gives its own long waves
/// (own_long_waves.hpp).

#include <memory>
#include <optional>
#include <vector>

#include "device/own_long_waves.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "roughness/height_marginal.hpp"
#include "roughness/merged_spectrum.hpp"

namespace mems_stiction {

/// What random surfaces the scans may have been cut from.
struct SurfaceLaw {
  MergedSpectrum heights;             ///< of z
  MergedSpectrum numbers;             ///< of g; that of z where all is Gaussian
  HeightMarginal marginal{0.0, 1.0};  ///< T
  double non_gaussian_share = 0.0;    ///< 0: all is Gaussian
  double split_wave_number = 0.0;     ///< longer waves are Gaussian in any case [rad/m]
  std::optional<OwnLongWaves> own;
  double slope = 0.0;            ///< -d ln C/d ln q at the longest waves that are believed [-]
  double slope_deviation = 0.0;  ///< standard error of it [-]

  double longestWave() const {
    return 2.0 * kPi / heights.bands.front().wave_number;
  }  ///< that is believed [m]
};

/// What the scans of one surface say of its law, but for the form of the tail of their heights,
/// which they hardly tell.
class SurfaceStudy {
 public:
  /// - @p scans levelled or not, at least one
  /// - @p like a study of scans of the same sizes: heights are asked whether they are Gaussian
  /// where they told most there, and
  ///   nowhere else, which takes most of the time; and no stretch is sought where it found none
  /// @throw SurfaceError if they show no roughness
  explicit SurfaceStudy(const std::vector<HeightMap>& scans, const SurfaceStudy* like = nullptr);
  ~SurfaceStudy();
  SurfaceStudy(SurfaceStudy&& other) noexcept;
  SurfaceStudy& operator=(SurfaceStudy&& other) noexcept;

  /// Whether both forms of the tail are the same law.
  bool isGaussian() const;
  SurfaceLaw law(TailForm form = TailForm::kExponential) const;

 private:
  static SpectrumStretch stretchOf(const std::vector<ScanWaves>& waves,
                                   const std::vector<ScanTrust>& trust, const SurfaceStudy* like);

  struct Findings;
  std::unique_ptr<const Findings> findings_;
};

}  // namespace mems_stiction
