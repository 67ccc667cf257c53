/// Peel numbers and lengths against the bending energy by a second route.

#include "mems_stiction/verdict/beam_adhesion.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"
#include "support/finite_difference_beam.hpp"

namespace mems_stiction {
namespace {

constexpr double kUm = 1e-6;
constexpr double kRoundOff = 1e-12;

Beam beamOf(BeamType type, double length, double residual_stress = 0.0) {
  return {type, length, 2 * kUm, 2 * kUm, 169e9, residual_stress};
}

/// A doubly clamped beam whose middle is held down by its gap, by finite differences; the tension
/// by bisection.
struct HeldMiddle {
  double force = 0.0;   ///< per width [N/m]
  double energy = 0.0;  ///< of one arm, per width [J/m]

  explicit HeldMiddle(const Beam& beam, double arm) {
    constexpr int kCells = 160;
    Beam whole = beam;
    whole.type = BeamType::kDoublyClamped;
    whole.length = 2.0 * arm;
    whole.width = 1.0;
    const FiniteDifferenceBeam differences(whole, kCells);
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(kCells);
    unit(kCells / 2 - 1) = 1.0 / differences.step();
    Eigen::VectorXd bent;
    const double buckling = 4.0 * kPi * kPi * differences.rigidity() / (4.0 * arm * arm);
    double low = -0.999 * buckling;
    double high =
        2.0 * whole.thickness *
        (std::abs(beam.residual_stress) + beam.modulus * beam.gap * beam.gap / (arm * arm));
    for (int round = 0; round < 40; ++round) {
      const double tension = 0.5 * (low + high);
      bent = differences.solve(differences.matrix(tension, 0.0), unit);
      force = beam.gap / bent(kCells / 2 - 1);
      bent *= force;
      (tension < differences.axialForce(bent) ? low : high) = tension;
    }
    double curved = 0.0;
    const auto at = [&](int node) {
      node = std::min(std::abs(node), 2 * kCells - std::abs(node));  // no slope at the clamps
      return node == 0 || node == kCells ? 0.0 : bent(node - 1);
    };
    for (int node = 0; node <= kCells; ++node) {
      const double curvature =
          (at(node - 1) - 2.0 * at(node) + at(node + 1)) / std::pow(differences.step(), 2);
      curved += (node == 0 || node == kCells ? 0.5 : 1.0) * curvature * curvature;
    }
    const double strain =
        (differences.axialForce(bent) / whole.thickness - beam.residual_stress) / beam.modulus;
    energy = 0.25 * differences.rigidity() * curved * differences.step() +
             whole.thickness * arm * strain * (beam.residual_stress + 0.5 * beam.modulus * strain);
  }
};

/// Gaps and stresses from hardly stretched to a membrane.
std::vector<Beam> doublyClampedBeams() {
  std::vector<Beam> beams;
  for (const double gap : {0.2, 2.0, 5.0, 20.0}) {
    for (const double stress : {0.0, -8e6, 50e6, 1e9}) {
      beams.push_back(beamOf(BeamType::kDoublyClamped, 400 * kUm, stress));
      beams.back().gap = gap * kUm;
      beams.back().width = 20 * kUm;
    }
  }
  return beams;
}

/// Finite differences of 80 cells along an arm whose ends bend over a tenth of it, and less.
constexpr double kDifferences = 0.01;

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
  for (Beam beam : doublyClampedBeams()) {
    for (const BeamType type : {BeamType::kCantilever, BeamType::kDoublyClamped}) {
      beam.type = type;
      const double s = 170 * kUm;
      const double step = 1e-2 * s;
      Beam bending = beam;  // as stiff, and not stretched
      bending.thickness *= 1e4;
      bending.modulus *= 1e-12;
      bending.residual_stress = 0.0;
      const Beam& held = type == BeamType::kCantilever ? bending : beam;
      const double slope =
          (HeldMiddle(held, s - step).energy - HeldMiddle(held, s + step).energy) / (2.0 * step);
      EXPECT_NEAR(sShapeWork(beam, s) / slope, 1.0, kDifferences)
          << static_cast<int>(type) << ", gap " << beam.gap << ", " << beam.residual_stress;
    }
  }
}

TEST(BeamAdhesion, ofSmallGapsAndStressesStretchesAsTheShapeOfPureBendingDoes) {
  // to first order the shape does not count: (18/25) (h/t)^2 and (3/10) sigma l^2/(E t^2) of the
  // force, (9/25) (h/t)^2 and sigma l^2/(10 E t^2) of the peel number
  for (const double stress : {0.0, 2e4, -2e4}) {
    for (const double ratio : {1e-6, 0.01}) {
      Beam beam = beamOf(BeamType::kDoublyClamped, 400 * kUm, stress);
      beam.width = 20 * kUm;
      beam.gap = ratio * beam.thickness;
      const double stretched = ratio * ratio;
      const double stressed = stress / beam.modulus * std::pow(beam.length / beam.thickness, 2);
      const double second_order = std::pow(stretched + std::abs(stressed), 2) + kRoundOff;
      const double cubed = beam.modulus * std::pow(beam.thickness, 3) * beam.gap;
      EXPECT_NEAR(beamForce(beam) / (16.0 * beam.width * cubed / std::pow(beam.length, 3)),
                  1.0 + 0.72 * stretched + 0.3 * stressed, second_order);
      EXPECT_NEAR(
          peelNumber(beam, 1e-3) / (24.0 * cubed * beam.gap / (1e-3 * std::pow(beam.length, 4))),
          1.0 + 0.36 * stretched + 0.1 * stressed, second_order);
    }
  }
}

TEST(BeamAdhesion, ofLargeGapsIsAMembrane) {
  // two straight strings of the strain e = 2 h^2/l^2: F = 2 w t E e 2 h/l, G = (3/2) t E e^2
  Beam beam = beamOf(BeamType::kDoublyClamped, 400 * kUm);
  beam.width = 20 * kUm;
  beam.thickness = 1e-3 * beam.gap;
  const double strain = 2.0 * std::pow(beam.gap / beam.length, 2);
  const double of_ends = 3e-3;  // the ends bend over t/h of the arm
  EXPECT_NEAR(beamForce(beam) / (4.0 * beam.width * beam.thickness * beam.modulus * strain *
                                 beam.gap / beam.length),
              1.0, of_ends);
  EXPECT_NEAR(
      peelNumber(beam, 1e-3) / (1.5 * beam.thickness * beam.modulus * strain * strain / 1e-3), 1.0,
      of_ends);
}

TEST(BeamAdhesion, lengthsAreTheInverses) {
  const double work = 1e-2;
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

TEST(BeamAdhesion, lengthsOfCompressedBeamsEndWhereTheyBuckle) {
  Beam beam = beamOf(BeamType::kDoublyClamped, 1.0, -10e6);
  for (const double work : {1e-3, 1e-5, 1e-8}) {
    beam.length = detachmentLength(beam, work);
    EXPECT_NEAR(bucklingStress(beam) / beam.residual_stress, 1.0, 1e-12) << work;
    EXPECT_GT(peelNumber(beam, work), 1.0);  // it comes off as long as it is straight
    EXPECT_NEAR(unstuckLength(beam, work) / beam.length, 0.5, 1e-12);
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

TEST(BeamAdhesion, forceIsWhatABeamByFiniteDifferencesNeeds) {
  for (const Beam& beam : doublyClampedBeams()) {
    EXPECT_NEAR(beamForce(beam) / (beam.width * HeldMiddle(beam, 0.5 * beam.length).force), 1.0,
                kDifferences)
        << "gap " << beam.gap << ", " << beam.residual_stress;
  }
  Beam beam = beamOf(BeamType::kCantilever, 400 * kUm);
  beam.width = 20 * kUm;
  const FiniteDifferenceBeam differences(beam, 160);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(differences.nodes());
  load(differences.nodes() - 1) = 2.0 / differences.step();  // 1 N at the tip
  const Eigen::VectorXd bent = differences.solve(differences.matrix(0.0, 0.0), load);
  EXPECT_NEAR(beamForce(beam) * bent(differences.nodes() - 1) / beam.gap, 1.0, kDifferences);
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
