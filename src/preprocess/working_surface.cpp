#include "preprocess/working_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "height_map/shared_pixels.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

/// The first height that is not NaN; NaN if there is none.
double firstValid(const cv::Mat& heights) {
  for (int row = 0; row < heights.rows; ++row) {
    const double* line = heights.ptr<double>(row);
    const double* valid =
        std::find_if(line, line + heights.cols, [](double height) { return !std::isnan(height); });
    if (valid != line + heights.cols) return *valid;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double* roomFor(std::size_t count, std::vector<double>& memory) {
  if (memory.size() < count) memory.resize(count);
  return memory.data();
}

void WorkingSurface::take(const HeightMap& surface) {
  const cv::Mat& source = surface.heights();
  if (isShared(heights)) std::swap(heights, spare);
  makeWritable(heights, source.rows, source.cols, CV_64FC1);
  for (int row = 0; row < source.rows; ++row) {
    const auto size = static_cast<std::size_t>(source.cols);
    if (source.depth() == CV_32F) {
      widenLine(source.ptr<float>(row), size, heights.ptr<double>(row));
    } else {
      widenLine(source.ptr<double>(row), size, heights.ptr<double>(row));
    }
  }
  pitch_x = surface.pitchX();
  pitch_y = surface.pitchY();
}

const std::vector<double>& columnNumbers(int cols, CleaningMemory& memory) {
  memory.places.resize(static_cast<std::size_t>(cols));
  std::iota(memory.places.begin(), memory.places.end(), 0.0);
  return memory.places;
}

SurfaceMeans meansOf(const cv::Mat& heights, CleaningMemory& memory, const char* purpose) {
  const double origin = firstValid(heights);
  if (std::isnan(origin))
    throw SurfaceError(std::string("the height map has no valid pixel") + purpose);
  const std::vector<double>& columns = columnNumbers(heights.cols, memory);
  SurfaceMeans means;
  for (int row = 0; row < heights.rows; ++row) {
    const LineSums sums = sumsOf(heights.ptr<double>(row), columns.data(), columns.size(), origin);
    means.count += sums.count;
    means.row += sums.count * row;
    means.col += sums.p;
    means.height += sums.h;
  }
  means.row /= means.count;
  means.col /= means.count;
  means.height = origin + means.height / means.count;
  return means;
}

}  // namespace mems_stiction
