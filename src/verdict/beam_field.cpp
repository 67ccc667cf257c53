#include "verdict/beam_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "numeric/constants.hpp"
#include "verdict/beam_shape.hpp"

namespace mems_stiction {
namespace {

constexpr int kArmCells =
    1000;  // along an arm; the gap is linear within each, which is right to 1e-4
constexpr int kMostRounds = 500;  // of the balance: near the end of what balances it creeps
constexpr double kBalanced = 1e-9;
constexpr double kDiscretisation = 1e-4;  // of the deflection

/// The shape of an arm, and how it changes as the arm grows.
struct ArmShape {
  double deflection = 0.0;  ///< phi [-]
  double slope = 0.0;       ///< phi'(xi) [-]
  double curvature = 0.0;   ///< phi''(xi) [-]
};

enum class Bend { kArc, kS };

ArmShape armShape(Bend bend, double xi) {
  if (bend == Bend::kArc)
    return {xi * xi * (1.5 - 0.5 * xi), xi * (3.0 - 1.5 * xi), 3.0 - 3.0 * xi};
  return {xi * xi * (3.0 - 2.0 * xi), 6.0 * xi * (1.0 - xi), 6.0 - 12.0 * xi};
}

/// An arm that is held by h at its end, above a part of the electrode; its edges are those of
/// kArmCells cells from the clamp.
class ClosedArm {
 public:
  /// - @p length s [m]
  /// - @p from, to where the electrode lies, from the clamp [m]
  /// - @p rest_gap between beam and electrode at rest, with insulator and contact [m]
  ClosedArm(const Beam& beam, Bend bend, double length, double from, double to, double rest_gap)
      : beam_(beam),
        length_(length),
        from_(std::clamp(from, 0.0, length)),
        to_(std::clamp(to, 0.0, length)),
        rest_gap_(rest_gap),
        step_(length / kArmCells) {
    Beam arm = beam;
    arm.length = length;
    // an S has no slope at both ends
    arm.type = bend == Bend::kArc ? BeamType::kCantilever : BeamType::kDoublyClamped;
    const BeamShape free = shapeUnder(arm, from_, to_ - from_, kArmCells);
    const double lifted = bend == Bend::kArc ? free.at_edges.back() : 0.0;
    double bending = 0.0;
    double stretch = 0.0;
    for (std::size_t cell = 0; cell < free.curvature.size(); ++cell) {
      const ArmShape shape = armShape(bend, (static_cast<double>(cell) + 0.5) / kArmCells);
      const double curvature = free.curvature[cell] - lifted * shape.curvature / (length * length);
      const double slope = free.slope[cell] - lifted * shape.slope / length;
      bending += curvature * curvature * step_;
      stretch += slope * slope * step_;
    }
    for (int edge = 0; edge <= kArmCells; ++edge) {
      const double xi = static_cast<double>(edge) / kArmCells;
      const ArmShape shape = armShape(bend, xi);
      phi_.push_back(shape.deflection);
      spread_.push_back(xi * shape.slope);
      psi_.push_back(free.at_edges[static_cast<std::size_t>(edge)] - lifted * shape.deflection);
    }
    const double section = beam.width * beam.thickness;
    stiffness_ = beam.modulus * section * beam.thickness * beam.thickness / 12.0 * bending;
    if (beam.type == BeamType::kDoublyClamped) {
      const double strain = 0.6 * beam.gap * beam.gap / (length * length);
      stiffness_ += section * (beam.residual_stress + beam.modulus * strain) * stretch;
    }
  }

  /// What the field on this arm adds. - @p field (1/2) eps0 V^2 [N]
  FieldHold under(double field) const {
    if (!(to_ > from_)) return {};
    double amplitude = 0.0;
    for (int round = 0; round < kMostRounds && isAbove(amplitude); ++round) {
      const double next = field * beam_.width * sum(psi_, amplitude) / stiffness_;
      if (!(next >= 0.0)) break;  // compressed beyond its stiffness
      if (std::abs(next - amplitude) <= kBalanced * next) {
        return {field * beam_.width * sum(phi_, next),
                field * beam_.gap / length_ * sum(spread_, next)};
      }
      amplitude = next;
    }
    constexpr double kWithoutEnd = std::numeric_limits<double>::infinity();
    return {kWithoutEnd, kWithoutEnd};
  }

 private:
  double deflectionAt(std::size_t edge, double amplitude) const {
    return beam_.gap * phi_[edge] + amplitude * psi_[edge];
  }

  /// It does not lie on the substrate before its end.
  bool isAbove(double amplitude) const {
    for (std::size_t edge = 0; edge < phi_.size(); ++edge) {
      if (deflectionAt(edge, amplitude) > beam_.gap * (1.0 + kDiscretisation)) return false;
    }
    return true;
  }

  /// Integral of a weight, given at the edges, over d^2 along the electrode.
  double sum(const std::vector<double>& weight, double amplitude) const {
    double total = 0.0;
    for (std::size_t cell = 0; cell + 1 < phi_.size(); ++cell) {
      const double begin = static_cast<double>(cell) * step_;
      const double first = std::max(begin, from_);
      const double last = std::min(begin + step_, to_);
      if (!(last > first)) continue;
      const double gap = rest_gap_ - deflectionAt(cell, amplitude);
      const double rise =
          (deflectionAt(cell, amplitude) - deflectionAt(cell + 1, amplitude)) / step_;
      const double middle = (0.5 * (first + last) - begin) / step_;
      const double of_middle = (1.0 - middle) * weight[cell] + middle * weight[cell + 1];
      total += of_middle * (last - first) /
               ((gap + rise * (first - begin)) * (gap + rise * (last - begin)));
    }
    return total;
  }

  Beam beam_;
  double length_;  ///< s [m]
  double from_;
  double to_;
  double rest_gap_;
  double step_;             ///< of the cells [m]
  double stiffness_ = 0.0;  ///< of b, on the scale of psi
  std::vector<double> phi_;
  std::vector<double> spread_;  ///< xi phi'(xi) [-]
  std::vector<double> psi_;     ///< without a scale
};

double restGap(const BeamElectrode& electrode, double contact_gap) {
  return electrode.gap + electrode.insulator_gap + contact_gap;
}

}  // namespace

FieldHold fieldHold(const Beam& beam, const BeamElectrode& electrode, double voltage,
                    double contact_gap) {
  if (beam.type == BeamType::kNone || voltage == 0.0) return {};
  if (beam.type == BeamType::kDoublyClamped)
    return stuckFieldHold(beam, electrode, voltage, contact_gap, 0.5 * beam.length);
  const double end = electrode.start + electrode.length;
  return ClosedArm(beam, Bend::kArc, beam.length, electrode.start, end,
                   restGap(electrode, contact_gap))
      .under(0.5 * kVacuumPermittivity * voltage * voltage);
}

FieldHold stuckFieldHold(const Beam& beam, const BeamElectrode& electrode, double voltage,
                         double contact_gap, double unstuck_length) {
  if (beam.type == BeamType::kNone || voltage == 0.0) return {};
  const double field = 0.5 * kVacuumPermittivity * voltage * voltage;
  const double end = electrode.start + electrode.length;
  const auto arm = [&](double from, double to) {
    return ClosedArm(beam, Bend::kS, unstuck_length, from, to, restGap(electrode, contact_gap))
        .under(field);
  };
  const FieldHold left = arm(electrode.start, end);
  if (beam.type == BeamType::kCantilever) return left;
  const FieldHold right = arm(beam.length - end, beam.length - electrode.start);
  return {left.force + right.force, 0.5 * (left.work + right.work)};
}

}  // namespace mems_stiction
