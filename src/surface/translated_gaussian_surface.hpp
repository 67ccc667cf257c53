#pragma once

/// @file
/// A random rough surface whose heights are skewed, or have heavier or lighter tails than Gaussian
/// ones: worn surfaces have a negative skewness, surfaces with particles a positive one and a high
/// kurtosis.
///
/// The heights of a Gaussian surface are passed through Johnson's translation
/// (johnson_translation.hpp). That changes the autocorrelation; the correlation lengths of the
/// Gaussian surface are chosen such that those asked for, where the autocorrelation has fallen to
/// 1/e, come out. Mean and rms height of the sample are exact. Its skewness and kurtosis scatter
/// about those asked for, as those of any sample of finite size do; heavy tails scatter most.

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/surface/counter_surface_options.hpp"

namespace mems_stiction {

/// @return rows x cols, CV_64FC1, metres, zero mean, all valid. With skewness 0 and kurtosis 3
/// gaussianSurface(), to the bit.
/// @throw OptionsError with the lines of validate(), if there are any.
HeightMap translatedGaussianSurface(const TranslatedGaussianOptions& options);

}  // namespace mems_stiction
