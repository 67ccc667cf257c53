#include "height_map/scan_sanity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "errors/short_number.hpp"
#include "height_map/unmeasured.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr double kUsualPitch[] = {
    1e-12, 1e-3};  // [m]: far below an atom; above any pixel that resolves asperities
constexpr double kLikelyPitch[] = {
    5e-10, 5e-7};  // [m], of a probe: a slip by thousands is one away from here
constexpr double kLongestPixel = 100.0;  // [-]: quick scans of few lines
constexpr double kSteepest = 10.0;       // [-], rms: gratings of steep steps
constexpr double kSmoothest = 1e-4;      // [-], rms at a pitch of 1 um
constexpr double kMicrometre = 1e-6;     // [m]
constexpr int kSlopeRows = 256;          // that the slope is taken from
constexpr double kThousand = 1e3;        // from unit to unit
constexpr double kSpacingShare =
    0.1;  // of the rms height: quantisation then adds 0.04 % to its square

std::string metres(double value) { return shortNumber(value) + " m"; }

/// Variance of the slopes along one direction, in one pass: a tilt as a whole is no roughness.
struct Slopes {
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;

  void add(double slope) {
    if (!std::isfinite(slope)) return;  // a pixel of the two was not measured
    sum += slope;
    squares += slope * slope;
    ++count;
  }
  /// NaN without two neighbours that were measured.
  double variance() const { return std::max(0.0, squares - sum * sum / count) / count; }
};

/// Rms slope between neighbours, about the mean slope [-]; of large scans from evenly spaced rows.
template <typename Scalar>
double rmsSlope(const HeightMap& scan) {
  const cv::Mat& heights = scan.heights();
  const int stride = std::max(1, heights.rows / kSlopeRows);
  Slopes along_x;
  Slopes along_y;
  for (int row = 0; row + 1 < heights.rows; row += stride) {
    const Scalar* line = heights.ptr<Scalar>(row);
    const Scalar* below = heights.ptr<Scalar>(row + 1);
    for (int col = 0; col + 1 < heights.cols; ++col) {
      const double height = line[col];
      along_x.add((line[col + 1] - height) / scan.pitchX());
      along_y.add((below[col] - height) / scan.pitchY());
    }
  }
  return std::sqrt(along_x.variance() + along_y.variance());
}

/// Below it lie the noise of every instrument (fine pixels) and asperities that are flatter than
/// any (coarse ones: radii of centimetres).
double smoothestSlope(double pitch) {
  const double pixel = pitch / kMicrometre;
  return kSmoothest * std::max(1.0 / std::sqrt(pixel), pixel);
}

/// Thousands that a pitch is likely to be too large (below 1) or too small by; 1 if it is a likely
/// one.
double pitchSlip(double pitch) {
  double factor = 1.0;
  while (pitch * factor > kLikelyPitch[1]) factor /= kThousand;
  while (pitch * factor < kLikelyPitch[0]) factor *= kThousand;
  return factor;
}

std::string meant(double pitch) { return "was " + metres(pitch * pitchSlip(pitch)) + " meant?"; }

/// @return whether a line was added
bool checkPitch(const std::string& key, double pitch, std::vector<std::string>& lines) {
  if (pitch > kUsualPitch[1]) {
    lines.push_back(key + " " + metres(pitch) +
                    " is above 1 mm: probably nm or um given as metres; " + meant(pitch));
  } else if (pitch < kUsualPitch[0]) {
    lines.push_back(key + " " + metres(pitch) +
                    " is below 1 pm: probably converted to metres twice; " + meant(pitch));
  } else {
    return false;
  }
  return true;
}

bool checkPitches(const HeightMap& scan, ScanRemarks& remarks) {
  const bool is_x_odd = checkPitch("pitch_x", scan.pitchX(), remarks.implausible);
  const bool is_y_odd = checkPitch("pitch_y", scan.pitchY(), remarks.implausible);
  if (is_x_odd || is_y_odd) return true;
  const double longer = std::max(scan.pitchX(), scan.pitchY());
  const double shorter = std::min(scan.pitchX(), scan.pitchY());
  if (longer / shorter <= kLongestPixel) return false;
  const double odd = pitchSlip(longer) != 1.0 ? longer : shorter;
  remarks.unusual.push_back(
      "pitch_x " + metres(scan.pitchX()) + " and pitch_y " + metres(scan.pitchY()) + ": pixels " +
      shortNumber(longer / shorter) + " times as long as wide are unusual (up to " +
      shortNumber(kLongestPixel) + "); instead of " + metres(odd) + " " + meant(odd));
  return true;
}

/// What may have slipped where heights are too large (factor < 1) or too small for their pitch:
/// either of them.
std::string heightSlip(double pitch, double factor) {
  const double pitch_factor = pitchSlip(pitch);
  const bool may_be_pitch = (pitch_factor > 1.0) == (factor < 1.0) && pitch_factor != 1.0;
  const std::string heights =
      factor < 1.0 ? "heights in nm or um or counts taken for metres (scan/height_scale)"
                   : "heights that should be " + shortNumber(factor) +
                         " times as large (scan/height_scale on heights in metres)";
  if (!may_be_pitch) return "probably " + heights;
  return "probably the pitch of " + metres(pitch) + " (" + meant(pitch) + ") or " + heights;
}

