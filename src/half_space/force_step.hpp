#pragma once

/// @file
/// What is the force between two heights whose states are known?
///
/// As dE/dZ = F between jumps, the energies of both states give the mean force over the step, and
/// their forces its ends. The force is the parabola with these three. Of pressed bodies, whose
/// force grows like a power of the height and may do so fivefold over a step, its logarithm is one.
///
///     const StepParabola parabola(before, after);
///     // where the force vanishes, of the step
///     const double share = crossing(parabola, 0.0, 0.0, 1.0);

#include <cmath>

#include "mems_stiction/half_space/half_space_solution.hpp"

namespace mems_stiction {

/// The force over a step, over x from 0 at its begin to 1 at its end.
struct StepParabola {
  StepParabola() = default;
  StepParabola(const ForcePoint& from, const ForcePoint& to);

  double at(double x) const { return begin + x * (slope() + x * bend()); }
  /// Its integral from 0 to x.
  double workTo(double x) const { return x * (begin + x * (slope() / 2.0 + x * bend() / 3.0)); }
  double slope() const { return 6.0 * mean - 4.0 * begin - 2.0 * end; }
  double bend() const { return 3.0 * (begin + end) - 6.0 * mean; }
  /// Where it is highest, 0 to 1.
  double summit() const;
  /// How far the mean lies from that of both ends [N].
  double curvatureError() const { return std::abs(mean - 0.5 * (begin + end)); }
  /// Share of the step over which the bodies attract each other.
  double attractingShare() const;

  double begin = 0.0;  ///< [N]
  double end = 0.0;    ///< [N]
  double mean = 0.0;   ///< [N]
};

/// The same of bodies that are pressed all the way: the logarithm is a parabola.
class PressedStep {
 public:
  /// @param parabola one that fits
  explicit PressedStep(const StepParabola& parabola);
  static bool fits(const StepParabola& parabola) {
    return parabola.begin < 0.0 && parabola.end < 0.0;
  }

  double at(double x) const;
  double workTo(double x) const;  ///< by Simpson's rule

 private:
  double begin_;
  double rise_;
  double bend_ = 0.0;
};

/// x between `from`, where `curve` is above `force`, and `to`, where it is below; `to` if it is
/// above there, too.
template <typename Curve>
double crossing(const Curve& curve, double force, double from, double to) {
  constexpr int kHalvings = 30;
  if (!(curve.at(to) < force)) return to;
  for (int halvings = 0; halvings < kHalvings; ++halvings) {
    const double middle = 0.5 * (from + to);
    (curve.at(middle) > force ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

}  // namespace mems_stiction
