#include "device/scan_list.hpp"

#include <limits>

namespace mems_stiction {

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
