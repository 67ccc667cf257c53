#include "verdict/beam_electrode.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "numeric/constants.hpp"
#include "numeric/rounding.hpp"
#include "verdict/bent_beam.hpp"

namespace mems_stiction {
namespace {

constexpr int kAmplitudes = 100;        // between rest and landing; the maximum of V(a) is flat
constexpr int kMostDescentRounds = 30;  // of Newton's method
constexpr double kFollowed = 1e-8;

/// The shape under a field of which no deflection changes it, of any size.
BentBeam::Vector firstShape(const BentBeam& beam) {
  BentBeam::Vector straight = BentBeam::Vector::Zero(beam.size());
  BentBeam::Field field;
  if (!beam.fieldOf(straight, field)) return straight;
  return beam.stiffness(straight).ldlt().solve(field.pull);
}

/// Follows the beam down by the deflection of one place.
class Descent {
 public:
  explicit Descent(const BentBeam& beam) : beam_(beam), bent_(firstShape(beam)) {
    Eigen::Index place = 0;
    beam_.deflections(bent_).maxCoeff(&place);
    shapes_ = beam_.shapesAt(static_cast<int>(place));
  }

  /// (1/2) eps0 w V^2 that holds the place at a deflection [N m]; nothing where nothing does.
  std::optional<double> fieldAt(double deflection) {
    const double before = shapes_.dot(bent_);
    if (!(before > 0.0)) return std::nullopt;
    bent_ *= deflection / before;
    const int size = beam_.size();
    BentBeam::Matrix matrix = BentBeam::Matrix::Zero(size + 1, size + 1);
    BentBeam::Vector excess = BentBeam::Vector::Zero(size + 1);
    for (int round = 0; round < kMostDescentRounds; ++round) {
      BentBeam::Field field;
      if (!beam_.fieldOf(bent_, field)) return std::nullopt;
      if (!has_field_) field_ = bent_.dot(beam_.resistance(bent_)) / bent_.dot(field.pull);
      has_field_ = true;
      excess.head(size) = field_ * field.pull - beam_.resistance(bent_);
      excess(size) = deflection - shapes_.dot(bent_);
      matrix.topLeftCorner(size, size) = beam_.stiffness(bent_) - field_ * field.slope;
      matrix.topRightCorner(size, 1) = -field.pull;
      matrix.bottomLeftCorner(1, size) = shapes_.transpose();
      const BentBeam::Vector change = matrix.partialPivLu().solve(excess);
      if (!change.allFinite()) return std::nullopt;
      bent_ += change.head(size);
      field_ += change(size);
      const double moved = beam_.deflections(change.head(size)).cwiseAbs().maxCoeff();
      if (moved <= kFollowed * deflection && std::abs(change(size)) <= kFollowed * std::abs(field_))
        return field_;
    }
    return std::nullopt;
  }

  double deepest() const { return beam_.deflections(bent_).maxCoeff(); }

 private:
  const BentBeam& beam_;
  BentBeam::Vector bent_;
  BentBeam::Vector shapes_;  ///< of the place that is followed
  double field_ = 0.0;
  bool has_field_ = false;
};

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
  const bool is_clamped = beam.type == BeamType::kDoublyClamped;
  const double gap = electrode.gap + electrode.insulator_gap;
  const BentBeam bent(beam, beam.length, is_clamped ? BeamEnd::kClamped : BeamEnd::kFree,
                      electrode.start, electrode.start + electrode.length, gap, is_clamped);
  if (!bent.hasElectrode()) return std::numeric_limits<double>::quiet_NaN();
  Descent descent(bent);
  double most = 0.0;
  for (int i = 1; i <= kAmplitudes; ++i) {
    const double amplitude = beam.gap * i / kAmplitudes;
    if (amplitude >= gap) break;  // the field there grows beyond all bounds
    const std::optional<double> field = descent.fieldAt(amplitude);
    if (!field || exceeds(descent.deepest(), beam.gap)) break;
    most = std::max(most, *field);
  }
  return std::sqrt(2.0 * most / (kVacuumPermittivity * beam.width));
}

}  // namespace mems_stiction
