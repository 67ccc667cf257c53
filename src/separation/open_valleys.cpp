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
  const double shortest = chosen::kShortestCrack * bodies.cohesiveLength();
  const double longest = chosen::kLongestCrack / bodies.waveNumber();
  if (shortest > longest) return false;
  const double modulus = bodies.contact_modulus;
  const double critical = std::sqrt(2.0 * modulus * bodies.work_of_adhesion);
  const double most_tension = highest(relief.weighed([=](double q) { return -0.5 * modulus * q; }));
  for (double radius = longest; radius >= shortest; radius /= chosen::kNextCrack) {
    const double even = 2.0 * std::sqrt(radius / kPi);              // of an even tension
    if (even * (most_tension - pressure) < critical) return false;  // nor do shorter cracks
    const double scale = modulus / std::sqrt(kPi * radius);
    const double intensity = highest(relief.weighed([=](double q) { return -scale * std::sin(q * radius); }));
    if (intensity - even * pressure >= critical) return true;
  }
  return false;
}

OpenValleyStrength strengthWithOpenValleys(const BondedBodies& bodies) {
  const double ratio = bodies.flattening_energy / bodies.work_of_adhesion;
  const double wave_number = bodies.waveNumber();
  const double brittle = std::sqrt(bodies.contact_modulus * bodies.work_of_adhesion * wave_number);
  const double cohesion = 1.0 + chosen::kCohesion * bodies.cohesiveLength() * wave_number;
  // of sqrt(Gamma U) exp(-2 U/Gamma) with U in proportion to E, over 1 + 0.56 l q with l in proportion to E H/Gamma^2
  const double blunt = 1.0 - 1.0 / cohesion;
  return {chosen::kGriffith * std::exp(-chosen::kDecay * ratio) * brittle / cohesion,
          {0.5 + chosen::kDecay * ratio + 2.0 * blunt, 0.5 - chosen::kDecay * ratio - blunt, -blunt}};
}

}  // namespace mems_stiction
