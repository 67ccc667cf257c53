/// Peel numbers and lengths against the bending energy by a second route.

#include "mems_stiction/verdict/beam_adhesion.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "support/finite_difference_beam.hpp"

namespace mems_stiction {
namespace {

constexpr double kUm = 1e-6;
constexpr double kRoundOff = 1e-12;

Beam beamOf(BeamType type, double length, double residual_stress = 0.0) {
  return {type, length, 2 * kUm, 2 * kUm, 169e9, residual_stress};
}

/// Energy per width of one clamped-guided arm [J/m]: bending and, if held at both ends, stretching,
/// by the trapezoidal rule over u = h (3 x^2/s^2 - 2 x^3/s^3).
double armEnergy(const Beam& beam, double length) {
  const int count = 20000;
  double bending = 0.0;
  double slope_square = 0.0;
  for (int i = 0; i <= count; ++i) {
    const double x = static_cast<double>(i) / count;
    const double weight = (i == 0 || i == count ? 0.5 : 1.0) / count * length;
    const double curvature = beam.gap * (6.0 - 12.0 * x) / (length * length);
    const double slope = beam.gap * 6.0 * (x - x * x) / length;
    bending += weight * beam.modulus * std::pow(beam.thickness, 3) / 24.0 * curvature * curvature;
    slope_square += weight * slope * slope;
  }
  if (beam.type != BeamType::kDoublyClamped) return bending;
  const double strain = 0.5 * slope_square / length;
  return bending +
         beam.thickness * length * strain * (beam.residual_stress + 0.5 * beam.modulus * strain);
}

TEST(BeamAdhesion, doublyClampedPeelNumberIsNearThatOfTheOnePolynomialShape) {
  // u = 16 h x^2 (l - x)^2/l^4 as trial shape gives, by the same derivative of the energy by l:
  // 128/5 [1 + (2/21) sigma l^2/(E t^2) + (256/735) (h/t)^2]
  const double stress = 20e6;
  const double length = 400 * kUm;
  const Beam beam = beamOf(BeamType::kDoublyClamped, length, stress);
  const double bracket =
      1.0 + 2.0 / 21.0 * stress * length * length / (169e9 * 4e-12) + 256.0 / 735.0;
  const double of_trial_shape =
      25.6 * 169e9 * 8e-18 * 4e-12 / (1e-3 * std::pow(length, 4)) * bracket;
  EXPECT_NEAR(peelNumber(beam, 1e-3), of_trial_shape, 0.07 * of_trial_shape);  // 24 for 25.6: 6.7 %
}

TEST(BeamAdhesion, workIsMinusTheDerivativeOfTheArmsEnergy) {
  for (const BeamType type : {BeamType::kCantilever, BeamType::kDoublyClamped}) {
    for (const double stress : {0.0, 50e6, -5e6}) {
      Beam beam = beamOf(type, 400 * kUm, stress);
      beam.gap = 3 * kUm;  // not the thickness, so that no power of h/t is lost
      const double s = 170 * kUm;
      const double step = 1e-4 * s;
      const double slope = (armEnergy(beam, s - step) - armEnergy(beam, s + step)) / (2.0 * step);
      EXPECT_NEAR(sShapeWork(beam, s), slope,
                  1e-6 * slope);  // central difference: 1e-8; trapezoidal rule: 1e-8
    }
  }
}

TEST(BeamAdhesion, lengthsAreTheInverses) {
  const double work = 3e-4;
  for (const BeamType type : {BeamType::kCantilever, BeamType::kDoublyClamped}) {
    for (const double stress : {0.0, 80e6, -10e6}) {
      Beam beam = beamOf(type, 1.0, stress);
      EXPECT_NEAR(sShapeWork(beam, unstuckLength(beam, work)), work, kRoundOff);
      beam.length = detachmentLength(beam, work);
      EXPECT_NEAR(peelNumber(beam, work), 1.0, kRoundOff);
      beam.length *= 1.01;
      EXPECT_LT(peelNumber(beam, work), 1.0);  // a longer beam sticks
    }
  }
}

TEST(BeamAdhesion, tensionHelpsAndCompressionHoldsDoublyClampedBeamsOnly) {
  const double length = 300 * kUm;
  const double plain = peelNumber(beamOf(BeamType::kDoublyClamped, length), 1e-3);
  EXPECT_GT(peelNumber(beamOf(BeamType::kDoublyClamped, length, 10e6), 1e-3), plain);
  EXPECT_LT(peelNumber(beamOf(BeamType::kDoublyClamped, length, -10e6), 1e-3), plain);
  EXPECT_EQ(peelNumber(beamOf(BeamType::kCantilever, length, 10e6), 1e-3),
            peelNumber(beamOf(BeamType::kCantilever, length), 1e-3));
}

TEST(BeamAdhesion, withoutAdhesionEveryBeamComesOff) {
  for (const BeamType type : {BeamType::kCantilever, BeamType::kDoublyClamped}) {
    const Beam beam = beamOf(type, 300 * kUm);
    EXPECT_TRUE(std::isinf(peelNumber(beam, 0.0)));
    EXPECT_TRUE(std::isinf(detachmentLength(beam, 0.0)));
    EXPECT_TRUE(std::isinf(unstuckLength(beam, 0.0)));
  }
}

TEST(BeamAdhesion, noBeamHasNoFigures) {
  EXPECT_TRUE(std::isnan(peelNumber(Beam(), 1e-3)));
  EXPECT_TRUE(std::isnan(detachmentLength(Beam(), 1e-3)));
  EXPECT_TRUE(std::isnan(unstuckLength(Beam(), 1e-3)));
}

TEST(BeamAdhesion, forceIsTheDerivativeOfTheEnergyByTheGap) {
  for (const BeamType type : {BeamType::kCantilever, BeamType::kDoublyClamped}) {
    for (const double stress : {0.0, 50e6}) {
      Beam beam = beamOf(type, 400 * kUm, stress);
      beam.width = 20 * kUm;
      beam.gap = 3 * kUm;
      const auto energyAt = [&](double gap) {
        Beam bent = beam;
        bent.gap = gap;
        // a cantilever touches with its tip alone: a quarter of the energy of an S
        return type == BeamType::kCantilever
                   ? 0.25 * beam.width * armEnergy(bent, beam.length)
                   : 2.0 * beam.width * armEnergy(bent, 0.5 * beam.length);
      };
      const double step = 1e-4 * beam.gap;
      const double slope = (energyAt(beam.gap + step) - energyAt(beam.gap - step)) / (2.0 * step);
      EXPECT_NEAR(beamForce(beam) / slope, 1.0, 1e-6);
    }
  }
  EXPECT_EQ(beamForce(beamOf(BeamType::kCantilever, 400 * kUm)), 0.0) << "without a width";
}

TEST(BeamAdhesion, peelLengthIsWhatTheEndOfABondedBeamCarriesOverItsPressure) {
  // a long bonded beam, pulled by a line force at its free end, until the foundation there gives
  // way
  Beam beam = beamOf(BeamType::kCantilever, 400 * kUm);
  beam.width = 20 * kUm;
  const double work = 2e-4;
  const double pressure = 1e4;
  const FiniteDifferenceBeam differences(beam, 400);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(differences.nodes());
  const double force = 1e-6;
  load(differences.nodes() - 1) = force / (0.5 * differences.step());
  const double stiffness = pressure * pressure / (2.0 * work);
  const Eigen::VectorXd bent =
      differences.solve(differences.matrix(0.0, stiffness * beam.width), load);
  const double range = 2.0 * work / pressure;
  const double force_at_failure = force * range / bent(differences.nodes() - 1);
  EXPECT_NEAR(force_at_failure / (pressure * beam.width) / peelLength(beam, work, pressure), 1.0,
              0.02);
}

}  // namespace
}  // namespace mems_stiction
