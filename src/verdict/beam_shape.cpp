#include "verdict/beam_shape.hpp"

#include <algorithm>

namespace mems_stiction {

BeamShape shapeUnder(const Beam& beam, double start, double length, int cells) {
  BeamShape shape;
  shape.step = beam.length / cells;
  const double step = shape.step;
  const double end = std::min(start + length, beam.length);
  const auto middle = [step](int i) { return (i + 0.5) * step; };
  /// moment over load of what lies beyond x
  const auto momentOfLoad = [&](double x) {
    const double from = std::max(start, x);
    return from < end ? 0.5 * ((end - x) * (end - x) - (from - x) * (from - x)) : 0.0;
  };
  std::vector<double>& curvature = shape.curvature;
  curvature.resize(static_cast<std::size_t>(cells));
  for (int i = 0; i < cells; ++i) curvature[static_cast<std::size_t>(i)] = momentOfLoad(middle(i));
  if (beam.type == BeamType::kDoublyClamped) {
    // what it needs at its other clamp, no slope and no deflection, is brought by a force and a
    // moment there: curvature - force (l - x) - moment has no mean and no first moment about the
    // far end
    double sum = 0.0;
    double moment = 0.0;
    for (int i = 0; i < cells; ++i) {
      sum += curvature[static_cast<std::size_t>(i)] * step;
      moment += curvature[static_cast<std::size_t>(i)] * (beam.length - middle(i)) * step;
    }
    const double l = beam.length;
    const double force = 12.0 / (l * l * l) * (moment - 0.5 * l * sum);
    const double couple = sum / l - 0.5 * force * l;
    for (int i = 0; i < cells; ++i) {
      curvature[static_cast<std::size_t>(i)] -= force * (l - middle(i)) + couple;
    }
  }
  double slope = 0.0;
  double deflection = 0.0;
  for (const double bent : curvature) {
    const double in_middle = slope + 0.5 * bent * step;
    shape.at_edges.push_back(deflection);
    shape.deflection.push_back(deflection + 0.5 * slope * step + 0.125 * bent * step * step);
    shape.slope.push_back(in_middle);
    deflection += in_middle * step;
    slope += bent * step;
  }
  shape.at_edges.push_back(deflection);
  return shape;
}

}  // namespace mems_stiction
