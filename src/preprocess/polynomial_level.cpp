#include "mems_stiction/preprocess/polynomial_level.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/median.hpp"
#include "mems_stiction/height_map/validity.hpp"

namespace mems_stiction {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kHuber = 1.345;
constexpr double kTukey = 4.685;
constexpr int kHuberRounds = 8;
constexpr int kTukeyRounds = 30;

Vector6 terms(double u, double v, int degree) {
  Vector6 basis = Vector6::Zero();
  basis[0] = 1.0;
  if (degree >= 1) {
    basis[1] = u;
    basis[2] = v;
  }
  if (degree >= 2) {
    basis[3] = u * u;
    basis[4] = u * v;
    basis[5] = v * v;
  }
  return basis;
}

/// visit(u, v, height less origin) for every valid pixel.
template <typename Visit>
void forEachValid(const cv::Mat& heights, const HeightMap& grid, const PolynomialSurface& frame, Visit visit) {
  for (int row = 0; row < heights.rows; ++row) {
    const double* line = heights.ptr<double>(row);
    const double v = (row * grid.pitchY() - frame.center_y) / frame.unit;
    for (int col = 0; col < heights.cols; ++col) {
      if (!std::isnan(line[col]))
        visit((col * grid.pitchX() - frame.center_x) / frame.unit, v, line[col] - frame.origin);
    }
  }
}

/// Where the coordinates are centered, and what they are divided by.
PolynomialSurface frameOf(const cv::Mat& heights, const HeightMap& grid, int degree) {
  PolynomialSurface frame;
  frame.degree = degree;
  frame.unit = 0.5 * std::max(heights.cols * grid.pitchX(), heights.rows * grid.pitchY());
  std::vector<double> sample;
  double sum_row = 0.0;
  double sum_col = 0.0;
  for (int row = 0; row < heights.rows; ++row) {
    const double* line = heights.ptr<double>(row);
    for (int col = 0; col < heights.cols; ++col) {
      if (std::isnan(line[col])) continue;
      sum_row += row;
      sum_col += col;
      sample.push_back(line[col]);
    }
  }
  if (sample.empty()) throw SurfaceError("the height map has no valid pixel to level by");
  const double count = static_cast<double>(sample.size());
  frame.center_x = sum_col / count * grid.pitchX();
  frame.center_y = sum_row / count * grid.pitchY();
  frame.origin = medianOf(sample);
  return frame;
}

/// @param scale residuals beyond it lose weight [m]; 0 = equal weights
Vector6 solve(const cv::Mat& heights, const HeightMap& grid, const PolynomialSurface& current, double scale,
              bool biweight) {
  Matrix6 normal = Matrix6::Zero();
  Vector6 moment = Vector6::Zero();
  forEachValid(heights, grid, current, [&](double u, double v, double height) {
    const Vector6 basis = terms(u, v, current.degree);
    double weight = 1.0;
    if (scale > 0.0) {
      const double residual = std::fabs(height - current.coefficients.dot(basis)) / scale;
      if (biweight) {
        const double share = residual < kTukey ? 1.0 - (residual / kTukey) * (residual / kTukey) : 0.0;
        weight = share * share;
      } else if (residual > kHuber) {
        weight = kHuber / residual;
      }
    }
    normal.noalias() += (weight * basis) * basis.transpose();
    moment += (weight * height) * basis;
  });
  // Rank-revealing: what the pixels do not determine stays 0.
  Eigen::CompleteOrthogonalDecomposition<Matrix6> decomposition;
  decomposition.setThreshold(1e-12);
  decomposition.compute(normal);
  return decomposition.solve(moment);
}

double noiseOf(const cv::Mat& heights, const HeightMap& grid, const PolynomialSurface& current) {
  std::vector<double> residuals;
  residuals.reserve(heights.total());
  forEachValid(heights, grid, current, [&](double u, double v, double height) {
    residuals.push_back(std::fabs(height - current.coefficients.dot(terms(u, v, current.degree))));
  });
  return 1.4826 * medianOf(residuals);
}

}  // namespace

double PolynomialSurface::height(double x, double y) const {
  return origin + coefficients.dot(terms((x - center_x) / unit, (y - center_y) / unit, degree));
}

PolynomialSurface fitPolynomial(const HeightMap& surface, int degree, FitWeights weights) {
  const cv::Mat heights = ownedHeights(surface);
  PolynomialSurface fit = frameOf(heights, surface, degree);
  fit.coefficients = solve(heights, surface, fit, 0.0, false);
  fit.noise = noiseOf(heights, surface, fit);
  if (weights == FitWeights::kEqual) return fit;

  for (int round = 0; round < kHuberRounds + kTukeyRounds; ++round) {
    // A noise at the rounding of the polynomial itself: the fit is exact.
    if (!(fit.noise > 1e-13 * fit.coefficients.cwiseAbs().maxCoeff())) break;
    const bool biweight = round >= kHuberRounds;
    const Vector6 next = solve(heights, surface, fit, fit.noise, biweight);
    const double step = (next - fit.coefficients).cwiseAbs().maxCoeff();
    fit.coefficients = next;
    fit.noise = noiseOf(heights, surface, fit);
    if (biweight && step < 1e-4 * fit.noise) break;
  }
  return fit;
}

HeightMap without(const PolynomialSurface& polynomial, const HeightMap& surface) {
  cv::Mat heights = ownedHeights(surface);
  for (int row = 0; row < heights.rows; ++row) {
    double* line = heights.ptr<double>(row);
    for (int col = 0; col < heights.cols; ++col) {
      const double u = (col * surface.pitchX() - polynomial.center_x) / polynomial.unit;
      const double v = (row * surface.pitchY() - polynomial.center_y) / polynomial.unit;
      line[col] = (line[col] - polynomial.origin) - polynomial.coefficients.dot(terms(u, v, polynomial.degree));
    }
  }
  return {heights, surface.pitchX(), surface.pitchY()};
}

}  // namespace mems_stiction
