#include "mems_stiction/roughness/summits.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mems_stiction/base/constants.hpp"
#include "mems_stiction/height_map/validity.hpp"

namespace mems_stiction {

SummitParameters summitParameters(const HeightMap& surface) {
  const cv::Mat heights = ownedHeights(surface) - heightStatistics(surface).mean;
  const double per_x = 1.0 / (surface.pitchX() * surface.pitchX());
  const double per_y = 1.0 / (surface.pitchY() * surface.pitchY());
  SummitParameters found;
  long long examined = 0;
  double curvatures = 0.0;
  std::vector<double> summits;
  for (int row = 1; row + 1 < heights.rows; ++row) {
    const double* above = heights.ptr<double>(row - 1);
    const double* line = heights.ptr<double>(row);
    const double* below = heights.ptr<double>(row + 1);
    for (int col = 1; col + 1 < heights.cols; ++col) {
      const double z = line[col];
      const double before[] = {above[col - 1], above[col], above[col + 1], line[col - 1]};
      const double after[] = {line[col + 1], below[col - 1], below[col], below[col + 1]};
      double sum = z;
      bool highest = true;
      for (const double neighbour : before) {
        sum += neighbour;
        highest = highest && z >= neighbour;
      }
      for (const double neighbour : after) {
        sum += neighbour;
        highest = highest && z > neighbour;
      }
      if (std::isnan(sum)) continue;
      ++examined;
      if (!highest) continue;
      curvatures +=
          0.5 * ((2.0 * z - line[col - 1] - line[col + 1]) * per_x + (2.0 * z - above[col] - below[col]) * per_y);
      summits.push_back(z);
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

SummitParameters summitsOfGaussianSurface(const SpectralMoments& moments) {
  SummitParameters expected;
  if (!(moments.m2 > 0.0)) return expected;
  expected.density = moments.m4 / moments.m2 / (6.0 * kPi * std::sqrt(3.0));
  expected.mean_curvature = 8.0 / 3.0 * std::sqrt(moments.m4 / kPi);
  expected.mean_radius = 1.0 / expected.mean_curvature;
  expected.rms_height = std::sqrt(moments.m0 * std::max(0.0, 1.0 - 0.8968 / moments.alpha));
  return expected;
}

}  // namespace mems_stiction
