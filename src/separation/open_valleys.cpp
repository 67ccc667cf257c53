#include "separation/open_valleys.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/constants.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

double highest(const cv::Mat1d& values) {
  double most = 0.0;
  cv::minMaxLoc(values, nullptr, &most);
  return most;
}

double lowest(const cv::Mat1d& values) {
  double least = 0.0;
  cv::minMaxLoc(values, &least, nullptr);
  return least;
}

}  // namespace

bool valleysStayOpen(ReliefSpectrum& relief, const BondedBodies& bodies, double pressure) {
  const double shortest = chosen::kTearingZone * bodies.cohesiveLength();
  const double longest = bodies.longestCrack();
  if (shortest > longest) return false;
  const double modulus = bodies.contact_modulus;
  const double critical = std::sqrt(2.0 * modulus * bodies.work_of_adhesion);
  const double most_tension = highest(relief.weighed([=](double q) { return -0.5 * modulus * q; }));
  for (double radius = longest; radius >= shortest; radius /= chosen::kNextLength) {
    const double even = 2.0 * std::sqrt(radius / kPi);              // of an even tension
    if (even * (most_tension - pressure) < critical) return false;  // nor do shorter cracks
    const double scale = modulus / std::sqrt(kPi * radius);
    const double intensity = highest(relief.weighed([=](double q) { return -scale * std::sin(q * radius); }));
    if (intensity - even * pressure >= critical) return true;
  }
  return false;
}

double strengthAgainstCracks(ReliefSpectrum& relief, const BondedBodies& bodies, double strength, double enough) {
  const double equal_radius = bodies.equalRadius(strength);
  if (!(2.0 * equal_radius < bodies.longestCrack())) return enough;
  const double modulus = bodies.contact_modulus;
  const double length = bodies.cohesiveLength();
  const auto long_part = [=](double q) { return 1.0 / (1.0 + length * q * length * q); };
  // at each place, what the crack around it has needed up to this radius
  cv::Mat1d needed = strength - relief.weighed([=](double q) { return -0.5 * modulus * q * long_part(q); });
  const double half_frame =
      0.5 * std::min(relief.blocks().width * relief.blockWidth(), relief.blocks().height * relief.blockHeight());
  for (double radius = 0.25 * length; radius < half_frame; radius *= chosen::kNextLength) {
    if (lowest(needed) >= enough) return enough;
    const double flat = strength / std::sqrt(1.0 + radius / equal_radius);
    const double scale = 0.5 * modulus / radius;
    const cv::Mat1d& tension = relief.weighed([=](double q) { return -scale * std::sin(q * radius) * long_part(q); });
    needed = cv::max(needed, flat - tension);
  }
  return std::min(lowest(needed), enough);
}

double brittleStrength(const BondedBodies& bodies) {
  const double ratio = bodies.flattening_energy / bodies.work_of_adhesion;
  return std::exp(-chosen::kDecay * ratio) *
         std::sqrt(bodies.contact_modulus * bodies.work_of_adhesion * bodies.waveNumber());
}

}  // namespace mems_stiction
