#include "verdict/beam_electrode.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

constexpr int kCells = 400;       // along the beam; the integrals are then right to 1e-5
constexpr int kAmplitudes = 400;  // between rest and landing; the maximum of V(a) is flat

/// A shape of the beam at the middles of its cells; max = 1.
struct Shape {
  std::vector<double> deflection;
  double slope_square = 0.0;      ///< J [1/m]
  double curvature_square = 0.0;  ///< integral phi''^2 dx [1/m^3]
};

/// Of a load that is even on the electrode: curvature by the bending moment, then integrated twice from the clamp. What a
/// doubly clamped beam needs at its other clamp, no slope and no deflection, is brought by a force and a moment there.
Shape shapeUnder(const Beam& beam, const BeamElectrode& electrode) {
  const double step = beam.length / kCells;
  const double end = std::min(electrode.start + electrode.length, beam.length);
  const auto middle = [step](int i) { return (i + 0.5) * step; };
  /// moment over load of what lies beyond x
  const auto momentOfLoad = [&](double x) {
    const double from = std::max(electrode.start, x);
    return from < end ? 0.5 * ((end - x) * (end - x) - (from - x) * (from - x)) : 0.0;
  };
  std::vector<double> curvature(kCells);
  for (int i = 0; i < kCells; ++i) curvature[static_cast<std::size_t>(i)] = momentOfLoad(middle(i));
  if (beam.type == BeamType::kDoublyClamped) {
    // curvature - force (l - x) - moment has no mean and no first moment about the far end
    double sum = 0.0;
    double moment = 0.0;
    for (int i = 0; i < kCells; ++i) {
      sum += curvature[static_cast<std::size_t>(i)] * step;
      moment += curvature[static_cast<std::size_t>(i)] * (beam.length - middle(i)) * step;
    }
    const double l = beam.length;
    const double force = 12.0 / (l * l * l) * (moment - 0.5 * l * sum);
    const double couple = sum / l - 0.5 * force * l;
    for (int i = 0; i < kCells; ++i) {
      curvature[static_cast<std::size_t>(i)] -= force * (l - middle(i)) + couple;
    }
  }
  Shape shape;
  double slope = 0.0;
  double deflection = 0.0;
  for (const double bent : curvature) {
    const double in_middle = slope + 0.5 * bent * step;
    shape.deflection.push_back(deflection + 0.5 * slope * step + 0.125 * bent * step * step);
    shape.slope_square += in_middle * in_middle * step;
    shape.curvature_square += bent * bent * step;
    deflection += in_middle * step;
    slope += bent * step;
  }
  const double most = *std::max_element(shape.deflection.begin(), shape.deflection.end());
  for (double& value : shape.deflection) value /= most;
  shape.slope_square /= most * most;
  shape.curvature_square /= most * most;
  return shape;
}

}  // namespace

double beamClosingVoltage(const Beam& beam, const BeamElectrode& electrode) {
  if (beam.type == BeamType::kNone || !(beam.width > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  const Shape shape = shapeUnder(beam, electrode);
  const double section = beam.width * beam.thickness;
  double linear = beam.modulus * section * beam.thickness * beam.thickness / 12.0 * shape.curvature_square;
  double cubic = 0.0;
  if (beam.type == BeamType::kDoublyClamped) {
    linear += beam.residual_stress * section * shape.slope_square;
    cubic = beam.modulus * section * shape.slope_square * shape.slope_square / (2.0 * beam.length);
  }
  const double step = beam.length / kCells;
  const double gap = electrode.gap + electrode.insulator_gap;
  double most = 0.0;
  for (int i = 1; i <= kAmplitudes; ++i) {
    const double amplitude = beam.gap * i / kAmplitudes;
    if (amplitude >= gap) break;  // the field there grows beyond all bounds
    double pull = 0.0;
    for (int cell = 0; cell < kCells; ++cell) {
      const double x = (cell + 0.5) * step;
      if (x < electrode.start || x > electrode.start + electrode.length) continue;
      const double deflection = shape.deflection[static_cast<std::size_t>(cell)];
      pull += deflection / ((gap - amplitude * deflection) * (gap - amplitude * deflection)) * step;
    }
    const double back = (linear + cubic * amplitude * amplitude) * amplitude;
    most = std::max(most, 2.0 * back / (kVacuumPermittivity * beam.width * pull));
  }
  return std::sqrt(most);
}

}  // namespace mems_stiction
