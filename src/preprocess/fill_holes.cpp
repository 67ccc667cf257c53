#include "preprocess/fill_holes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Sparse>
#include <opencv2/imgproc.hpp>

#include "errors/plain_format.hpp"
#include "mems_stiction/errors/errors.hpp"

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
      : heights_(heights),
        numbers_(numbers),
        right_(Eigen::VectorXd::Zero(unknowns)),
        origin_(origin) {}

  void add(int row, int col, const Difference& difference) {
    const cv::Rect frame(0, 0, heights_.cols, heights_.rows);
    std::array<std::pair<int, double>, 4> unknown;  // no difference has more terms
    std::size_t count = 0;
    double known = 0.0;
    for (const Difference::Term& term : difference.terms) {
      const cv::Point at(col + term.col, row + term.row);
      if (!frame.contains(at)) return;
      const int number = numbers_.at<int>(at);
      if (number >= 0) {
        unknown[count++] = {number, term.factor};
      } else {
        known += term.factor * (heights_.at<double>(at) - origin_);
      }
    }
    if (std::isnan(known)) return;
    for (std::size_t i = 0; i < count; ++i) {
      const auto [number, factor] = unknown[i];
      right_[number] -= factor * known;
      for (std::size_t j = 0; j < count; ++j) {
        triplets_.emplace_back(number, unknown[j].first, factor * unknown[j].second);
      }
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
      throw SurfaceError("missing pixels cannot be filled: no valid neighbour");
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

/// The pixels from which a difference can reach one of these: up to two rows above and two columns
/// left of it. In the order of the frame, each once.
std::vector<cv::Point> anchorsOf(const std::vector<cv::Point>& pixels) {
  std::vector<cv::Point> anchors;
  for (const cv::Point& pixel : pixels) {
    for (int row = std::max(0, pixel.y - 2); row <= pixel.y; ++row) {
      for (int col = std::max(0, pixel.x - 2); col <= pixel.x; ++col)
        anchors.emplace_back(col, row);
    }
  }
  const auto comes_before = [](const cv::Point& a, const cv::Point& b) {
    return a.y < b.y || (a.y == b.y && a.x < b.x);
  };
  std::sort(anchors.begin(), anchors.end(), comes_before);
  anchors.erase(std::unique(anchors.begin(), anchors.end()), anchors.end());
  return anchors;
}

/// @param pixels that get a height; the other missing ones stay NaN
void fillAll(cv::Mat& heights, const std::vector<cv::Point>& pixels, double pitch_x,
             double pitch_y) {
  if (pixels.empty()) return;
  cv::Mat numbers(heights.size(), CV_32SC1, cv::Scalar(-1));
  for (std::size_t index = 0; index < pixels.size(); ++index)
    numbers.at<int>(pixels[index]) = static_cast<int>(index);

  CleaningMemory memory;
  const double origin = meansOf(heights, memory).height;
  Plate plate(heights, numbers, static_cast<int>(pixels.size()), origin);
  const std::vector<Difference> all = differences(pitch_x, pitch_y);
  for (const cv::Point& anchor : anchorsOf(pixels)) {
    for (const Difference& difference : all) plate.add(anchor.y, anchor.x, difference);
  }
  const Eigen::VectorXd filled = plate.solve();
  for (std::size_t index = 0; index < pixels.size(); ++index) {
    heights.at<double>(pixels[index]) = origin + filled[static_cast<Eigen::Index>(index)];
  }
}

std::vector<cv::Point> missingPixels(const cv::Mat& heights, const cv::Mat& outside) {
  std::vector<cv::Point> missing;
  for (int row = 0; row < heights.rows; ++row) {
    const double* line = heights.ptr<double>(row);
    if (countAbove(0.0, line, static_cast<std::size_t>(heights.cols)).invalid == 0) continue;
    for (int col = 0; col < heights.cols; ++col) {
      if (std::isnan(line[col]) && (outside.empty() || outside.at<uchar>(row, col) == 0))
        missing.emplace_back(col, row);
    }
  }
  return missing;
}

/// Those of the missing pixels, in their order, that belong to a 4-connected hole of so many pixels
/// or fewer.
std::vector<cv::Point> pixelsOfSmallHoles(const cv::Mat& heights,
                                          const std::vector<cv::Point>& missing,
                                          const cv::Mat& outside, int max_hole) {
  enum : uchar { kUnseen, kSeen, kSmall };
  cv::Mat state(heights.size(), CV_8UC1, cv::Scalar(kUnseen));
  if (!outside.empty()) state.setTo(static_cast<int>(kSeen), outside);
  const cv::Rect frame(0, 0, heights.cols, heights.rows);
  std::vector<cv::Point> hole;
  for (const cv::Point& first : missing) {
    if (state.at<uchar>(first) != kUnseen) continue;
    state.at<uchar>(first) = kSeen;
    hole.assign(1, first);
    for (std::size_t next = 0; next < hole.size(); ++next) {
      for (const cv::Point& step :
           {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
        const cv::Point neighbour = hole[next] + step;
        if (!frame.contains(neighbour) || state.at<uchar>(neighbour) != kUnseen) continue;
        if (!std::isnan(heights.at<double>(neighbour))) continue;
        state.at<uchar>(neighbour) = kSeen;
        hole.push_back(neighbour);
      }
    }
    if (hole.size() > static_cast<std::size_t>(max_hole)) continue;
    for (const cv::Point& pixel : hole) state.at<uchar>(pixel) = kSmall;
  }
  std::vector<cv::Point> small;
  std::copy_if(missing.begin(), missing.end(), std::back_inserter(small),
               [&](const cv::Point& pixel) { return state.at<uchar>(pixel) == kSmall; });
  return small;
}

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
  fillAll(heights, pixels, pitch_x, pitch_y);
}

HeightChange fillHoles(WorkingSurface& surface, const FillOptions& options,
                       const cv::Mat& outside) {
  cv::Mat& heights = surface.heights;
  const std::vector<cv::Point> missing = missingPixels(heights, outside);
  const long long left_out = outside.empty() ? 0 : cv::countNonZero(outside);
  HeightChange change;
  change.invalid_pixels = left_out;
  if (missing.empty()) return change;
  const double fraction = static_cast<double>(missing.size()) /
                          static_cast<double>(static_cast<long long>(heights.total()) - left_out);
  if (fraction >= 1.0) throw SurfaceError("the height map has no valid pixel");
  if (fraction > options.max_fraction) {
    throw SurfaceError(plainFormat("a fraction of %.4g", fraction) +
                       " of the pixels is missing, more than the limit of " +
                       numberText(options.max_fraction) + " (preprocessing/fill/max_fraction)");
  }
  const std::vector<cv::Point> wanted =
      pixelsOfSmallHoles(heights, missing, outside, options.max_hole);
  fillAll(heights, wanted, surface.pitch_x, surface.pitch_y);
  change.changed_pixels = static_cast<long long>(wanted.size());
  change.invalid_pixels += static_cast<long long>(missing.size() - wanted.size());
  return change;
}

}  // namespace mems_stiction
