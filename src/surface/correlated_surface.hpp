#pragma once

/// @file
/// A made surface that fits another one, as films do that have grown on each other: they share
/// their long waves.
///
///     z_2(q) = rho sqrt(C_2/C_1) z_1(q) + sqrt(1 - rho^2) z(q)     for 2 pi/q >= L
///     sigma^2 = sigma_1^2 + sigma_2^2 - 2 rho sigma_1 sigma_2      of what is between them, by
///     band
///
/// z is the made surface with the spectrum C_2, z_1 the scan with the spectrum C_1, both in the
/// scan's frame. The ratio of spectra is that of bands of a quarter of an octave or 24 waves,
/// whichever is wider, and a power law between their middles. The scan goes on by its reflections,
/// so that its edges are no steps; what was not measured of it is filled. Skewness and kurtosis are
/// those of the mixture. Assumption: both surfaces lie as they have grown; a pose moves them from
/// there. That films on each other are correlated: DelRio et al., Nature Materials 4 (2005) 629;
/// the formula is the variance of a difference.
///
///     const HeightMap upper = correlatedWith(scan, made, {0.8, 200e-9});

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// How far two surfaces fit.
struct SurfaceFit {
  double correlation = 0.0;      ///< rho of the heights of longer waves [-], in [0, 1]
  double shortest_shared = 0.0;  ///< L, shorter waves have nothing in common [m]; 0 = all have
};

/// The made surface with as much of the scan as they fit, and its own rms height.
/// - @p scan, @p made of one grid, in one frame; a scan without relief has nothing to share
HeightMap correlatedWith(const HeightMap& scan, const HeightMap& made, const SurfaceFit& fit);

}  // namespace mems_stiction
