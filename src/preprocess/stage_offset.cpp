#include "mems_stiction/preprocess/stage_offset.hpp"

#include "mems_stiction/height_map/validity.hpp"

namespace mems_stiction {

void StageOffsetOptions::describe(OptionVisitor& visitor, const std::string& prefix) {
  visitor.flag(prefix + "/enabled", enabled, "subtract the mean height, in double precision");
}

HeightMap withoutStageOffset(const HeightMap& surface) {
  cv::Mat heights = ownedHeights(surface);
  heights -= heightStatistics(surface).mean;
  // The sum of many large heights rounds off; that of the small ones which are left does not.
  heights -= heightStatistics(HeightMap(heights, surface.pitchX(), surface.pitchY())).mean;
  return {heights, surface.pitchX(), surface.pitchY()};
}

}  // namespace mems_stiction
