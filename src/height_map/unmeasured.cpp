#include "height_map/unmeasured.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "height_map/validity.hpp"

namespace mems_stiction {
namespace {

constexpr double kLargestShare =
    0.25;  // of a rough line that may have the value of the line beside it

enum class LineKind { kMissing, kOneValue, kRough };

/// What a row or column has.
struct Line {
  LineKind kind = LineKind::kMissing;
  double value = 0.0;  ///< of the first measured pixel
  int pixels = 0;      ///< that were measured
};

/// Adds a pixel to its line; cheap for lines that are known to be rough.
void add(Line& line, double height) {
  if (line.kind == LineKind::kRough || !std::isfinite(height)) return;
  if (line.kind == LineKind::kMissing) {
    line.kind = LineKind::kOneValue;
    line.value = height;
  } else if (height != line.value) {
    line.kind = LineKind::kRough;
  }
  ++line.pixels;
}

/// Rows end at the first pixel that differs, and so does the look at columns once all are rough.
template <typename Scalar>
void findLines(const cv::Mat& heights, std::vector<Line>& rows, std::vector<Line>& cols) {
  bool has_open_cols = true;
  for (int i = 0; i < heights.rows; ++i) {
    const Scalar* pixels = heights.ptr<Scalar>(i);
    Line& row = rows[static_cast<std::size_t>(i)];
    for (int j = 0; j < heights.cols && row.kind != LineKind::kRough; ++j)
      add(row, static_cast<double>(pixels[j]));
    if (!has_open_cols) continue;
    has_open_cols = false;
    for (int j = 0; j < heights.cols; ++j) {
      Line& col = cols[static_cast<std::size_t>(j)];
      add(col, static_cast<double>(pixels[j]));
      has_open_cols = has_open_cols || col.kind != LineKind::kRough;
    }
  }
}

struct Lines {
  std::vector<Line> rows, cols;
};

Lines linesOf(const cv::Mat& heights) {
  Lines lines{std::vector<Line>(static_cast<std::size_t>(heights.rows)),
              std::vector<Line>(static_cast<std::size_t>(heights.cols))};
  if (heights.depth() == CV_32F) {
    findLines<float>(heights, lines.rows, lines.cols);
  } else {
    findLines<double>(heights, lines.rows, lines.cols);
  }
  return lines;
}

double pixel(const cv::Mat& heights, int row, int col) {
  return heights.depth() == CV_32F ? static_cast<double>(heights.at<float>(row, col))
                                   : heights.at<double>(row, col);
}

/// One row or column of a matrix.
struct LinePixels {
  const cv::Mat& heights;
  int line;
  bool is_row;

  int count() const { return is_row ? heights.cols : heights.rows; }
  double at(int i) const { return is_row ? pixel(heights, line, i) : pixel(heights, i, line); }

  /// Whether less than kLargestShare of the measured pixels outside of a range are of this value;
  /// not if there are none.
  bool isRoughBeside(double value, const cv::Range& without) const {
    int equal = 0;
    int measured = 0;
    for (int i = 0; i < count(); ++i) {
      if (!std::isfinite(at(i)) || (i >= without.start && i < without.end)) continue;
      ++measured;
      if (at(i) == value) ++equal;
    }
    return equal < kLargestShare * measured;
  }

