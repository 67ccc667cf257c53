#include "surface/alignment.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr double kLargestOffset = 1e3;  // [m]
constexpr double kFarthestPixel =
    1e15;  // whole numbers beyond it are not exact, and no surface repeats so often

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

void check(const SurfacePose& pose) {
  std::vector<std::string> violations = rangeViolations(pose);
  if (!violations.empty()) throw OptionsError(std::move(violations));
}

double fromMiddle(int index, int count, double pitch) {
  return (index - 0.5 * (count - 1)) * pitch;
}

/// Position in pixels; a rounding error beside a pixel is that pixel, so that grids that coincide
/// give back its bits.
double snapped(double position) {
  const double nearest = std::round(position);
  return std::fabs(position - nearest) < 1e-9 ? nearest : position;
}

/// Keys' cubic convolution, a = -1/2, for the pixels floor(position) - 1 .. + 2.
std::array<double, 4> cubicWeights(double t) {
  return {((-0.5 * t + 1.0) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1.0,
          ((-1.5 * t + 2.0) * t + 0.5) * t, (0.5 * t - 0.5) * t * t};
}

std::array<double, 4> linearWeights(double t) { return {0.0, 1.0 - t, t, 0.0}; }

class Sampler {
 public:
  Sampler(const HeightMap& surface, Beyond beyond)
      : heights_(ownedHeights(surface)), beyond_(beyond) {}

  double at(double col, double row) const {
    if (!(std::fabs(col) < kFarthestPixel && std::fabs(row) < kFarthestPixel)) return kMissing;
    if (std::isnan(pixel(static_cast<long long>(std::floor(col + 0.5)),
                         static_cast<long long>(std::floor(row + 0.5))))) {
      return kMissing;
    }
    const double left = std::floor(col);
    const double top = std::floor(row);
    const double cubic =
        weighted(left, top, cubicWeights(col - left), cubicWeights(row - top), true);
    // Beside a missing pixel: linear, whose weights are all positive, over what is there.
    return std::isnan(cubic)
               ? weighted(left, top, linearWeights(col - left), linearWeights(row - top), false)
               : cubic;
  }

 private:
  /// Sum over 4 x 4 pixels; NaN if `whole` and one of them that counts is missing.
  double weighted(double left, double top, const std::array<double, 4>& weights_x,
                  const std::array<double, 4>& weights_y, bool whole) const {
    double sum = 0.0;
    double weights = 0.0;
    for (int down = 0; down < 4; ++down) {
      for (int right = 0; right < 4; ++right) {
        const double weight =
            weights_y[static_cast<std::size_t>(down)] * weights_x[static_cast<std::size_t>(right)];
        if (weight == 0.0) continue;
        const double height =
            pixel(static_cast<long long>(left) + right - 1, static_cast<long long>(top) + down - 1);
        if (std::isnan(height)) {
          if (whole) return kMissing;
          continue;
        }
        sum += weight * height;
        weights += weight;
      }
    }
    return whole ? sum : sum / weights;
  }

  double pixel(long long col, long long row) const {
    if (beyond_ == Beyond::kPeriodic) {
      col = (col % heights_.cols + heights_.cols) % heights_.cols;
      row = (row % heights_.rows + heights_.rows) % heights_.rows;
    } else if (col < 0 || row < 0 || col >= heights_.cols || row >= heights_.rows) {
      return kMissing;
    }
    return heights_.at<double>(static_cast<int>(row), static_cast<int>(col));
  }

  cv::Mat heights_;
  Beyond beyond_;
};

}  // namespace

void SurfacePose::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.number(
      prefix + "/offset_x", offset_x, "m", Range::within(-kLargestOffset, kLargestOffset),
      "how far the middle of the counter-surface lies towards larger columns of the scan");
  visitor.number(prefix + "/offset_y", offset_y, "m",
                 Range::within(-kLargestOffset, kLargestOffset),
                 "how far the middle of the counter-surface lies towards larger rows of the scan");
  visitor.number(
      prefix + "/rotation", rotation, "rad", Range::any(),
      "angle from the scan's x axis (columns) to the counter-surface's, towards larger rows");
  visitor.number(prefix + "/tilt_x", tilt_x, "rad", Range::openWithin(-1.5, 1.5),
                 "tilt of the counter-surface; positive lifts its side of larger columns");
  visitor.number(prefix + "/tilt_y", tilt_y, "rad", Range::openWithin(-1.5, 1.5),
                 "tilt of the counter-surface; positive lifts its side of larger rows");
}

bool haveSameGrid(const HeightMap& a, const HeightMap& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a.pitchX() == b.pitchX() &&
         a.pitchY() == b.pitchY();
}

HeightMap alignedTo(const HeightMap& scan, const HeightMap& counter_surface,
                    const SurfacePose& pose, Beyond beyond) {
  check(pose);
  const Sampler sampler(counter_surface, beyond);
  const double cosine = std::cos(pose.rotation);
  const double sine = std::sin(pose.rotation);
  const double slope_x = std::tan(pose.tilt_x);
  const double slope_y = std::tan(pose.tilt_y);
  const double middle_col = 0.5 * (counter_surface.cols() - 1);
  const double middle_row = 0.5 * (counter_surface.rows() - 1);
  cv::Mat heights(scan.rows(), scan.cols(), CV_64FC1);
  for (int row = 0; row < scan.rows(); ++row) {
    double* line = heights.ptr<double>(row);
    const double y = fromMiddle(row, scan.rows(), scan.pitchY());
    for (int col = 0; col < scan.cols(); ++col) {
      const double x = fromMiddle(col, scan.cols(), scan.pitchX());
      const double from_x = x - pose.offset_x;
      const double from_y = y - pose.offset_y;
      const double position_x =
          (cosine * from_x + sine * from_y) / counter_surface.pitchX() + middle_col;
      const double position_y =
          (cosine * from_y - sine * from_x) / counter_surface.pitchY() + middle_row;
      line[col] =
          sampler.at(snapped(position_x), snapped(position_y)) + (x * slope_x + y * slope_y);
    }
  }
  if (cv::countNonZero(validMask(heights)) == 0) {
    throw SurfaceError("the counter-surface does not lie over the scan: offset " +
                       numberText(pose.offset_x) + ", " + numberText(pose.offset_y) +
                       " m leaves no cell in common");
  }
  return {heights, scan.pitchX(), scan.pitchY()};
}

HeightMap tiltedFlat(const HeightMap& scan, double tilt_x, double tilt_y) {
  SurfacePose pose;
  pose.tilt_x = tilt_x;
  pose.tilt_y = tilt_y;
  check(pose);
  const double slope_x = std::tan(tilt_x);
  const double slope_y = std::tan(tilt_y);
  cv::Mat heights(scan.rows(), scan.cols(), CV_64FC1);
  for (int row = 0; row < scan.rows(); ++row) {
    const double y = fromMiddle(row, scan.rows(), scan.pitchY());
    for (int col = 0; col < scan.cols(); ++col) {
      heights.at<double>(row, col) =
          fromMiddle(col, scan.cols(), scan.pitchX()) * slope_x + y * slope_y;
    }
  }
  return {heights, scan.pitchX(), scan.pitchY()};
}

}  // namespace mems_stiction
