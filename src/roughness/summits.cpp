#include "roughness/summits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "numeric/vectorized.hpp"
#include "preprocess/working_surface.hpp"

namespace mems_stiction {
namespace {

/// Which pixels of a row are above their neighbours: 1, else 0; -1 where one of the nine is
/// invalid. The borders stay.
MEMS_STICTION_VECTORIZED void findSummits(const double* above, const double* line,
                                          const double* below, std::size_t size,
                                          std::int64_t* found) {
  for (std::size_t col = 1; col + 1 < size; ++col) {
    const double z = line[col];
    const double highest_before =
        std::max(std::max(above[col - 1], above[col]), std::max(above[col + 1], line[col - 1]));
    const double highest_after =
        std::max(std::max(line[col + 1], below[col - 1]), std::max(below[col], below[col + 1]));
    const double sum = ((above[col - 1] + above[col]) + (above[col + 1] + line[col - 1])) +
                       ((line[col + 1] + below[col - 1]) + (below[col] + below[col + 1])) + z;
    const std::int64_t is_summit = (z >= highest_before) & (z > highest_after);
    found[col] = sum == sum ? is_summit : -1;
  }
}

}  // namespace

SummitParameters summitParameters(const HeightMap& surface) {
  WorkingSurface work(surface);
  const cv::Mat& heights = work.heights;
  const double mean_height = meansOf(heights, work.memory).height;
  const double per_x = 1.0 / (surface.pitchX() * surface.pitchX());
  const double per_y = 1.0 / (surface.pitchY() * surface.pitchY());
  SummitParameters found;
  long long examined = 0;
  double curvatures = 0.0;
  std::vector<double> summits;
  std::vector<std::int64_t> is_summit(static_cast<std::size_t>(heights.cols));
  for (int row = 1; row + 1 < heights.rows; ++row) {
    const double* above = heights.ptr<double>(row - 1);
    const double* line = heights.ptr<double>(row);
    const double* below = heights.ptr<double>(row + 1);
    findSummits(above, line, below, is_summit.size(), is_summit.data());
    for (std::size_t col = 1; col + 1 < is_summit.size(); ++col) {
      examined += is_summit[col] >= 0;
      if (is_summit[col] <= 0) continue;
      const double z = line[col];
      curvatures += 0.5 * ((2.0 * z - line[col - 1] - line[col + 1]) * per_x +
                           (2.0 * z - above[col] - below[col]) * per_y);
      summits.push_back(z - mean_height);
    }
  }
  if (summits.empty()) return found;
  const double count = static_cast<double>(summits.size());
  found.count = static_cast<int>(summits.size());
  found.density = count / (static_cast<double>(examined) * surface.cellArea());
  found.mean_curvature = curvatures / count;
  found.mean_radius = 1.0 / found.mean_curvature;
  double mean = 0.0;
  for (const double height : summits) mean += height / count;
  double squares = 0.0;
  for (const double height : summits) squares += (height - mean) * (height - mean);
  found.rms_height = std::sqrt(squares / count);
  return found;
}

}  // namespace mems_stiction
