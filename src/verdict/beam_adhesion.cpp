#include "mems_stiction/verdict/beam_adhesion.hpp"

#include <cmath>
#include <limits>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

constexpr double kNotStated = std::numeric_limits<double>::quiet_NaN();

/// G(s) = bending/s^4 + tension/s^2 of one S-shaped arm.
struct ArmTerms {
  double bending = 0.0;  ///< [J m^2]
  double tension = 0.0;  ///< [J]

  explicit ArmTerms(const Beam& beam) {
    const double stretch = beam.gap / beam.thickness;
    const double plain = 1.5 * beam.modulus * std::pow(beam.thickness, 3) * beam.gap * beam.gap;
    bending =
        beam.type == BeamType::kDoublyClamped ? plain * (1.0 + 0.36 * stretch * stretch) : plain;
    tension = beam.type == BeamType::kDoublyClamped
                  ? 0.6 * beam.residual_stress * beam.thickness * beam.gap * beam.gap
                  : 0.0;
  }

  double work(double length) const {
    const double square = length * length;
    return (bending / square + tension) / square;
  }
  /// The s with work(s) = given work: a quadratic equation in s^2, whose other root is negative.
  double length(double given_work) const {
    if (given_work == 0.0) return std::numeric_limits<double>::infinity();
    const double half = 0.5 * tension / given_work;
    return std::sqrt(half + std::sqrt(half * half + bending / given_work));
  }
};

}  // namespace

double sShapeWork(const Beam& beam, double unstuck_length) {
  return ArmTerms(beam).work(unstuck_length);
}

double arcWork(const Beam& beam, double unstuck_length) {
  return 0.375 * beam.modulus * std::pow(beam.thickness, 3) * beam.gap * beam.gap /
         std::pow(unstuck_length, 4);
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
             ArmTerms(beam).length(work);  // the arc's G is a quarter of the S-shape's
    case BeamType::kDoublyClamped:
      return 2.0 * ArmTerms(beam).length(work);
    case BeamType::kNone:
      break;
  }
  return kNotStated;
}

double beamForce(const Beam& beam) {
  const double plain =
      beam.modulus * beam.width * std::pow(beam.thickness, 3) * beam.gap / std::pow(beam.length, 3);
  switch (beam.type) {
    case BeamType::kCantilever:
      return 0.25 * plain;
    case BeamType::kDoublyClamped: {
      const double stretch = beam.gap / beam.thickness;
      const double slenderness = beam.length / beam.thickness;
      return 16.0 * plain *
             (1.0 + 0.72 * stretch * stretch +
              0.3 * beam.residual_stress / beam.modulus * slenderness * slenderness);
    }
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
  return beam.type == BeamType::kNone ? kNotStated : ArmTerms(beam).length(work);
}

}  // namespace mems_stiction
