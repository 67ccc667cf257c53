#pragma once

/// @file
/// A random rough surface with Gaussian heights and a Gaussian autocorrelation.
///
///     <z(r) z(r + (x, y))> = sigma^2 exp(-(x^2/lx^2 + y^2/ly^2))
///
/// White noise is filtered by the root of the discrete spectrum of that autocorrelation, wrapped
/// around the frame. The surface is periodic: its last column goes on in its first, its last row in
/// its first row. Mean and rms height of the sample are then made exact. The autocorrelation of one
/// sample scatters about the formula by about sqrt(pi lx ly/(2 area)) of sigma^2. Assumptions:
/// heights are symmetrical about their mean. Worn, polished or tip-scanned surfaces are not.
/// Outside: a correlation length below the pitch gives white noise; beyond half the frame's side a
/// sample says nothing about the surface, so it is refused. Source: Hu and Tonder, Int. J. Mach.
/// Tools Manufact. 32 (1992) 83, with the spectrum in place of their FIR filter.
///
///     GaussianSurfaceOptions options;
///     options.rms_height = 5e-9;
///     options.seed = 7;
///     const HeightMap surface = gaussianSurface(options);

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/surface/counter_surface_options.hpp"

namespace mems_stiction {

/// @return rows x cols, CV_64FC1, metres, zero mean, all valid.
/// @throw OptionsError with the lines of validate(), if there are any.
HeightMap gaussianSurface(const GaussianSurfaceOptions& options);

}  // namespace mems_stiction
