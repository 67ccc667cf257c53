#include "separation/extra_compliance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mems_stiction {
namespace {

/// Points of the table.
constexpr int kPoints = 1024;
constexpr int kHalvings = 60;

}  // namespace

ExtraCompliance::ExtraCompliance(const WaveStiffness& stiffness, double longest, double shortest)
    : contact_modulus_(1.0 / (stiffness.lower().planeCompliance() + stiffness.upper().planeCompliance())),
      first_(std::log(longest)),
      step_(std::log(shortest / longest) / (kPoints - 1)) {
  values_.reserve(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double wave_number = std::exp(first_ + i * step_);
    const double extra = 1.0 / stiffness.modulus(wave_number) - 1.0 / contact_modulus_;
    values_.push_back(std::max(2.0 / wave_number * extra, 0.0));
  }
}

double ExtraCompliance::at(double wave_number) const {
  if (!(wave_number > 0.0)) return 0.0;
  const double place = std::clamp((std::log(wave_number) - first_) / step_, 0.0, kPoints - 1.001);
  const auto below = static_cast<std::size_t>(place);
  const double share = place - static_cast<double>(below);
  return (1.0 - share) * values_[below] + share * values_[below + 1];
}

double ExtraCompliance::cohesiveLength(double of_thick_bodies) const {
  const auto isLong = [&](double q) { return of_thick_bodies * q * stiffnessRatio(q) < 1.0; };
  double low = std::log(1.0 / of_thick_bodies);
  double high = std::max(low, first_ + (kPoints - 1) * step_);
  if (!isLong(std::exp(low))) return of_thick_bodies;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (isLong(std::exp(middle)) ? low : high) = middle;
  }
  return std::exp(-high);
}

}  // namespace mems_stiction
