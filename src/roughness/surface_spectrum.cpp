#include "roughness/surface_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

std::string refusal(const std::string& name, double value, const std::string& allowed) {
  return name + ": " + numberText(value) + " is not allowed; must be " + allowed;
}

/// One line per value of the table that is not a number above 0. Densities are far smaller than
/// what Range takes for sane.
void checkTable(const std::string& name, const std::vector<double>& values,
                std::vector<std::string>& violations) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] > 0.0) || !std::isfinite(values[i])) {
      violations.push_back(
          refusal(name + "[" + std::to_string(i) + "]", values[i], "> 0 and finite"));
    }
  }
}

}  // namespace

double SurfaceSpectrum::densityAt(double q) const {
  if (q > wave_number.back()) return 0.0;
  const auto above = std::upper_bound(wave_number.begin(), wave_number.end(), q);
  if (above == wave_number.begin()) return density.front();
  if (above == wave_number.end()) return density.back();
  const auto i = static_cast<std::size_t>(above - wave_number.begin());
  const double exponent =
      std::log(density[i] / density[i - 1]) / std::log(wave_number[i] / wave_number[i - 1]);
  return density[i - 1] * std::pow(q / wave_number[i - 1], exponent);
}

double SurfaceSpectrum::densityAt(double q_x, double q_y) const {
  const double along = q_x * std::cos(direction) + q_y * std::sin(direction);
  const double across = q_y * std::cos(direction) - q_x * std::sin(direction);
  const double q = std::sqrt(stretch * along * along + across * across / stretch);
  return q > 0.0 ? densityAt(q) : 0.0;
}

double SurfaceSpectrum::variance() const {
  // the integral of C q dq/(2 pi): flat before the first wave number, then one power law after the
  // other
  double sum = 0.5 * density.front() * wave_number.front() * wave_number.front();
  for (std::size_t i = 1; i < wave_number.size(); ++i) {
    const double length = std::log(wave_number[i] / wave_number[i - 1]);
    const double growth = std::log(density[i] / density[i - 1]) + 2.0 * length;
    const double mean = growth == 0.0 ? 1.0 : std::expm1(growth) / growth;
    sum += density[i - 1] * wave_number[i - 1] * wave_number[i - 1] * length * mean;
  }
  return sum / (2.0 * kPi);
}

std::vector<std::string> SurfaceSpectrum::validate(const std::string& prefix) const {
  std::vector<std::string> violations;
  if (wave_number.empty())
    violations.push_back(prefix + "/wave_number: is empty; must have at least one value");
  if (density.size() != wave_number.size()) {
    violations.push_back(prefix + "/density: has " + std::to_string(density.size()) +
                         " values; must have one for each wave number, " +
                         std::to_string(wave_number.size()));
  }
  checkTable(prefix + "/wave_number", wave_number, violations);
  checkTable(prefix + "/density", density, violations);
  for (std::size_t i = 1; i < wave_number.size(); ++i) {
    if (!(wave_number[i] > wave_number[i - 1])) {
      violations.push_back(refusal(prefix + "/wave_number[" + std::to_string(i) + "]",
                                   wave_number[i],
                                   "above the one before it, " + numberText(wave_number[i - 1])));
    }
  }
  const Range stretches{1.0};
  if (!stretches.contains(stretch))
    violations.push_back(refusal(prefix + "/stretch", stretch, stretches.text()));
  if (!Range::any().contains(direction)) {
    violations.push_back(refusal(prefix + "/direction", direction, Range::any().text()));
  }
  return violations;
}

}  // namespace mems_stiction