/// One line at most: a wrong unit of heights or pitch shows in range and slope alike.
/// - @p is_probe whose range is judged by its slope
void checkHeights(const HeightMap& scan, const HeightStatistics& statistics, bool is_probe,
                  ScanRemarks& remarks) {
  const double pitch = std::sqrt(scan.pitchX() * scan.pitchY());
  const double width = std::max(scan.cols() * scan.pitchX(), scan.rows() * scan.pitchY());
  const double range = statistics.max - statistics.min;
  const double slope =
      scan.heights().depth() == CV_32F ? rmsSlope<float>(scan) : rmsSlope<double>(scan);
  if (range > width) {
    const bool is_shape = is_probe && slope <= kSteepest;
    (is_shape ? remarks.unusual : remarks.implausible)
        .push_back("heights range over " + metres(range) + ": more than the scan's width of " +
                   metres(width) + "; " + heightSlip(pitch, 1.0 / kThousand) + " or damaged data");
    return;
  }
  const double smoothest = smoothestSlope(pitch);
  if (std::isnan(slope) || (smoothest <= slope && slope <= kSteepest)) return;
  double factor = slope > kSteepest ? 1.0 / kThousand : kThousand;
  while (slope > 0.0 && slope * factor < smoothest) factor *= kThousand;
  std::vector<std::string>& lines = slope > kSteepest ? remarks.implausible : remarks.unusual;
  lines.push_back("rms slope " + shortNumber(slope) + " of heights that range over " +
                  metres(range) + " is unusual (at a pitch of " + metres(pitch) + " it is " +
                  shortNumber(smoothest) + " to " + shortNumber(kSteepest) +
                  "): " + heightSlip(pitch, factor));
}

/// @return whether a line was added
bool checkContent(const HeightMap& scan, const HeightStatistics& statistics,
                  std::vector<std::string>& lines) {
  constexpr const char* kSaysNothing = " says nothing about roughness: ";
  if (std::min(scan.rows(), scan.cols()) < kFewestPixelsOfASide) {
    lines.push_back("a frame of " + std::to_string(scan.cols()) + " x " +
                    std::to_string(scan.rows()) + " pixels" + kSaysNothing +
                    "it has no room for a contact and its surroundings (" +
                    std::to_string(kFewestPixelsOfASide) + " x " +
                    std::to_string(kFewestPixelsOfASide) + "); was the scan cut off?");
  } else if (statistics.max == statistics.min) {
    lines.push_back("a frame whose every height is " + metres(statistics.min) + kSaysNothing +
                    "was nothing measured or another channel taken?");
  } else {
    return false;
  }
  return true;
}

void checkLines(const HeightMap& scan, std::vector<std::string>& lines) {
  const MissingLines missing = missingLines(scan);
  const auto say = [&lines](int count, int all, const char* what) {
    if (count == 0 || count == all) return;
    lines.push_back(std::to_string(count) + " of " + std::to_string(all) + " " + what +
                    " were not measured: the scan was stopped or lost lines (one value beside "
                    "rough ones is no height)");
  };
  say(missing.rows, scan.rows(), "rows");
  say(missing.cols, scan.cols(), "columns");
}

}  // namespace

bool isSinglePrecision(const cv::Mat& heights) {
  if (heights.depth() == CV_32F) return true;
  for (int row = 0; row < heights.rows; ++row) {
    const double* line = heights.ptr<double>(row);
    for (int col = 0; col < heights.cols; ++col) {
      if (std::isfinite(line[col]) &&
          static_cast<double>(static_cast<float>(line[col])) != line[col])
        return false;
    }
  }
  return true;
}

ScanRemarks scanRemarks(const HeightMap& scan, bool is_probe) {
  ScanRemarks remarks;
  std::vector<std::string>& lines = remarks.unusual;
  const bool is_pitch_odd = checkPitches(scan, remarks);
  checkLines(scan, lines);
  HeightStatistics statistics;
  try {
    statistics = heightStatistics(scan);
  } catch (const SurfaceError&) {
    return remarks;  // no valid pixel: the prediction says so
  }
  if (checkContent(scan, statistics, lines)) return remarks;
  if (!is_pitch_odd) checkHeights(scan, statistics, is_probe, remarks);
  const double largest = std::max(std::abs(statistics.min), std::abs(statistics.max));
  const double spacing =
      std::nextafter(static_cast<float>(largest), std::numeric_limits<float>::infinity()) -
      static_cast<double>(static_cast<float>(largest));
  if (largest > 0.0 && spacing > kSpacingShare * statistics.rms_height &&
      isSinglePrecision(scan.heights())) {
    lines.push_back("float32 heights near " + metres(largest) + " are spaced by " +
                    metres(spacing) + ": over a tenth of their rms height " +
                    metres(statistics.rms_height) +
                    "; probably a stage offset: subtract it in double precision before narrowing");
  }
  return remarks;
}

std::vector<std::string> ScanRemarks::all() const {
  std::vector<std::string> lines = implausible;
  lines.insert(lines.end(), unusual.begin(), unusual.end());
  return lines;
}

std::vector<std::string> scanWarnings(const HeightMap& scan) { return scanRemarks(scan).all(); }

}  // namespace mems_stiction
