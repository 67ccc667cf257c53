#include "mems_stiction/height_map/scan_sanity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/option_visitor.hpp"

namespace mems_stiction {
namespace {

constexpr double kSmallestPitch = 1e-12;  // [m], far below an atom
constexpr double kLargestPitch = 1e-3;    // [m], above any pixel that resolves asperities
constexpr double kSpacingShare = 0.1;     // of the rms height: quantisation then adds 0.04 % to its square

/// Every finite height is a float32: the data has passed through one.
bool isSinglePrecision(const cv::Mat& heights) {
  if (heights.depth() == CV_32F) return true;
  for (int row = 0; row < heights.rows; ++row) {
    const double* line = heights.ptr<double>(row);
    for (int col = 0; col < heights.cols; ++col) {
      if (std::isfinite(line[col]) && static_cast<double>(static_cast<float>(line[col])) != line[col]) return false;
    }
  }
  return true;
}

std::string metres(double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.3g m", value);
  return buffer;
}

void checkPitch(const std::string& key, double pitch, std::vector<std::string>& lines) {
  if (pitch > kLargestPitch) {
    lines.push_back(key + " " + metres(pitch) + " is above 1 mm: probably nm or um given as metres");
  } else if (pitch < kSmallestPitch) {
    lines.push_back(key + " " + metres(pitch) + " is below 1 pm: probably converted to metres twice");
  }
}

}  // namespace

std::vector<std::string> scanWarnings(const HeightMap& scan) {
  std::vector<std::string> lines;
  checkPitch("pitch_x", scan.pitchX(), lines);
  checkPitch("pitch_y", scan.pitchY(), lines);

  HeightStatistics statistics;
  try {
    statistics = heightStatistics(scan);
  } catch (const SurfaceError&) {
    return lines;  // no valid pixel: the prediction says so
  }
  const double width = std::max(scan.cols() * scan.pitchX(), scan.rows() * scan.pitchY());
  const double range = statistics.max - statistics.min;
  if (range > width) {
    lines.push_back("heights range over " + metres(range) + ", more than the scan's width of " + metres(width) +
                    ": probably heights in nm, um or counts taken for metres (scan/height_scale), or damaged data");
  }
  const double largest = std::max(std::abs(statistics.min), std::abs(statistics.max));
  const double spacing = std::nextafter(static_cast<float>(largest), std::numeric_limits<float>::infinity()) -
                         static_cast<double>(static_cast<float>(largest));
  if (largest > 0.0 && spacing > kSpacingShare * statistics.rms_height && isSinglePrecision(scan.heights())) {
    lines.push_back("float32 heights near " + metres(largest) + " are spaced by " + metres(spacing) +
                    ", over a tenth of their rms height " + metres(statistics.rms_height) +
                    ": probably a stage offset; subtract it in double precision before narrowing");
  }
  return lines;
}

}  // namespace mems_stiction
