#include "surface/spline_refinement.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

double bSpline(double x) {
  const double distance = std::fabs(x);
  if (distance >= 2.0) return 0.0;
  if (distance >= 1.0) return std::pow(2.0 - distance, 3.0) / 6.0;
  return 2.0 / 3.0 - distance * distance + 0.5 * distance * distance * distance;
}

// a spline of coefficients at a few coarse cells, at the place (y, x) in coarse cells
double curve(const std::vector<float>& coarse, int coarse_cols, double y, double x) {
  double sum = 0.0;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const int row = static_cast<int>(i) / coarse_cols;
    const int col = static_cast<int>(i) % coarse_cols;
    sum += static_cast<double>(coarse[i]) * bSpline(y - row) * bSpline(x - col);
  }
  return sum;
}

constexpr int kRows = 12;
constexpr int kCols = 20;
constexpr int kCoarseCols = kCols / kRefinedCells + kSplineAround;
constexpr int kCoarseRows = kRows / kRefinedCells + kSplineAround;

std::vector<float> refined(SplineRefinement refinement, const std::vector<float>& coarse) {
  std::vector<float> line(kCoarseCols);
  std::vector<float> fine(kRows * kCols, 1.0F);  // what is there stays
  addRefined(refinement, coarse.data(), kRows, kCols, line.data(), fine.data());
  for (float& value : fine) value -= 1.0F;
  return fine;
}

std::vector<float> someCoefficients() {
  std::vector<float> coarse(kCoarseRows * kCoarseCols);
  for (std::size_t i = 0; i < coarse.size(); ++i)
    coarse[i] = static_cast<float>(std::sin(3.0 * static_cast<double>(i * i)));
  return coarse;
}

TEST(SplineRefinement, valuesAreThoseOfTheCurve) {
  const std::vector<float> coarse = someCoefficients();
  const std::vector<float> fine = refined(SplineRefinement::kValues, coarse);
  for (int row = 0; row < kRows; ++row) {
    for (int col = 0; col < kCols; ++col) {
      EXPECT_NEAR(fine[static_cast<std::size_t>(row * kCols + col)],
                  curve(coarse, kCoarseCols, 1.0 + row / 4.0, 1.0 + col / 4.0), 1e-6);
    }
  }
}

TEST(SplineRefinement, coefficientsMakeTheSameCurve) {
  const std::vector<float> coarse = someCoefficients();
  const std::vector<float> fine = refined(SplineRefinement::kCoefficients, coarse);
  for (double y = 2.0; y < kRows - 3.0; y += 0.37) {
    for (double x = 2.0; x < kCols - 3.0; x += 0.41) {
      EXPECT_NEAR(curve(fine, kCols, y, x),
                  curve(coarse, kCoarseCols, 1.0 + y / 4.0, 1.0 + x / 4.0), 1e-6);
    }
  }
}

}  // namespace
}  // namespace mems_stiction
