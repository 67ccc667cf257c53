#include "verdict/beam_field.hpp"

#include <limits>

#include "numeric/constants.hpp"
#include "verdict/bent_beam.hpp"

namespace mems_stiction {
namespace {

constexpr int kLoadSteps = 4;          // of V^2, each from the balance before
constexpr int kMostClosedRounds = 50;  // of Newton's method
constexpr double kClosedBalance = 1e-11;
constexpr double kDiscretisation = 1e-4;  // of the deflection
constexpr double kWithoutEnd = std::numeric_limits<double>::infinity();

/// An arm that is held by h at its end.
class ClosedArm {
 public:
  ClosedArm(const BentBeam& arm, double gap)
      : arm_(arm), gap_(gap), bent_(BentBeam::Vector::Zero(arm.size())) {
    bent_(0) = gap;
  }

  /// False where no balance is found before more of the arm lies on the substrate.
  /// - @p field (1/2) eps0 w V^2 [N m]
  bool balance(double field) {
    const Eigen::Index free = arm_.size() - 1;
    for (int round = 0; round < kMostClosedRounds; ++round) {
      BentBeam::Vector excess = -arm_.resistance(bent_);
      BentBeam::Matrix stiffness = arm_.stiffness(bent_);
      if (field > 0.0) {
        if (!arm_.fieldOf(bent_, of_field_)) return false;
        excess += field * of_field_.pull;
        stiffness -= field * of_field_.slope;
      }
      const Eigen::LLT<BentBeam::Matrix> factors(stiffness.bottomRightCorner(free, free));
      if (factors.info() != Eigen::Success) return false;
      const BentBeam::Vector change = factors.solve(excess.tail(free));
      bent_.tail(free) += change;
      if (!(change.cwiseAbs().maxCoeff() > kClosedBalance * gap_))
        return arm_.deflections(bent_).maxCoeff() <= gap_ * (1.0 + kDiscretisation);
    }
    return false;
  }

  /// What has to hold its end [N], and what its energy loses when it grows [N], after balance().
  FieldHold holdUnder(double field) const {
    FieldHold hold{arm_.resistance(bent_)(0), arm_.release(bent_)};
    if (field > 0.0) {
      hold.force -= field * of_field_.pull(0);
      hold.work -= field * of_field_.growth;
    }
    return hold;
  }

 private:
  const BentBeam& arm_;
  double gap_;
  BentBeam::Vector bent_;
  BentBeam::Field of_field_;
};

/// What the field on one arm adds. - @p field (1/2) eps0 w V^2 [N m]
FieldHold armHold(const BentBeam& arm, const Beam& beam, double field) {
  if (!arm.hasElectrode()) return {};
  ClosedArm closed(arm, beam.gap);
  if (!closed.balance(0.0)) return {kWithoutEnd, kWithoutEnd};
  const FieldHold bare = closed.holdUnder(0.0);
  for (int step = 1; step <= kLoadSteps; ++step) {
    if (!closed.balance(field * step / kLoadSteps)) return {kWithoutEnd, kWithoutEnd};
  }
  const FieldHold left = closed.holdUnder(field);
  return {bare.force - left.force, (bare.work - left.work) / beam.width};
}

/// (1/2) eps0 w V^2 [N m].
double fieldScale(const Beam& beam, double voltage) {
  return 0.5 * kVacuumPermittivity * beam.width * voltage * voltage;
}

double restGap(const BeamElectrode& electrode, double contact_gap) {
  return electrode.gap + electrode.insulator_gap + contact_gap;
}

}  // namespace

FieldHold fieldHold(const Beam& beam, const BeamElectrode& electrode, double voltage,
                    double contact_gap) {
  if (beam.type == BeamType::kNone || voltage == 0.0) return {};
  if (beam.type == BeamType::kDoublyClamped)
    return stuckFieldHold(beam, electrode, voltage, contact_gap, 0.5 * beam.length);
  const BentBeam arm(beam, beam.length, BeamEnd::kResting, electrode.start,
                     electrode.start + electrode.length, restGap(electrode, contact_gap), false);
  return armHold(arm, beam, fieldScale(beam, voltage));
}

FieldHold stuckFieldHold(const Beam& beam, const BeamElectrode& electrode, double voltage,
                         double contact_gap, double unstuck_length) {
  if (beam.type == BeamType::kNone || voltage == 0.0) return {};
  const double end = electrode.start + electrode.length;
  const auto hold = [&](double from, double to) {
    const BentBeam arm(beam, unstuck_length, BeamEnd::kGuided, from, to,
                       restGap(electrode, contact_gap), beam.type == BeamType::kDoublyClamped);
    return armHold(arm, beam, fieldScale(beam, voltage));
  };
  const FieldHold left = hold(electrode.start, end);
  if (beam.type == BeamType::kCantilever) return left;
  const FieldHold right = hold(beam.length - end, beam.length - electrode.start);
  return {left.force + right.force, 0.5 * (left.work + right.work)};
}

}  // namespace mems_stiction
