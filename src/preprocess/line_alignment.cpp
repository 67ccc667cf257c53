#include "mems_stiction/preprocess/line_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "mems_stiction/base/median.hpp"
#include "mems_stiction/height_map/validity.hpp"
#include "mems_stiction/preprocess/polynomial_level.hpp"

namespace mems_stiction {
namespace {

void subtractMedians(cv::Mat& heights) {
  std::vector<double> values;
  for (int row = 0; row < heights.rows; ++row) {
    double* line = heights.ptr<double>(row);
    values.clear();
    std::copy_if(line, line + heights.cols, std::back_inserter(values),
                 [](double height) { return !std::isnan(height); });
    const double shift = medianOf(values);
    for (int col = 0; col < heights.cols; ++col) line[col] -= shift;
  }
}

void subtractMedianDifferences(cv::Mat& heights) {
  std::vector<double> differences;
  for (int row = 1; row < heights.rows; ++row) {
    double* line = heights.ptr<double>(row);
    // The nearest line above that shares valid pixels with this one; it is in its place already.
    for (int other = row - 1; other >= 0; --other) {
      const double* above = heights.ptr<double>(other);
      differences.clear();
      for (int col = 0; col < heights.cols; ++col) {
        const double difference = line[col] - above[col];
        if (!std::isnan(difference)) differences.push_back(difference);
      }
      if (differences.empty()) continue;
      const double shift = medianOf(differences);
      for (int col = 0; col < heights.cols; ++col) line[col] -= shift;
      break;
    }
  }
}

void subtractPolynomials(cv::Mat& heights, double pitch_x, double pitch_y, int degree) {
  for (int row = 0; row < heights.rows; ++row) {
    cv::Mat row_heights = heights.row(row);
    if (cv::countNonZero(validMask(row_heights)) == 0) continue;
    const HeightMap line(row_heights, pitch_x, pitch_y);
    without(fitPolynomial(line, degree, FitWeights::kRobust), line).heights().copyTo(row_heights);
  }
}

}  // namespace

void LineAlignmentOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.enumeration(prefix + "/method", method,
                      {{"none", LineAlignment::kNone},
                       {"median", LineAlignment::kMedian},
                       {"median_difference", LineAlignment::kMedianDifference},
                       {"polynomial", LineAlignment::kPolynomial}},
                      "what is taken off each scan line (row): nothing, its median, the median of its differences from "
                      "the line before it, or its own robust polynomial");
  visitor.integer(prefix + "/degree", degree, Range::within(0, 2), "degree of the polynomial of each line");
}

HeightMap withAlignedLines(const HeightMap& surface, const LineAlignmentOptions& options) {
  const double mean = heightStatistics(surface).mean;
  cv::Mat heights = ownedHeights(surface);
  heights -= mean;  // before the differences, so that an offset of millimetres costs no digits
  switch (options.method) {
    case LineAlignment::kNone:
      break;
    case LineAlignment::kMedian:
      subtractMedians(heights);
      break;
    case LineAlignment::kMedianDifference:
      subtractMedianDifferences(heights);
      break;
    case LineAlignment::kPolynomial:
      subtractPolynomials(heights, surface.pitchX(), surface.pitchY(), options.degree);
      break;
  }
  heights += mean - heightStatistics(HeightMap(heights, surface.pitchX(), surface.pitchY())).mean;
  return {heights, surface.pitchX(), surface.pitchY()};
}

}  // namespace mems_stiction
