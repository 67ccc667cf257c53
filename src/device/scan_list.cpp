#include "device/scan_list.hpp"

#include <cmath>
#include <limits>
#include <tuple>

namespace mems_stiction {

bool comesBefore(const HeightMap& one, const HeightMap& other) {
  const auto shape = [](const HeightMap& scan) {
    return std::make_tuple(longerPitch(scan), -areaOf(scan), scan.rows(), scan.pitchX());
  };
  if (shape(one) != shape(other)) return shape(one) < shape(other);
  const auto heightIn = [](const HeightMap& scan, int row, int col) {
    const double height = scan.height(row, col);
    return std::isfinite(height) ? height : -std::numeric_limits<double>::infinity();
  };
  for (int row = 0; row < one.rows(); ++row) {
    for (int col = 0; col < one.cols(); ++col) {
      const double here = heightIn(one, row, col);
      const double there = heightIn(other, row, col);
      if (here != there) return here < there;
    }
  }
  return false;
}

std::vector<HeightMap> mapsOf(const std::vector<NamedScan>& scans) {
  std::vector<HeightMap> maps;
  maps.reserve(scans.size());
  for (const NamedScan& scan : scans) maps.push_back(scan.surface);
  return maps;
}

double finestPitch(const std::vector<HeightMap>& scans) {
  double finest = std::numeric_limits<double>::infinity();
  for (const HeightMap& scan : scans) finest = std::min(finest, longerPitch(scan));
  return finest;
}

bool showsSummits(const HeightMap& scan, double finest) {
  constexpr double kAsFine = 1.5;
  return longerPitch(scan) <= kAsFine * finest;
}

std::vector<HeightMap> fineMapsOf(const std::vector<NamedScan>& scans) {
  std::vector<HeightMap> maps = mapsOf(scans);
  const double finest = finestPitch(maps);
  const auto isCoarse = [&](const HeightMap& scan) { return longerPitch(scan) >= 1.01 * finest; };
  maps.erase(std::remove_if(maps.begin(), maps.end(), isCoarse), maps.end());
  return maps;
}

}  // namespace mems_stiction
