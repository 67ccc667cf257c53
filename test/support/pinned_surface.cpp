#include "support/pinned_surface.hpp"

#include <limits>

namespace mems_stiction {

HeightMap pinnedSurface(const HeightMap& surface, double gap) {
  cv::Mat1d heights(surface.rows() + 2, surface.cols(), std::numeric_limits<double>::quiet_NaN());
  surface.asDouble().heights().copyTo(heights.rowRange(0, surface.rows()));
  heights(surface.rows() + 1, surface.cols() / 2) = gap;
  return {heights, surface.pitchX(), surface.pitchY()};
}

}  // namespace mems_stiction