  /// The longer of the parts at either end without a measured pixel of another value.
  cv::Range endOf(double value) const {
    const auto is_other = [&](int i) { return std::isfinite(at(i)) && at(i) != value; };
    int first = 0;
    while (first < count() && !is_other(first)) ++first;
    int last = count();
    while (last > 0 && !is_other(last - 1)) --last;
    return count() - last > first ? cv::Range(last, count()) : cv::Range(0, first);
  }
};

/// Marks each run of lines of one and the same value that rough lines without this value stand
/// beside.
void markRuns(const cv::Mat& heights, const std::vector<Line>& lines, bool is_row, cv::Mat& mask) {
  const int count = static_cast<int>(lines.size());
  const auto at = [&lines](int line) -> const Line& {
    return lines[static_cast<std::size_t>(line)];
  };
  const auto next = [&](int line, int step) {
    while (line >= 0 && line < count && at(line).kind == LineKind::kMissing) line += step;
    return line;
  };
  for (int begin = next(0, 1); begin < count;) {
    const auto continues = [&](int line) {
      return line < count && at(line).kind == LineKind::kOneValue &&
             at(line).value == at(begin).value;
    };
    int end = begin;
    while (continues(next(end + 1, 1))) end = next(end + 1, 1);
    bool is_stopped = at(begin).kind == LineKind::kOneValue;
    const double value = at(begin).value;
    const auto is_rough = [&](int line, const cv::Range& without) {
      return line >= 0 && line < count && at(line).kind == LineKind::kRough &&
             LinePixels{heights, line, is_row}.isRoughBeside(value, without);
    };
    std::vector<std::pair<int, cv::Range>> begun;  // lines that the instrument stopped in
    int neighbours = 0;
    for (const int step : {-1, 1}) {
      const int line = next(step < 0 ? begin - 1 : end + 1, step);
      if (line < 0 || line >= count) continue;
      ++neighbours;
      if (!is_stopped || is_rough(line, {0, 0})) continue;
      const cv::Range filled = LinePixels{heights, line, is_row}.endOf(value);
      is_stopped = is_rough(line, filled) && is_rough(next(line + step, step), {0, 0});
      begun.emplace_back(line, filled);
    }
    for (int line = begin; is_stopped && neighbours > 0 && line <= end; ++line) {
      if (at(line).pixels < kFewestStoppedPixels) continue;
      if (mask.empty()) mask = cv::Mat::zeros(heights.size(), CV_8UC1);
      (is_row ? mask.row(line) : mask.col(line)).setTo(255);
    }
    for (const auto& [line, filled] : begun) {
      if (!is_stopped || mask.empty()) continue;
      const cv::Range whole(line, line + 1);
      (is_row ? mask(whole, filled) : mask(filled, whole)).setTo(255);
    }
    begin = next(end + 1, 1);
  }
}

/// rows x cols CV_8UC1: 255 in rows and columns that the instrument did not reach: all their
/// measured pixels, at least kFewestStoppedPixels, are of one value, which the nearest rough lines
/// have in less than a quarter of their pixels. The filled end of a line that the instrument
/// stopped in goes with them. Empty if there are none.
cv::Mat stoppedLines(const cv::Mat& heights) {
  const Lines lines = linesOf(heights);
  cv::Mat mask;
  markRuns(heights, lines.rows, true, mask);
  markRuns(heights, lines.cols, false, mask);
  return mask;
}

}  // namespace

cv::Mat sentinelMask(const cv::Mat& heights) {
  cv::Mat beyond = cv::abs(heights) > kLargestHeight;
  beyond &= validMask(heights);
  return beyond;
}

HeightMap withoutSentinels(const HeightMap& surface) {
  // Without a mask of its own for the many scans that have no such pixel.
  if (cv::checkRange(surface.heights(), true, nullptr, -kLargestHeight, kLargestHeight))
    return surface;
  const cv::Mat beyond = sentinelMask(surface.heights());
  if (cv::countNonZero(beyond) == 0) return surface;
  cv::Mat heights = ownedHeights(surface);
  heights.setTo(std::numeric_limits<double>::quiet_NaN(), beyond);
  return {heights, surface.pitchX(), surface.pitchY()};
}

MissingLines missingLines(const HeightMap& surface) {
  const auto count = [](const std::vector<Line>& lines) {
    return static_cast<int>(std::count_if(lines.begin(), lines.end(), [](const Line& line) {
      return line.kind == LineKind::kMissing;
    }));
  };
  const Lines lines = linesOf(surface.heights());
  return {count(lines.rows), count(lines.cols)};
}

HeightMap measuredPart(const HeightMap& surface) {
  HeightMap finite = withoutSentinels(surface);
  const cv::Mat stopped = stoppedLines(finite.heights());
  if (stopped.empty()) return finite;
  cv::Mat heights = ownedHeights(finite);
  heights.setTo(std::numeric_limits<double>::quiet_NaN(), stopped);
  return {heights, surface.pitchX(), surface.pitchY()};
}

}  // namespace mems_stiction
