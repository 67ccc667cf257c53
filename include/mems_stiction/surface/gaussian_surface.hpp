#pragma once

/// @file
/// A random rough surface with Gaussian heights and a Gaussian autocorrelation.
///
///     <z(r) z(r + (x, y))> = sigma^2 exp(-(x^2/lx^2 + y^2/ly^2))
///
/// White noise is filtered by the root of the discrete spectrum of that autocorrelation, wrapped around the frame. The
/// surface is periodic: its last column goes on in its first, its last row in its first row. Mean and rms height of the
/// sample are then made exact. The autocorrelation of one sample scatters about the formula by about
/// sqrt(pi lx ly/(2 area)) of sigma^2.
/// Assumptions: heights are symmetrical about their mean. Worn, polished or tip-scanned surfaces are not.
/// Outside: a correlation length below the pitch gives white noise; beyond half the frame's side a sample says nothing
/// about the surface, so it is refused.
/// Source: Hu and Tonder, Int. J. Mach. Tools Manufact. 32 (1992) 83, with the spectrum in place of their FIR filter.
///
///     GaussianSurfaceOptions options;
///     options.rms_height = 5e-9;
///     options.seed = 7;
///     const HeightMap surface = gaussianSurface(options);

#include <string>
#include <vector>

#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

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

/// @return rows x cols, CV_64FC1, metres, zero mean, all valid.
/// @throw OptionsError with the lines of validate(), if there are any.
HeightMap gaussianSurface(const GaussianSurfaceOptions& options);

}  // namespace mems_stiction
