#include "verdict/electrode_hold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/surface_forces.hpp"
#include "numeric/bisection.hpp"
#include "numeric/rounding.hpp"

namespace mems_stiction {
namespace {

/// Between the electrodes of a closed device on a spring [m]; 0 where it lands on its electrode.
double closedGap(const DeviceOptions& device) {
  return exceeds(device.electrode_gap, device.travel) ? device.electrode_gap - device.travel : 0.0;
}

/// The length at which a beam is just held, next to a given one: above it where that is free.
/// - @p most above which no beam is free; may be infinite
/// - @p is_free above 0 for a length at which it comes off
template <typename Function>
double lastPositive(double length, double most, const Function& is_free) {
  constexpr double kTolerance = 1e-11;
  constexpr double kFactor = 1.2;
  constexpr double kFarthest = 1e6;  // times the length: held nowhere
  double free = length;
  double stuck = length;
  if (is_free(length) > 0.0) {
    while (stuck < most && is_free(stuck) > 0.0) {
      if (stuck > kFarthest * length) return std::numeric_limits<double>::infinity();
      free = stuck;
      stuck = std::min(most, kFactor * stuck);
    }
  } else {
    while (free > length / kFarthest && !(is_free(free) > 0.0)) {
      stuck = free;
      free /= kFactor;
    }
    if (!(is_free(free) > 0.0)) return 0.0;  // held at any length
  }
  return signChange(free, stuck, kTolerance, is_free);
}

/// By all of the electrode below a closed device; nothing where none is stated.
std::optional<FieldHold> electrodeHold(const DeviceOptions& device,
                                       const InterfaceOptions& interface, double voltage,
                                       double contact_gap) {
  if (const auto electrode = electrodeOf(device, interface))
    return fieldHold(device.beam(), *electrode, voltage, contact_gap);
  if (!device.hasSpring() || !(device.electrode_area > 0.0)) return std::nullopt;
  return FieldHold{device.electrode_area * surface_forces::electrostaticPressure(
                                               closedGap(device) + contact_gap, voltage,
                                               interface.insulator_thickness,
                                               interface.insulator_relative_permittivity),
                   0.0};
}

}  // namespace

double closingVoltage(const DeviceOptions& device, const InterfaceOptions& interface,
                      double contact_potential) {
  const double bare = closingVoltage(device, interface);
  return contact_potential == 0.0 || std::isnan(bare)
             ? bare
             : std::max(0.0, bare - std::abs(contact_potential));
}

std::optional<FieldHold> voltageHold(const DeviceOptions& device, const InterfaceOptions& interface,
                                     const LoadOptions& load, double contact_gap) {
  const auto both = electrodeHold(device, interface, load.fieldVoltage(), contact_gap);
  const auto lasting = electrodeHold(device, interface, load.contact_potential, contact_gap);
  if (!both || !lasting) return std::nullopt;
  return FieldHold{both->force - lasting->force, both->work - lasting->work};
}

FieldHold lastingHold(const DeviceOptions& device, const InterfaceOptions& interface,
                      double contact_potential, double contact_gap) {
  if (contact_potential == 0.0) return {};
  const double gap = std::isnan(contact_gap) ? 0.0 : contact_gap;
  const auto hold = electrodeHold(device, interface, contact_potential, gap);
  if (!hold || !device.hasSpring()) return hold.value_or(FieldHold());
  const double landed = closedGap(device) > 0.0 ? 0.0 : device.contact_area;
  const double share = std::max(0.0, device.electrode_area - landed) / device.electrode_area;
  return {share * hold->force, 0.0};
}

BeamLengths stuckLengths(const DeviceOptions& device, const InterfaceOptions& interface,
                         double contact_potential, double contact_gap, double work) {
  const Beam beam = device.beam();
  const BeamLengths bare{detachmentLength(beam, work), unstuckLength(beam, work)};
  const auto electrode = electrodeOf(device, interface);
  if (contact_potential == 0.0 || !electrode || !(work >= 0.0)) return bare;
  const double gap = std::isnan(contact_gap) ? 0.0 : contact_gap;
  const auto detaches = [&](double length) {
    Beam other = beam;
    other.length = length;
    BeamElectrode below = *electrode;
    below.start *= length / beam.length;
    below.length *= length / beam.length;
    return peelNumber(other, work + fieldHold(other, below, contact_potential, gap).work) - 1.0;
  };
  const auto peels = [&](double arm) {
    const double of_field = stuckFieldHold(beam, *electrode, contact_potential, gap, arm).work;
    return sShapeWork(beam, arm) - work - of_field;
  };
  const double arm = beam.type == BeamType::kCantilever ? beam.length : 0.5 * beam.length;
  return {lastPositive(beam.length, bare.detachment, detaches),
          lastPositive(std::min(arm, bare.unstuck), bare.unstuck, peels)};
}

}  // namespace mems_stiction
