#pragma once

/// @file
/// Where does a function change its sign?

#include <cmath>

namespace mems_stiction {

/// A place between `low` and `high` where the sign changes: by false position with Illinois's
/// weights, every third step halves.
/// - @p function of a double, of different signs at both ends; the sign at `low` is the one that
///   stays there; infinite values are halved away
/// - @p tolerance of the place, relative to the larger of both ends' sizes [-]
template <typename Function>
double signChange(double low, double high, double tolerance, const Function& function) {
  double at_low = function(low);
  double at_high = function(high);
  const bool is_positive = at_low > 0.0;
  const double scale = std::fmax(std::abs(low), std::abs(high));
  bool was_low = false;
  for (int step = 0; high - low > tolerance * scale; ++step) {
    double place = low - at_low * (high - low) / (at_high - at_low);
    if (step % 3 == 2 || !(place > low && place < high)) place = 0.5 * (low + high);
    if (place == low || place == high) break;
    const double value = function(place);
    if (value == 0.0) return place;
    const bool is_low = (value > 0.0) == is_positive;
    (is_low ? low : high) = place;
    (is_low ? at_low : at_high) = value;
    if (step > 0 && is_low == was_low) (is_low ? at_high : at_low) *= 0.5;
    was_low = is_low;
  }
  return 0.5 * (low + high);
}

}  // namespace mems_stiction
