#include "prediction/force_curve.hpp"

#include <algorithm>

#include "loads/force_range.hpp"

namespace mems_stiction {

std::vector<CurvePoint> curveOf(const Prediction& prediction, const ContactSettings& settings) {
  const double range = forceRange(settings.interface, settings.lower, settings.upper);
  const auto add = [range](const SeparationCurvePoint& point, CurveDirection direction,
                           std::vector<CurvePoint>& to) {
    to.push_back({range - point.displacement, point.force, direction});
  };
  std::vector<CurvePoint> curve;
  for (const SeparationCurvePoint& point : prediction.curve) {
    add(point, point.is_separation ? CurveDirection::kRetraction : CurveDirection::kApproach,
        curve);
  }
  const bool has_unloading =
      std::any_of(prediction.curve.begin(), prediction.curve.end(),
                  [](const SeparationCurvePoint& point) { return point.is_separation; });
  if (!has_unloading) {
    std::for_each(
        prediction.curve.rbegin(), prediction.curve.rend(),
        [&](const SeparationCurvePoint& point) { add(point, CurveDirection::kRetraction, curve); });
  }
  return curve;
}

}  // namespace mems_stiction
