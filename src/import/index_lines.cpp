#include "mems_stiction/import/index_lines.hpp"

#include <cmath>

namespace mems_stiction {
namespace {

constexpr int kLeastNumbers = 3;      // fewer are in equal steps by chance
constexpr int kLeastSteady = 5;       // the same for steps of any size
constexpr double kEqualStep = 0.05;   // of the step: printed coordinates are rounded
constexpr double kExactStep = 0.001;  // of the step: few numbers must fit better

/// Numbers from `first` on in equal steps that are not zero.
bool isSteady(const cv::Mat& line, int first, double tolerance) {
  const int count = line.cols - first;
  const double* number = line.ptr<double>(0) + first;
  const double step = (number[count - 1] - number[0]) / (count - 1);
  if (!std::isfinite(step) || step == 0.0) return false;
  for (int i = 0; i < count; ++i) {
    if (!(std::abs(number[i] - number[0] - i * step) <= tolerance * std::abs(step))) return false;
  }
  return true;
}

/// 0, 1, 2, ... or 1, 2, 3, ..., or numbers in equal steps if there are more of them.
bool looksLikeIndices(const cv::Mat& line, int first) {
  const int count = line.cols - first;
  if (count < kLeastNumbers) return false;
  const double* number = line.ptr<double>(0) + first;
  const bool counts = (number[0] == 0.0 || number[0] == 1.0) && number[1] == number[0] + 1.0;
  if (counts) return isSteady(line, first, 0.0);
  return count >= kLeastSteady - 1 && isSteady(line, first, count >= kLeastSteady ? kEqualStep : kExactStep);
}

/// The row, or the row less its corner, looks like indices and most others do not.
bool isIndexRow(const cv::Mat& grid, int row) {
  for (const int first : {0, 1}) {
    if (!looksLikeIndices(grid.row(row), first)) continue;
    int alike = 0;
    for (int other = 0; other < grid.rows; ++other) {
      if (other != row && isSteady(grid.row(other), first, kEqualStep)) ++alike;
    }
    if (2 * alike < grid.rows - 1) return true;
  }
  return false;
}

}  // namespace

std::string indexLine(const cv::Mat& grid) {
  const cv::Mat columns = grid.t();
  const std::string advice = ": indices or coordinates, not heights; remove ";
  if (isIndexRow(grid, 0)) return "numbers in equal steps, column 1 on" + advice + "them";
  if (isIndexRow(grid, grid.rows - 1)) return "the last line holds numbers in equal steps" + advice + "it";
  if (isIndexRow(columns, 0)) return "column 1 holds numbers in equal steps" + advice + "it";
  if (isIndexRow(columns, grid.cols - 1)) {
    return "column " + std::to_string(grid.cols) + " holds numbers in equal steps" + advice + "it";
  }
  return "";
}

}  // namespace mems_stiction
