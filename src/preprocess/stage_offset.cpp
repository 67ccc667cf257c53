#include "preprocess/stage_offset.hpp"

namespace mems_stiction {

void StageOffsetOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.flag(prefix + "/enabled", enabled, "subtract the mean height, in double precision");
}

HeightChange subtractStageOffset(WorkingSurface& surface) {
  cv::Mat& heights = surface.heights;
  const double mean = meansOf(heights, surface.memory).height;
  const std::vector<double>& columns = columnNumbers(heights.cols, surface.memory);
  // The sum of many large heights rounds off; that of the small ones which are left does not.
  LineSums left;
  for (int row = 0; row < heights.rows; ++row) {
    const LineSums sums = sumsOf(heights.ptr<double>(row), columns.data(), columns.size(), mean);
    left.count += sums.count;
    left.h += sums.h;
  }
  LineCurve offset;
  offset.origin = mean;
  offset.a = left.h / left.count;
  return subtractCurves(surface, [&](int) { return offset; });
}

}  // namespace mems_stiction
