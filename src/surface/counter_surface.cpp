#include "mems_stiction/surface/counter_surface.hpp"

namespace mems_stiction {

void CounterSurfaceOptions::describe(OptionVisitor& visitor) {
  visitor.enumeration("counter_surface/type", type,
                      {{"flat", CounterSurfaceType::kFlat}, {"topic", CounterSurfaceType::kTopic}},
                      "what the scan touches: a plane, or the latest measured counter-surface");
  visitor.enumeration("counter_surface/facing", facing,
                      {{"down", CounterSurfaceFacing::kDown}, {"up", CounterSurfaceFacing::kUp}},
                      "which way a measured counter-surface faces: down as mounted, or up as measured and still to be "
                      "turned over about its y axis");
}

HeightMap mountedCounterSurface(const HeightMap& measured, CounterSurfaceFacing facing) {
  if (facing == CounterSurfaceFacing::kDown) return measured;
  cv::Mat turned;
  cv::flip(measured.heights(), turned, 1);  // about the y axis: columns mirrored
  turned *= -1.0;
  return {turned, measured.pitchX(), measured.pitchY()};
}

}  // namespace mems_stiction
