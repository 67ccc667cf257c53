#include "mems_stiction/preprocess/fill_holes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Sparse>
#include <opencv2/imgproc.hpp>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/height_map/validity.hpp"

namespace mems_stiction {
namespace {

constexpr double kMembraneShare = 1e-9;

/// One squared difference of the energy: (sum of factor x height)^2.
struct Difference {
  struct Term {
    int row, col;  ///< from the anchor pixel
    double factor;
  };
  std::vector<Term> terms;
};

/// All differences that are anchored at one pixel. Lengths are in units of the smaller pitch.
std::vector<Difference> differences(double pitch_x, double pitch_y) {
  const double unit = std::min(pitch_x, pitch_y);
  const double x = unit / pitch_x;
  const double y = unit / pitch_y;
  const double twist = std::sqrt(2.0) * x * y;
  const double membrane = std::sqrt(kMembraneShare);
  return {
      {{{0, 0, x * x}, {0, 1, -2.0 * x * x}, {0, 2, x * x}}},
      {{{0, 0, y * y}, {1, 0, -2.0 * y * y}, {2, 0, y * y}}},
      {{{0, 0, twist}, {0, 1, -twist}, {1, 0, -twist}, {1, 1, twist}}},
      {{{0, 0, membrane * x}, {0, 1, -membrane * x}}},
      {{{0, 0, membrane * y}, {1, 0, -membrane * y}}},
  };
}

/// The normal equations of the plate, gathered difference by difference.
class Plate {
 public:
  Plate(const cv::Mat& heights, const cv::Mat& numbers, int unknowns, double origin)
      : heights_(heights), numbers_(numbers), right_(Eigen::VectorXd::Zero(unknowns)), origin_(origin) {}

  void add(int row, int col, const Difference& difference) {
    const cv::Rect frame(0, 0, heights_.cols, heights_.rows);
    std::vector<std::pair<int, double>> unknown;
    double known = 0.0;
    for (const Difference::Term& term : difference.terms) {
      const cv::Point at(col + term.col, row + term.row);
      if (!frame.contains(at)) return;
      const int number = numbers_.at<int>(at);
      if (number >= 0) {
        unknown.emplace_back(number, term.factor);
      } else {
        known += term.factor * (heights_.at<double>(at) - origin_);
      }
    }
    if (unknown.empty() || std::isnan(known)) return;
    for (const auto& [number, factor] : unknown) {
      right_[number] -= factor * known;
      for (const auto& [other, other_factor] : unknown) triplets_.emplace_back(number, other, factor * other_factor);
    }
  }

  Eigen::VectorXd solve() const {
    Eigen::SparseMatrix<double> normal(right_.size(), right_.size());
    normal.setFromTriplets(triplets_.begin(), triplets_.end());
    normal.makeCompressed();
    // Not Eigen's Cholesky for sparse matrices: before version 3.4 it is not under the MPL.
    Eigen::SparseLU<Eigen::SparseMatrix<double>> factorization;
    factorization.isSymmetric(true);
    factorization.setPivotThreshold(0.0);  // positive definite
    factorization.compute(normal);
    if (factorization.info() != Eigen::Success) {
      throw SurfaceError("missing pixels cannot be filled: no valid neighbor");
    }
    return factorization.solve(right_);
  }

 private:
  const cv::Mat& heights_;
  const cv::Mat& numbers_;
  Eigen::VectorXd right_;
  double origin_;
  std::vector<Eigen::Triplet<double>> triplets_;
};

}  // namespace

void FillOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.flag(prefix + "/enabled", enabled,
               "give missing pixels the height of a thin plate through their surroundings");
  visitor.number(prefix + "/max_fraction", max_fraction, "", Range::within(0.0, 1.0),
                 "share of missing pixels beyond which a scan is refused");
  visitor.integer(prefix + "/max_hole", max_hole, Range::within(1, 1000000),
                  "holes of more pixels stay invalid: no contact, no part in any sum");
}

void fillPixels(cv::Mat& heights, const cv::Mat& wanted, double pitch_x, double pitch_y) {
  std::vector<cv::Point> pixels;
  cv::findNonZero(wanted, pixels);
  if (pixels.empty()) return;
  cv::Mat numbers(heights.size(), CV_32SC1, cv::Scalar(-1));
  for (std::size_t index = 0; index < pixels.size(); ++index) numbers.at<int>(pixels[index]) = static_cast<int>(index);

  const double origin = heightStatistics(HeightMap(heights, pitch_x, pitch_y)).mean;
  Plate plate(heights, numbers, static_cast<int>(pixels.size()), origin);
  // Anchors from which a difference can reach a wanted pixel: two rows above and two columns left of it.
  cv::Mat anchors;
  cv::dilate(wanted, anchors, cv::Mat::ones(3, 3, CV_8UC1), cv::Point(0, 0));
  std::vector<cv::Point> anchor_pixels;
  cv::findNonZero(anchors, anchor_pixels);
  const std::vector<Difference> all = differences(pitch_x, pitch_y);
  for (const cv::Point& anchor : anchor_pixels) {
    for (const Difference& difference : all) plate.add(anchor.y, anchor.x, difference);
  }
  const Eigen::VectorXd filled = plate.solve();
  for (std::size_t index = 0; index < pixels.size(); ++index) {
    heights.at<double>(pixels[index]) = origin + filled[static_cast<Eigen::Index>(index)];
  }
}

HeightMap withFilledHoles(const HeightMap& surface, const FillOptions& options) {
  cv::Mat heights = ownedHeights(surface);
  const double fraction = invalidFraction(surface);
  if (fraction >= 1.0) throw SurfaceError("the height map has no valid pixel");
  if (fraction > options.max_fraction) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", fraction);
    throw SurfaceError(std::string("a fraction of ") + text + " of the pixels is missing, more than the limit of " +
                       numberText(options.max_fraction) + " (preprocessing/fill/max_fraction)");
  }
  const cv::Mat missing = ~validMask(heights);
  cv::Mat labels;
  cv::Mat statistics;
  cv::Mat centroids;
  const int holes = cv::connectedComponentsWithStats(missing, labels, statistics, centroids, 4, CV_32S);
  std::vector<bool> small(static_cast<std::size_t>(holes), false);
  for (int hole = 1; hole < holes; ++hole) {
    small[static_cast<std::size_t>(hole)] = statistics.at<int>(hole, cv::CC_STAT_AREA) <= options.max_hole;
  }
  cv::Mat wanted(heights.size(), CV_8UC1, cv::Scalar(0));
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      if (small[static_cast<std::size_t>(labels.at<int>(row, col))]) wanted.at<uchar>(row, col) = 255;
    }
  }
  fillPixels(heights, wanted, surface.pitchX(), surface.pitchY());
  return {heights, surface.pitchX(), surface.pitchY()};
}

}  // namespace mems_stiction
