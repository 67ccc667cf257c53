#include "verdict/beam_electrode.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "numeric/constants.hpp"
#include "verdict/beam_shape.hpp"

namespace mems_stiction {
namespace {

constexpr int kCells = 400;       // along the beam; the integrals are then right to 1e-5
constexpr int kAmplitudes = 400;  // between rest and landing; the maximum of V(a) is flat

/// The shape of the beam at the middles of its cells; max = 1.
struct ScaledShape {
  std::vector<double> deflection;
  double slope_square = 0.0;      ///< J [1/m]
  double curvature_square = 0.0;  ///< integral phi''^2 dx [1/m^3]
};

ScaledShape scaledShape(const Beam& beam, const BeamElectrode& electrode) {
  BeamShape bent = shapeUnder(beam, electrode.start, electrode.length, kCells);
  ScaledShape shape;
  for (const double slope : bent.slope) shape.slope_square += slope * slope * bent.step;
  for (const double curvature : bent.curvature)
    shape.curvature_square += curvature * curvature * bent.step;
  shape.deflection = std::move(bent.deflection);
  const double most = *std::max_element(shape.deflection.begin(), shape.deflection.end());
  for (double& value : shape.deflection) value /= most;
  shape.slope_square /= most * most;
  shape.curvature_square /= most * most;
  return shape;
}

}  // namespace

std::optional<BeamElectrode> electrodeOf(const DeviceOptions& device,
                                         const InterfaceOptions& interface) {
  if (!device.hasBeam() || device.hasSpring() || device.electrode_length <= 0.0 ||
      device.beam_width <= 0.0) {
    return std::nullopt;
  }
  return BeamElectrode{device.electrode_start, device.electrode_length,
                       std::max(device.electrode_gap, device.beam_gap),
                       interface.insulator_thickness / interface.insulator_relative_permittivity};
}

double beamClosingVoltage(const Beam& beam, const BeamElectrode& electrode) {
  if (beam.type == BeamType::kNone || !(beam.width > 0.0))
    return std::numeric_limits<double>::quiet_NaN();
  const ScaledShape shape = scaledShape(beam, electrode);
  const double section = beam.width * beam.thickness;
  double linear =
      beam.modulus * section * beam.thickness * beam.thickness / 12.0 * shape.curvature_square;
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
