#include "device/usable_scans.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "device/scan_list.hpp"
#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "roughness/filled_surface.hpp"

namespace mems_stiction {
namespace {

/// Two copies of a scan differ by round-off of single precision or 16 bits, two scans of a place by
/// their noise: the rms difference over the rms height [-].
constexpr double kCopyDifference = 1e-3;
/// Pixels along each side that must have been measured.
constexpr int kLeastMeasuredSide = 8;

bool haveOneGrid(const HeightMap& one, const HeightMap& other) {
  const auto isNear = [](double left, double right) {
    return std::abs(left - right) <= 1e-6 * right;
  };
  return one.rows() == other.rows() && one.cols() == other.cols() &&
         isNear(one.pitchX(), other.pitchX()) && isNear(one.pitchY(), other.pitchY());
}

/// Whether both show the same heights but for round-off and a constant.
bool isCopy(const HeightMap& one, const HeightMap& other) {
  if (!haveOneGrid(one, other)) return false;
  const HeightStatistics of_one = heightStatistics(one);
  const double offset = heightStatistics(other).mean - of_one.mean;
  const double most = std::pow(kCopyDifference * of_one.rms_height, 2) * of_one.valid_count;
  double squares = 0.0;
  for (int row = 0; row < one.rows(); ++row) {
    for (int col = 0; col < one.cols(); ++col) {
      const double difference = other.height(row, col) - one.height(row, col) - offset;
      if (std::isfinite(difference)) {
        squares += difference * difference;
      } else if (std::isfinite(one.height(row, col)) || std::isfinite(other.height(row, col))) {
        return false;
      }
    }
    if (squares > most) return false;
  }
  return true;
}

void checkMeasured(const NamedScan& scan) {
  const cv::Rect measured = cv::boundingRect(validMask(scan.surface.heights()));
  if (std::min(measured.width, measured.height) >= kLeastMeasuredSide) return;
  throw SurfaceError(scan.name + ": its measured pixels lie within " +
                     std::to_string(measured.width) + " x " + std::to_string(measured.height) +
                     " of its " + std::to_string(scan.surface.cols()) + " x " +
                     std::to_string(scan.surface.rows()) +
                     " pixels, which say nothing of a device; at least 8 x 8 do. Leave it out, or "
                     "measure it again");
}

std::vector<NamedScan> usable(std::vector<NamedScan> scans, std::vector<std::string>& remarks) {
  std::stable_sort(scans.begin(), scans.end(), [](const NamedScan& one, const NamedScan& other) {
    return comesBefore(one.surface, other.surface);
  });
  std::vector<NamedScan> distinct;
  for (const NamedScan& scan : scans) {
    checkMeasured(scan);
    const auto same = std::find_if(distinct.begin(), distinct.end(), [&](const NamedScan& other) {
      return isCopy(other.surface, scan.surface);
    });
    if (same != distinct.end()) {
      remarks.push_back(scan.name == same->name
                            ? scan.name + ": is given twice and counts once"
                            : scan.name + ": shows the heights of " + same->name +
                                  " again; both count as one scan");
      continue;
    }
    const std::string filled = filledSentence(scan.surface);
    if (!filled.empty()) remarks.push_back(scan.name + ": " + filled);
    distinct.push_back(scan);
  }
  return distinct;
}

}  // namespace

UsableScans usableScans(const DeviceSurfaces& surfaces) {
  UsableScans found;
  found.surfaces.scans = usable(surfaces.scans, found.remarks);
  found.surfaces.counter_surface = usable(surfaces.counter_surface, found.remarks);
  return found;
}

}  // namespace mems_stiction
