#include "support/plain_preparation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include <Eigen/Dense>

#include "numeric/median.hpp"
#include "preprocess/spike_removal.hpp"
#include "preprocess/stage_offset.hpp"

namespace mems_stiction {
namespace plain {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> validOf(const cv::Mat1d& heights) {
  std::vector<double> valid;
  std::copy_if(heights.begin(), heights.end(), std::back_inserter(valid),
               [](double z) { return !std::isnan(z); });
  return valid;
}

double meanOf(const cv::Mat1d& heights) {
  double sum = 0.0;
  const std::vector<double> valid = validOf(heights);
  for (const double height : valid) sum += height;
  return sum / static_cast<double>(valid.size());
}

double medianOfValid(const cv::Mat1d& heights) {
  std::vector<double> valid = validOf(heights);
  return medianOf(valid);
}

Eigen::VectorXd terms(int row, int col, const cv::Size& size, int degree) {
  const double unit = 0.5 * std::max(size.width, size.height);
  const double u = (col - 0.5 * size.width) / unit;
  const double v = (row - 0.5 * size.height) / unit;
  Eigen::VectorXd basis(6);
  basis << 1.0, u, v, u * u, u * v, v * v;
  return basis.head(degree == 1 ? 3 : 6);
}

template <typename WeightOf>
Eigen::VectorXd fit(const cv::Mat1d& heights, int degree, const WeightOf& weight_of) {
  const Eigen::Index count = degree == 1 ? 3 : 6;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd moment = Eigen::VectorXd::Zero(count);
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      const double height = heights(row, col);
      if (std::isnan(height)) continue;
      const Eigen::VectorXd basis = terms(row, col, heights.size(), degree);
      const double weight = weight_of(height, basis);
      normal += weight * basis * basis.transpose();
      moment += weight * height * basis;
    }
  }
  return normal.ldlt().solve(moment);
}

cv::Mat1d without(const Eigen::VectorXd& polynomial, const cv::Mat1d& heights) {
  const int degree = polynomial.size() == 3 ? 1 : 2;
  cv::Mat1d flat(heights.size());
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      flat(row, col) = heights(row, col) - polynomial.dot(terms(row, col, heights.size(), degree));
    }
  }
  return flat;
}

/// Tukey's biweight from least squares on, until it rests.
cv::Mat1d withoutRobustPolynomial(const cv::Mat1d& heights) {
  Eigen::VectorXd polynomial = fit(heights, 2, [](double, const Eigen::VectorXd&) { return 1.0; });
  for (int round = 0; round < 40; ++round) {
    const double noise = 1.4826 * medianOfValid(cv::Mat1d(cv::abs(without(polynomial, heights))));
    polynomial = fit(heights, 2, [&](double height, const Eigen::VectorXd& basis) {
      const double distance = (height - polynomial.dot(basis)) / (4.685 * noise);
      return std::fabs(distance) < 1.0 ? std::pow(1.0 - distance * distance, 2) : 0.0;
    });
  }
  return without(polynomial, heights);
}

/// The surface goes on by its reflection through the border pixels.
double beyond(const cv::Mat1d& heights, int row, int col) {
  const int last_row = heights.rows - 1;
  const int last_col = heights.cols - 1;
  if (row < 0) return 2.0 * beyond(heights, 0, col) - beyond(heights, -row, col);
  if (row > last_row)
    return 2.0 * beyond(heights, last_row, col) - beyond(heights, 2 * last_row - row, col);
  if (col < 0) return 2.0 * heights(row, 0) - heights(row, -col);
  if (col > last_col) return 2.0 * heights(row, last_col) - heights(row, 2 * last_col - col);
  return heights(row, col);
}

double residualOf(const cv::Mat1d& heights, int half, int row, int col) {
  std::vector<double> window;
  for (int near_row = row - half; near_row <= row + half; ++near_row) {
    for (int near_col = col - half; near_col <= col + half; ++near_col) {
      const double height = beyond(heights, near_row, near_col);
      if (!std::isnan(height)) window.push_back(height);
    }
  }
  return heights(row, col) - medianOf(window);
}

}  // namespace

cv::Mat1d withoutStageOffset(const cv::Mat1d& heights) {
  const cv::Mat1d once = heights - meanOf(heights);
  return once - meanOf(once);
}

cv::Mat1d withoutLineMedians(const cv::Mat1d& heights) {
  const double mean = meanOf(heights);
  cv::Mat1d aligned = heights - mean;
  for (int row = 0; row < aligned.rows; ++row) aligned.row(row) -= medianOfValid(aligned.row(row));
  return aligned + (mean - meanOf(aligned));
}

cv::Mat1d withoutSpikes(const cv::Mat1d& heights, int half, double threshold) {
  const cv::Mat1d flat = withoutRobustPolynomial(heights);
  cv::Mat1d residuals(heights.size());
  for (int row = 0; row < flat.rows; ++row) {
    for (int col = 0; col < flat.cols; ++col)
      residuals(row, col) = residualOf(flat, half, row, col);
  }
  const cv::Mat1d distances = cv::abs(residuals - medianOfValid(residuals));
  cv::Mat1d found = heights.clone();
  found.setTo(kNan, distances > threshold * 1.4826 * medianOfValid(distances));
  return found;
}

cv::Mat1d withoutPlane(const cv::Mat1d& heights) {
  return without(fit(heights, 1, [](double, const Eigen::VectorXd&) { return 1.0; }), heights);
}

}  // namespace plain
}  // namespace mems_stiction
