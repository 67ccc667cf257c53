#include "mems_stiction/verdict/beam_adhesion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/bisection.hpp"
#include "numeric/constants.hpp"
#include "verdict/guided_arm.hpp"

namespace mems_stiction {
namespace {

constexpr double kNotStated = std::numeric_limits<double>::quiet_NaN();

/// G s^4 of an S-shaped arm that bends alone [J m^2].
double bendingTerm(const Beam& beam) {
  return 1.5 * beam.modulus * std::pow(beam.thickness, 3) * beam.gap * beam.gap;
}

/// Half of the length of a beam that buckles under its residual stress [m]; infinite under tension.
double bucklingLength(const Beam& beam) {
  if (!(beam.residual_stress < 0.0)) return std::numeric_limits<double>::infinity();
  return kPi * beam.thickness * std::sqrt(beam.modulus / (-12.0 * beam.residual_stress));
}

/// The s with sShapeWork(s) = given work, > 0: the work falls with s up to where a beam buckles,
/// where the search ends.
double armLength(const Beam& beam, double work) {
  const double plain = std::sqrt(std::sqrt(bendingTerm(beam) / work));
  if (beam.type != BeamType::kDoublyClamped) return plain;
  constexpr double kFactor = 1.5;
  const double longest = bucklingLength(beam);
  double low = std::min(plain, longest);
  double high = low;
  while (sShapeWork(beam, low) < work) low /= kFactor;
  while (high < longest && sShapeWork(beam, high) > work) high = std::min(longest, kFactor * high);
  if (sShapeWork(beam, high) > work) return longest;
  return signChange(low, high, 0.0, [&](double length) { return sShapeWork(beam, length) - work; });
}

}  // namespace

double sShapeWork(const Beam& beam, double unstuck_length) {
  return beam.type == BeamType::kDoublyClamped ? guidedArm(beam, unstuck_length).work
                                               : bendingTerm(beam) / std::pow(unstuck_length, 4);
}

double arcWork(const Beam& beam, double unstuck_length) {
  return 0.25 * bendingTerm(beam) / std::pow(unstuck_length, 4);
}

double bucklingStress(const Beam& beam) {
  if (beam.type != BeamType::kDoublyClamped) return -std::numeric_limits<double>::infinity();
  const double slenderness = beam.length / beam.thickness;
  return -kPi * kPi * beam.modulus / (3.0 * slenderness * slenderness);
}

double peelNumber(const Beam& beam, double work) {
  switch (beam.type) {
    case BeamType::kCantilever:
      return arcWork(beam, beam.length) / work;
    case BeamType::kDoublyClamped:
      return sShapeWork(beam, 0.5 * beam.length) / work;
    case BeamType::kNone:
      break;
  }
  return kNotStated;
}

double detachmentLength(const Beam& beam, double work) {
  switch (beam.type) {
    case BeamType::kCantilever:
      return std::sqrt(0.5) *
             unstuckLength(beam, work);  // the arc's G is a quarter of the S-shape's
    case BeamType::kDoublyClamped:
      return 2.0 * unstuckLength(beam, work);
    case BeamType::kNone:
      break;
  }
  return kNotStated;
}

double beamForce(const Beam& beam) {
  switch (beam.type) {
    case BeamType::kCantilever:
      return 0.25 * beam.modulus * beam.width * std::pow(beam.thickness / beam.length, 3) *
             beam.gap;
    case BeamType::kDoublyClamped:
      return 2.0 * beam.width * guidedArm(beam, 0.5 * beam.length).force;
    case BeamType::kNone:
      break;
  }
  return kNotStated;
}

double peelLength(const Beam& beam, double work, double pressure) {
  return 0.5 * std::pow(2.0 * beam.modulus * std::pow(beam.thickness, 3) * work /
                            (3.0 * pressure * pressure),
                        0.25);
}

double unstuckLength(const Beam& beam, double work) {
  if (beam.type == BeamType::kNone || std::isnan(work)) return kNotStated;
  return work > 0.0 ? armLength(beam, work) : std::numeric_limits<double>::infinity();
}

}  // namespace mems_stiction
