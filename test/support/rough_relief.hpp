#pragma once

#include <algorithm>

#include "numeric/large_pages.hpp"
#include "surface/gaussian_surface.hpp"

namespace mems_stiction {

/// Gap at first touch of a rough surface and a plane, row by row [m].
inline LargePageVector<double> roughRelief(const GaussianSurfaceOptions& options) {
  const cv::Mat1d heights = gaussianSurface(options).heights();
  LargePageVector<double> relief(heights.begin(), heights.end());
  const double summit = *std::max_element(relief.begin(), relief.end());
  for (double& gap : relief) gap = summit - gap;
  return relief;
}

}  // namespace mems_stiction
