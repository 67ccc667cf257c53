#include "roughness/filled_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "errors/short_number.hpp"
#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "preprocess/fill_holes.hpp"
#include "preprocess/level.hpp"

namespace mems_stiction {
namespace {

/// How far the plate goes on from measured pixels [pixels].
constexpr float kNearMeasured = 3.0F;
/// More pixels are too many for one plate: all of them come from the coarser surface.
constexpr int kMostOfPlate = 300000;
/// A pixel at a distance d from a measured one knows waves of fewer radians per pixel than this
/// over d: the plate through the neighbours of one pixel gives three quarters of the height of
/// waves of four pixels, and a fifth of those of two.
constexpr double kKnownRadians = 2.0;
/// Steps of distances [pixels].
constexpr double kDistanceStep = 0.25;
/// From this share of missing pixels on, what a spectrum says is said to be uncertain [-].
constexpr double kMuchMissing = 0.2;

/// Means of the measured pixels of squares of two by two.
cv::Mat halved(const cv::Mat& heights) {
  cv::Mat half((heights.rows + 1) / 2, (heights.cols + 1) / 2, CV_64FC1);
  for (int row = 0; row < half.rows; ++row) {
    for (int col = 0; col < half.cols; ++col) {
      double sum = 0.0;
      int count = 0;
      for (int y = 2 * row; y < std::min(2 * row + 2, heights.rows); ++y) {
        for (int x = 2 * col; x < std::min(2 * col + 2, heights.cols); ++x) {
          const double height = heights.at<double>(y, x);
          if (std::isnan(height)) continue;
          sum += height;
          ++count;
        }
      }
      half.at<double>(row, col) =
          count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return half;
}

cv::Mat distancesTo(const cv::Mat& valid) {
  cv::Mat distances;
  cv::distanceTransform(~valid, distances, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  return distances;
}

/// - @p heights CV_64FC1, at least one of them measured; NaN becomes a height
void fillInPlace(cv::Mat& heights, double pitch_x, double pitch_y) {
  const cv::Mat missing = ~validMask(heights);
  const int count = cv::countNonZero(missing);
  if (count == 0) return;
  cv::Mat inside = distancesTo(~missing) > kNearMeasured;
  if (count - cv::countNonZero(inside) > kMostOfPlate) inside = missing;
  if (cv::countNonZero(inside) > 0) {
    cv::Mat coarse = halved(heights);
    fillInPlace(coarse, 2.0 * pitch_x, 2.0 * pitch_y);
    cv::Mat fine;
    cv::resize(coarse, fine, coarse.size() * 2, 0.0, 0.0, cv::INTER_CUBIC);
    fine(cv::Rect(cv::Point(), heights.size())).copyTo(heights, inside);
  }
  fillPixels(heights, missing & ~inside, pitch_x, pitch_y);
}

}  // namespace

FilledSurface filledSurface(const HeightMap& surface) {
  const HeightMap measured = surface.asDouble();
  const cv::Mat valid = validMask(measured.heights());
  const int count = cv::countNonZero(valid);
  if (count == static_cast<int>(valid.total())) return {measured, {}};
  if (count == 0) throw SurfaceError("the height map has no valid pixel");
  const cv::Rect frame = cv::boundingRect(valid);
  const double pitch_x = surface.pitchX();
  const double pitch_y = surface.pitchY();
  cv::Mat heights = ownedHeights(measured)(frame).clone();
  FilledSurface filled;
  if (cv::countNonZero(valid(frame)) < frame.area()) {
    // a tilt goes on through holes as it is
    WorkingSurface without_tilt(HeightMap(heights, pitch_x, pitch_y));
    const Plane plane = leastSquaresPlane(without_tilt);
    level(without_tilt);
    fillInPlace(without_tilt.heights, pitch_x, pitch_y);
    filled.distances = distancesTo(valid(frame));
    for (int row = 0; row < heights.rows; ++row) {
      const auto* distance = filled.distances.ptr<float>(row);
      for (int col = 0; col < heights.cols; ++col) {
        if (distance[col] == 0.0F) continue;
        heights.at<double>(row, col) =
            without_tilt.heights.at<double>(row, col) + plane.height(col * pitch_x, row * pitch_y);
      }
    }
  }
  filled.surface = HeightMap(heights, pitch_x, pitch_y);
  return filled;
}

std::string filledSentence(const HeightMap& surface) {
  const double share = invalidFraction(surface);
  if (share == 0.0) return "";
  const auto total = static_cast<double>(surface.heights().total());
  const double missing = std::round(share * total);
  const std::string text =
      shortNumber(missing, 6) + " of " + shortNumber(total, 9) + " pixels are missing (" +
      shortNumber(100.0 * share, 2) +
      " %): the spectrum takes them as a plate through their surroundings, without waves that are "
      "shorter than the holes";
  return share < kMuchMissing ? text : text + "; so much is missing that it may be out by as much";
}

KnownShare::KnownShare(const cv::Mat& distances, const std::vector<double>& weights_x,
                       const std::vector<double>& weights_y) {
  if (distances.empty()) return;
  for (int row = 0; row < distances.rows; ++row) {
    const auto* line = distances.ptr<float>(row);
    for (int col = 0; col < distances.cols; ++col) {
      const double weight =
          weights_y[static_cast<std::size_t>(row)] * weights_x[static_cast<std::size_t>(col)];
      const auto step =
          static_cast<std::size_t>(std::ceil(static_cast<double>(line[col]) / kDistanceStep));
      if (step >= shares_.size()) shares_.resize(step + 1, 0.0);
      shares_[step] += weight * weight;
    }
  }
  for (std::size_t i = 1; i < shares_.size(); ++i) shares_[i] += shares_[i - 1];
  const double all = shares_.back();
  for (double& share : shares_) share /= all;
}

double KnownShare::of(double wave_number) const {
  if (shares_.empty()) return 1.0;
  const double step = kKnownRadians / (std::abs(wave_number) * kDistanceStep);
  if (!(step < static_cast<double>(shares_.size() - 1))) return 1.0;
  return shares_[static_cast<std::size_t>(step)];
}

}  // namespace mems_stiction
