#include "mems_stiction/separation/open_valleys.hpp"

#include <algorithm>
#include <cmath>

#include "mems_stiction/base/constants.hpp"

namespace mems_stiction {
namespace {

/// Shortest cracks, of the cohesive length, and longest ones, over the mean wave number and of the frame's side.
constexpr double kShortestCrack = 2.0;
constexpr double kLongestCrack = 4.0;
constexpr double kLongestShare = 0.5;
/// From one crack to the next: in between, what opens a valley most is missed by 2 %.
constexpr double kNextCrack = 1.5;
/// K at which a valley stays open, of Irwin's: a crack that is not round, as most are not, opens a little earlier than
/// the round ones that are tried.
constexpr double kRoundness = 0.95;

/// of F/A
constexpr double kGriffith = 0.85;
constexpr double kDecay = 2.0;
constexpr double kCohesion = 0.56;

double highest(const cv::Mat1d& values) {
  double most = 0.0;
  cv::minMaxLoc(values, nullptr, &most);
  return most;
}

}  // namespace

bool valleysStayOpen(ReliefSpectrum& relief, const BondedBodies& bodies, double pressure) {
  const double shortest = kShortestCrack * bodies.cohesiveLength();
  const double longest = std::min(kLongestCrack / bodies.waveNumber(), kLongestShare * relief.shorterSide());
  if (shortest > longest) return false;
  const double modulus = bodies.contact_modulus;
  const double critical = kRoundness * std::sqrt(2.0 * modulus * bodies.work_of_adhesion);
  const double most_tension = highest(relief.weighed([=](double q) { return -0.5 * modulus * q; }));
  for (double radius = longest; radius >= shortest; radius /= kNextCrack) {
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
  const double cohesion = 1.0 + kCohesion * bodies.cohesiveLength() * wave_number;
  // of sqrt(Gamma U) exp(-2 U/Gamma) with U in proportion to E, over 1 + 0.56 l q with l in proportion to E H/Gamma^2
  const double blunt = 1.0 - 1.0 / cohesion;
  return {kGriffith * std::exp(-kDecay * ratio) * brittle / cohesion,
          {0.5 + kDecay * ratio + 2.0 * blunt, 0.5 - kDecay * ratio - blunt, -blunt}};
}

}  // namespace mems_stiction
