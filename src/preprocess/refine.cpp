#include "preprocess/refine.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Sparse>
#include <opencv2/imgproc.hpp>

#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/constants.hpp"
#include "preprocess/fill_holes.hpp"

namespace mems_stiction {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Weights = Eigen::SparseMatrix<double, Eigen::RowMajor>;

constexpr double kMaxPixels = 536870912.0;  // 2^29: 4 GiB of heights

int reach(Interpolation interpolation) { return interpolation == Interpolation::kCubic ? 2 : 3; }

double kernel(Interpolation interpolation, double distance) {
  const double t = std::fabs(distance);
  if (interpolation == Interpolation::kCubic) {
    if (t < 1.0) return (1.5 * t - 2.5) * t * t + 1.0;
    if (t < 2.0) return ((-0.5 * t + 2.5) * t - 4.0) * t + 2.0;
    return 0.0;
  }
  if (t < 1e-12) return 1.0;
  if (t >= 3.0) return 0.0;
  return 3.0 * std::sin(kPi * t) * std::sin(kPi * t / 3.0) / (kPi * kPi * t * t);
}

/// Refined pixels of one axis as sums of the original ones.
Weights axisWeights(int count, int factor, Interpolation interpolation) {
  std::vector<Eigen::Triplet<double>> triplets;
  for (int fine = 0; fine < count * factor; ++fine) {
    const double position = (fine + 0.5) / factor - 0.5;
    const int first = static_cast<int>(std::floor(position)) - reach(interpolation) + 1;
    double sum = 0.0;
    for (int tap = first; tap < first + 2 * reach(interpolation); ++tap)
      sum += kernel(interpolation, position - tap);
    for (int tap = first; tap < first + 2 * reach(interpolation); ++tap) {
      const double weight = kernel(interpolation, position - tap) / sum;
      if (count == 1) {
        triplets.emplace_back(fine, 0, weight);
        continue;
      }
      // Beyond the border: twice the border pixel less its mirror image, which stays within the
      // frame if it has one.
      const int border = tap < 0 ? 0 : count - 1;
      if (tap >= 0 && tap < count) {
        triplets.emplace_back(fine, tap, weight);
      } else {
        const int mirror = std::max(0, std::min(count - 1, 2 * border - tap));
        const double stretch = static_cast<double>(tap - border) / (border - mirror);
        triplets.emplace_back(fine, border, weight * (1.0 + stretch));
        triplets.emplace_back(fine, mirror, -weight * stretch);
      }
    }
  }
  Weights weights(count * factor, count);
  weights.setFromTriplets(triplets.begin(), triplets.end());
  return weights;
}

}  // namespace

void RefineOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.integer(prefix + "/factor", factor, Range::within(1, 16),
                  "pixels per original pixel along x and y; 1 = off");
  visitor.enumeration(prefix + "/interpolation", interpolation,
                      {{"cubic", Interpolation::kCubic}, {"lanczos", Interpolation::kLanczos}},
                      "how heights between pixels are found: cubic convolution, or a windowed sinc "
                      "over six pixels");
}

HeightMap refined(const HeightMap& surface, const RefineOptions& options) {
  const double mean = heightStatistics(surface).mean;
  cv::Mat heights = ownedHeights(surface);
  if (options.factor == 1) return {heights, surface.pitchX(), surface.pitchY()};
  if (static_cast<double>(heights.total()) * options.factor * options.factor > kMaxPixels) {
    throw SurfaceError("refining " + std::to_string(heights.cols) + " x " +
                       std::to_string(heights.rows) + " pixels by " +
                       std::to_string(options.factor) + " exceeds the limit of 2^29 pixels");
  }
  heights -= mean;

  // Only pixels that a weight can reach from a valid one need a height; the rest is masked
  // afterwards.
  const cv::Mat valid = validMask(heights);
  const int side = 2 * reach(options.interpolation) + 1;
  cv::Mat reached;
  cv::dilate(valid, reached, cv::Mat::ones(side, side, CV_8UC1));
  fillPixels(heights, reached & ~valid, surface.pitchX(), surface.pitchY());
  heights.setTo(0.0, ~reached);

  const Weights along_x = axisWeights(heights.cols, options.factor, options.interpolation);
  const Weights along_y = axisWeights(heights.rows, options.factor, options.interpolation);
  cv::Mat result(heights.rows * options.factor, heights.cols * options.factor, CV_64FC1);
  const Eigen::Map<const RowMajor> coarse(heights.ptr<double>(), heights.rows, heights.cols);
  Eigen::Map<RowMajor> fine(result.ptr<double>(), result.rows, result.cols);
  const RowMajor stretched = (along_x * coarse.transpose()).transpose();
  fine.noalias() = along_y * stretched;

  cv::Mat fine_valid;
  cv::resize(valid, fine_valid, result.size(), 0.0, 0.0, cv::INTER_NEAREST);
  result += mean;
  result.setTo(std::numeric_limits<double>::quiet_NaN(), ~fine_valid);
  return {result, surface.pitchX() / options.factor, surface.pitchY() / options.factor};
}

}  // namespace mems_stiction
