#pragma once

/// @file
/// Settings of the counter-surface (counter_surface.hpp): what it is, how it lies over the scan,
/// and how random ones are drawn.
///
///     Gaussian     <z(r) z(r + (x, y))> = sigma^2 exp(-(x^2/lx^2 + y^2/ly^2))
///     self-affine  C(q) = C0 below q_r, C0 (q/q_r)^(-2 - 2 H) up to q_s, 0 beyond;
///             q = 2 pi/wavelength
///
/// Generated surfaces are periodic, have the exact rms height (or slope), and depend on grid and
/// seed alone; with a correlation on the scan's heights, too, and their own part alone is periodic.
/// The pose is rigid: the middle of the counter-surface lies over the middle of the scan.
/// Degenerate cases: an rms height of 0 is a plane; what a measured surface does not cover is
/// invalid; a measured surface without a facing is refused.
///
///     CounterSurfaceOptions options;
///     options.type = CounterSurfaceType::kGaussian;
///     options.gaussian.gaussian.rms_height = 2e-9;  // [m]

#include <string>
#include <vector>

#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// Defaults: centred, not turned, level.
struct SurfacePose {
  double offset_x = 0.0;  ///< [m]
  double offset_y = 0.0;  ///< [m]
  double rotation = 0.0;  ///< about z [rad]
  double tilt_x = 0.0;    ///< of the slope along x [rad], in (-1.5, 1.5)
  double tilt_y = 0.0;    ///< of the slope along y [rad], in (-1.5, 1.5)

  /// Keys are prefix + "/offset_x" and so on.
  void describe(OptionVisitor& visitor, const std::string& prefix = "counter_surface/pose");
};

/// Defaults: a 5.1 um frame of a smooth polysilicon film.
struct GaussianSurfaceOptions {
  int rows = 512;                       ///< in [2, 32768]
  int cols = 512;                       ///< in [2, 32768]
  double pitch_x = 10e-9;               ///< distance of neighbouring columns [m], > 0
  double pitch_y = 10e-9;               ///< distance of neighbouring rows [m], > 0
  double rms_height = 3e-9;             ///< sigma [m], >= 0
  double correlation_length_x = 80e-9;  ///< lx [m], > 0, at most half the frame's width
  double correlation_length_y = 80e-9;  ///< ly [m], > 0, at most half the frame's height
  int seed = 1;                         ///< >= 0; the same seed gives the same surface

  /// Keys are prefix + "/rows" and so on.
  void describe(OptionVisitor& visitor, const std::string& prefix);
  /// One line per violated constraint; empty when all is well.
  std::vector<std::string> validate(const std::string& prefix = "gaussian") const;
};

/// A Gaussian surface, with skewness and kurtosis of its own.
struct TranslatedGaussianOptions {
  GaussianSurfaceOptions
      gaussian;  ///< size, rms height, correlation lengths and seed of the surface asked for
  double skewness = 0.0;  ///< in [-4, 4]
  double kurtosis = 3.0;  ///< in [skewness^2 + 1.2, 100]; Gaussian: 3

  /// Keys are prefix + "/skewness" and so on, after those of the Gaussian surface.
  void describe(OptionVisitor& visitor, const std::string& prefix);
  /// One line per violated constraint; empty when all is well.
  std::vector<std::string> validate(const std::string& prefix = "gaussian") const;
};

enum class RoughnessScale {
  kRmsHeight,  ///< rms_height is exact
  kRmsSlope,   ///< rms_slope is exact
};

/// Defaults: a 5.1 um frame of a smooth polysilicon film.
struct SelfAffineSurfaceOptions {
  int rows = 512;                    ///< in [2, 32768]
  int cols = 512;                    ///< in [2, 32768]
  double pitch_x = 10e-9;            ///< [m], > 0
  double pitch_y = 10e-9;            ///< [m], > 0
  double hurst_exponent = 0.8;       ///< H, in [0, 1]
  double rolloff_wavelength = 1e-6;  ///< [m], > cutoff_wavelength, at most the frame's longer side
  double cutoff_wavelength = 40e-9;  ///< [m], at least two of the larger pitch
  RoughnessScale scale = RoughnessScale::kRmsHeight;
  double rms_height = 3e-9;  ///< [m], >= 0
  double rms_slope = 0.1;    ///< [-], >= 0
  int seed = 1;              ///< >= 0; the same seed gives the same surface

  /// Keys are prefix + "/rows" and so on.
  void describe(OptionVisitor& visitor, const std::string& prefix);
  /// One line per violated constraint; empty when all is well.
  std::vector<std::string> validate(const std::string& prefix = "self_affine") const;
};

enum class CounterSurfaceType {
  kFlat,        ///< a plane
  kTopic,       ///< a measured height map that arrives beside the scans
  kFile,        ///< a measured height map from a file
  kGaussian,    ///< generated: translated_gaussian_surface.hpp
  kSelfAffine,  ///< generated: self_affine_surface.hpp
};

/// Which way the heights of a measured counter-surface point.
enum class CounterSurfaceFacing {
  kUnstated,  ///< nobody has said it: a measured counter-surface is refused
  kDown,      ///< as mounted: z and columns are those of the scan's frame
  kUp,  ///< as measured, asperities up: turned over about its y axis (z negated, columns mirrored)
};

/// What the counter-surface is and how it lies.
struct CounterSurfaceOptions {
  CounterSurfaceType type = CounterSurfaceType::kFlat;
  CounterSurfaceFacing facing = CounterSurfaceFacing::kUnstated;
  std::string file;     ///< for type file
  std::string channel;  ///< title or number, of an instrument maker's file; empty = the likeliest
                        ///< height channel
  SurfacePose pose;
  TranslatedGaussianOptions
      gaussian;  ///< its rows, cols and pitches are the scan's, its seed is `seed`
  SelfAffineSurfaceOptions self_affine;  ///< the same
  int seed = 1;                          ///< of generated surfaces, >= 0
  double correlation = 0.0;  ///< rho of generated surfaces with the scan, of their long waves, in
                             ///< [0, 1]; correlated_surface.hpp
  double correlation_length = 0.0;  ///< shorter waves are independent [m], >= 0; 0 = none is

  bool isMeasured() const {
    return type == CounterSurfaceType::kTopic || type == CounterSurfaceType::kFile;
  }
  bool isGenerated() const {
    return type == CounterSurfaceType::kGaussian || type == CounterSurfaceType::kSelfAffine;
  }
  /// Whether it is another one over every scan.
  bool fitsScan() const { return isGenerated() && correlation > 0.0; }

  void describe(OptionVisitor& visitor);
};

}  // namespace mems_stiction
