#include "preprocess/line_alignment.hpp"

#include <vector>

#include "height_map/validity.hpp"
#include "preprocess/polynomial_level.hpp"

namespace mems_stiction {
namespace {

/// Each line less its median. Curves run over column numbers.
void takeMedians(WorkingSurface& surface, double mean) {
  const cv::Mat& heights = surface.heights;
  CleaningMemory& memory = surface.memory;
  const auto cols = static_cast<std::size_t>(heights.cols);
  double* differences = roomFor(cols, memory.distances);
  for (int row = 0; row < heights.rows; ++row) {
    LineCurve& curve = memory.curves[static_cast<std::size_t>(row)];
    subtractTo(heights.ptr<double>(row), mean, cols, differences);
    curve.a = memory.medians.median(differences, cols);
  }
}

void takeMedianDifferences(WorkingSurface& surface) {
  const cv::Mat& heights = surface.heights;
  CleaningMemory& memory = surface.memory;
  const auto cols = static_cast<std::size_t>(heights.cols);
  double* differences = roomFor(cols, memory.distances);
  for (int row = 1; row < heights.rows; ++row) {
    // The nearest line above that shares valid pixels with this one.
    for (int other = row - 1; other >= 0; --other) {
      subtractTo(heights.ptr<double>(row), heights.ptr<double>(other), cols, differences);
      if (countAbove(0.0, differences, cols).invalid == heights.cols) continue;
      memory.curves[static_cast<std::size_t>(row)].a =
          memory.curves[static_cast<std::size_t>(other)].a +
          memory.medians.median(differences, cols);
      break;
    }
  }
}

void takePolynomials(WorkingSurface& surface, int degree) {
  const double pitch_x = surface.pitch_x;
  for (int row = 0; row < surface.heights.rows; ++row) {
    const cv::Mat line = surface.heights.row(row);
    if (cv::countNonZero(validMask(line)) == 0) continue;
    const PolynomialSurface fit =
        fitPolynomial(line, pitch_x, surface.pitch_y, degree, FitWeights::kRobust, surface.memory);
    // From places u = scale column + shift to columns.
    const LineCurve curve = curveAt(fit, 0.0);
    const double scale = pitch_x / fit.unit;
    const double shift = -fit.centre_x / fit.unit;
    surface.memory.curves[static_cast<std::size_t>(row)] = {
        curve.origin, curve.a + shift * (curve.b + shift * curve.c),
        scale * (curve.b + 2.0 * shift * curve.c), scale * scale * curve.c};
  }
}

}  // namespace

void LineAlignmentOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.enumeration(prefix + "/method", method,
                      {{"none", LineAlignment::kNone},
                       {"median", LineAlignment::kMedian},
                       {"median_difference", LineAlignment::kMedianDifference},
                       {"polynomial", LineAlignment::kPolynomial}},
                      "what is taken off each scan line (row): nothing, its median, the median of "
                      "its differences from "
                      "the line before it, or its own robust polynomial");
  visitor.integer(prefix + "/degree", degree, Range::within(0, 2),
                  "degree of the polynomial of each line");
}

HeightChange alignLines(WorkingSurface& surface, const LineAlignmentOptions& options) {
  cv::Mat& heights = surface.heights;
  std::vector<LineCurve>& curves = surface.memory.curves;
  const double mean = meansOf(heights, surface.memory).height;
  LineCurve level;
  level.origin = mean;  // before the differences, so that an offset of millimetres costs no digits
  curves.assign(static_cast<std::size_t>(heights.rows), level);
  switch (options.method) {
    case LineAlignment::kNone:
      break;
    case LineAlignment::kMedian:
      takeMedians(surface, mean);
      break;
    case LineAlignment::kMedianDifference:
      takeMedianDifferences(surface);
      break;
    case LineAlignment::kPolynomial:
      takePolynomials(surface, options.degree);
      break;
  }

  const std::vector<double>& columns = columnNumbers(heights.cols, surface.memory);
  double count = 0.0;
  double left = 0.0;
  for (int row = 0; row < heights.rows; ++row) {
    const LineCurve& curve = curves[static_cast<std::size_t>(row)];
    const LineSums sums =
        sumsOf(heights.ptr<double>(row), columns.data(), columns.size(), curve.origin);
    count += sums.count;
    left += sums.h - (curve.a * sums.count + curve.b * sums.p + curve.c * sums.pp);
  }
  return subtractCurves(surface, [&](int row) {
    LineCurve curve = curves[static_cast<std::size_t>(row)];
    curve.a += left / count - mean;
    return curve;
  });
}

}  // namespace mems_stiction
