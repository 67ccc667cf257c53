#include "half_space/force_step.hpp"

#include <algorithm>
#include <cmath>

namespace mems_stiction {
namespace {

/// Bounds of the bend of a logarithm, and how often they are halved.
constexpr double kSteepest = 4.0;
constexpr int kBendHalvings = 30;
/// Pieces of Simpson's rule.
constexpr int kPieces = 16;

}  // namespace

StepParabola::StepParabola(const ForcePoint& from, const ForcePoint& to)
    : begin(from.force),
      end(to.force),
      mean((to.energy - from.energy) / (to.height - from.height)) {}

double StepParabola::summit() const {
  if (bend() < 0.0) return std::clamp(-0.5 * slope() / bend(), 0.0, 1.0);
  return end > begin ? 1.0 : 0.0;
}

double StepParabola::attractingShare() const {
  if (begin > 0.0) return end > 0.0 ? 1.0 : crossing(*this, 0.0, 0.0, 1.0);
  return end > 0.0 ? 1.0 - crossing(*this, 0.0, 1.0, 0.0) : 0.0;
}

PressedStep::PressedStep(const StepParabola& parabola)
    : begin_(std::log(-parabola.begin)), rise_(std::log(-parabola.end) - begin_) {
  double low = -kSteepest;
  double high = kSteepest;
  for (int halvings = 0; halvings < kBendHalvings; ++halvings) {
    bend_ = 0.5 * (low + high);
    (workTo(1.0) < parabola.mean ? high : low) = bend_;  // the more bend, the more pressure
  }
}

double PressedStep::at(double x) const {
  return -std::exp(begin_ + x * (rise_ + (1.0 - x) * bend_));
}

double PressedStep::workTo(double x) const {
  double sum = at(0.0) + at(x);
  for (int i = 1; i < kPieces; ++i) sum += (i % 2 == 0 ? 2.0 : 4.0) * at(x * i / kPieces);
  return sum * x / (3.0 * kPieces);
}

}  // namespace mems_stiction
