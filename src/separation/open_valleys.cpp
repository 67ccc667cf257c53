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

}  // namespace

bool valleysStayOpen(ReliefSpectrum& relief, const BondedBodies& bodies, double pressure) {
  const double shortest = chosen::kTearingZone * bodies.cohesiveLength();
  const double longest = kPi / bodies.waveNumber();
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

double brittleStrength(const BondedBodies& bodies) {
  const double ratio = bodies.flattening_energy / bodies.work_of_adhesion;
  return std::exp(-chosen::kDecay * ratio) *
         std::sqrt(bodies.contact_modulus * bodies.work_of_adhesion * bodies.waveNumber());
}

}  // namespace mems_stiction
