#include "preprocess/level.hpp"

#include <algorithm>

#include <Eigen/Dense>

#include "preprocess/polynomial_level.hpp"

namespace mems_stiction {

Plane leastSquaresPlane(WorkingSurface& surface) {
  const cv::Mat& heights = surface.heights;
  const SurfaceMeans means = meansOf(heights, surface.memory, " to level by");

  // About the centroid the three normal equations part into the mean and two for the slopes.
  // Lengths are in units of the frame's longer side.
  const double unit = std::max(heights.cols * surface.pitch_x, heights.rows * surface.pitch_y);
  std::vector<double>& places = surface.memory.places;
  for (int col = 0; col < heights.cols; ++col) {
    places[static_cast<std::size_t>(col)] = (col - means.col) * surface.pitch_x / unit;
  }
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (int row = 0; row < heights.rows; ++row) {
    const LineSums sums =
        sumsOf(heights.ptr<double>(row), places.data(), places.size(), means.height);
    const double y = (row - means.row) * surface.pitch_y / unit;
    normal(0, 0) += sums.pp;
    normal(0, 1) += sums.p * y;
    normal(1, 1) += sums.count * y * y;
    moment += Eigen::Vector2d(sums.ph, sums.h * y);
  }
  normal(1, 0) = normal(0, 1);

  // Rank-revealing: pixels on one line leave the slope across it at its least norm, 0. Eigenvalues
  // of a line are zero to about 1e-15 of the largest; two full neighbouring rows of 10^5 pixels
  // still have 1e-9.
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix2d> decomposition;
  decomposition.setThreshold(1e-12);
  decomposition.compute(normal);
  const Eigen::Vector2d slope = decomposition.solve(moment) / unit;

  Plane plane;
  plane.mean_height = means.height;
  plane.slope_x = slope.x();
  plane.slope_y = slope.y();
  plane.centre_x = means.col * surface.pitch_x;
  plane.centre_y = means.row * surface.pitch_y;
  return plane;
}

HeightMap levelled(const HeightMap& surface) {
  WorkingSurface work(surface);
  level(work);
  return work.surface();
}

HeightChange level(WorkingSurface& surface) {
  const Plane plane = leastSquaresPlane(surface);
  std::vector<double>& places = surface.memory.places;
  for (int col = 0; col < surface.heights.cols; ++col) {
    places[static_cast<std::size_t>(col)] = col * surface.pitch_x - plane.centre_x;
  }
  LineCurve line;
  line.origin = plane.mean_height;
  line.b = plane.slope_x;
  return subtractCurves(surface, [&](int row) {
    line.a = plane.slope_y * (row * surface.pitch_y - plane.centre_y);
    return line;
  });
}

void LevelOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.enumeration(prefix, shape,
                      {{"none", LevelShape::kNone},
                       {"plane", LevelShape::kPlane},
                       {"polynomial", LevelShape::kPolynomial}},
                      "what is subtracted from a scan: nothing, the plane or the polynomial of "
                      "degree 2 that fits its valid pixels");
  visitor.flag(prefix + "_robust", robust,
               "fit that plane or polynomial so that features and spikes have no say");
}

HeightChange levelBy(WorkingSurface& surface, const LevelOptions& options) {
  if (options.shape == LevelShape::kPlane && !options.robust) return level(surface);
  const int degree = options.shape == LevelShape::kPlane ? 1 : 2;
  const FitWeights weights = options.robust ? FitWeights::kRobust : FitWeights::kEqual;
  const PolynomialSurface fit = fitPolynomial(surface.heights, surface.pitch_x, surface.pitch_y,
                                              degree, weights, surface.memory);
  return subtract(fit, surface);
}

}  // namespace mems_stiction
