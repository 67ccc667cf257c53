/// The voltage at which beams close, against a beam by finite differences and against published
/// numbers.

#include "verdict/beam_electrode.hpp"
#include "verdict/beam_field.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "mems_stiction/verdict/device_options.hpp"
#include "numeric/constants.hpp"
#include "support/finite_difference_beam.hpp"

namespace mems_stiction {
namespace {

constexpr double kMicrometre = 1e-6;

Beam beamOfType(BeamType type, double stress = 0.0) {
  return {type,   200 * kMicrometre, 2 * kMicrometre, 2 * kMicrometre, 160e9,
          stress, 20 * kMicrometre};
}

BeamElectrode wholeBelow(const Beam& beam) { return {0.0, beam.length, beam.gap, 0.0}; }

/// The field on each node of a beam that is bent so [N/m].
Eigen::VectorXd fieldOn(const FiniteDifferenceBeam& differences, const Beam& beam,
                        const BeamElectrode& electrode, double voltage,
                        const Eigen::VectorXd& bent) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(differences.nodes());
  for (int node = 1; node <= differences.nodes(); ++node) {
    const double x = differences.place(node);
    const double from = std::max(x - 0.5 * differences.step(), electrode.start);
    const double to =
        std::min({x + 0.5 * differences.step(), electrode.start + electrode.length, beam.length});
    if (to <= from) continue;
    const double gap = electrode.gap + electrode.insulator_gap - bent(node - 1);
    // the last node of a free end stands for half a cell, as its equation does
    const double share =
        (to - from) / (node == differences.nodes() ? 0.5 * differences.step() : differences.step());
    load(node - 1) =
        0.5 * kVacuumPermittivity * beam.width * voltage * voltage / (gap * gap) * share;
  }
  if (beam.type == BeamType::kDoublyClamped) load(differences.nodes() - 1) = 0.0;
  return load;
}

/// What has to hold the beam down by its gap, at the tip or in the middle, under a voltage [N].
double reactionUnder(double voltage, const Beam& beam, const BeamElectrode& electrode) {
  const int cells = 160;
  const FiniteDifferenceBeam differences(beam, cells);
  const bool is_cantilever = beam.type == BeamType::kCantilever;
  const int touching = (is_cantilever ? cells : cells / 2) - 1;
  const double of_node = is_cantilever ? 0.5 * differences.step() : differences.step();
  const double scale = std::pow(differences.step(), 4) / differences.rigidity();
  constexpr double kSpring =
      10.0;  // of the support, in the units of the matrix: far stiffer than the beam
  Eigen::VectorXd bent = Eigen::VectorXd::Zero(differences.nodes());
  double reaction = 0.0;
  for (int round = 0; round < 200; ++round) {
    Eigen::VectorXd load = fieldOn(differences, beam, electrode, voltage, bent.cwiseMin(beam.gap));
    load(touching) += kSpring * beam.gap / scale;
    Eigen::MatrixXd matrix = differences.matrix(differences.axialForce(bent), 0.0);
    matrix(touching, touching) += kSpring;
    if (!is_cantilever) {  // and no slope there
      for (const int side : {-1, 1}) {
        matrix(touching + side, touching + side) += kSpring;
        matrix(touching + side, touching - side) -= kSpring;
      }
    }
    const Eigen::VectorXd next = differences.solve(matrix, load);
    bent = Eigen::VectorXd(0.5 * (bent + next));
    const double before = reaction;
    reaction = kSpring * (beam.gap - next(touching)) / scale * of_node;
    if (std::abs(reaction - before) < 1e-7 * std::abs(reaction)) break;
  }
  return reaction;
}

/// The largest voltage that holds the beam at any deflection on the way down: for each one the
/// shape and the voltage by iteration.
double voltageByDifferences(const Beam& beam, const BeamElectrode& electrode) {
  constexpr int kAmplitudes = 40;
  const FiniteDifferenceBeam differences(beam, 120);
  Eigen::VectorXd bent = Eigen::VectorXd::Zero(differences.nodes());
  double most = 0.0;
  for (int i = 1; i <= kAmplitudes; ++i) {
    const double amplitude = beam.gap * i / kAmplitudes;
    if (amplitude >= electrode.gap + electrode.insulator_gap) break;
    double squared = 0.0;
    for (int round = 0; round < 200; ++round) {
      const double deepest = bent.maxCoeff();
      if (deepest > 0.0) bent *= amplitude / deepest;
      const Eigen::VectorXd next =
          differences.solve(differences.matrix(differences.axialForce(bent), 0.0),
                            fieldOn(differences, beam, electrode, 1.0, bent));
      const double before = squared;
      squared = amplitude / next.maxCoeff();
      bent += 0.7 * (next * squared - bent);
      if (std::abs(squared - before) < 1e-5 * squared) break;
    }
    most = std::max(most, squared);
  }
  return std::sqrt(most);
}

/// Of both: the grid, the steps of the deflection.
constexpr double kOfDifferences = 0.02;

TEST(BeamElectrode, closesWhereABeamByFiniteDifferencesDoes) {
  for (const BeamType type : {BeamType::kCantilever, BeamType::kDoublyClamped}) {
    for (const double stress : {0.0, 30e6, 300e6, -5e6}) {
      if (type == BeamType::kCantilever && stress != 0.0) continue;
      const Beam beam = beamOfType(type, stress);
      for (const BeamElectrode& electrode :
           {wholeBelow(beam), BeamElectrode{0.3 * beam.length, 0.4 * beam.length, beam.gap, 50e-9},
            BeamElectrode{0.0, 0.125 * beam.length, beam.gap, 25e-9},
            BeamElectrode{0.0, 0.5 * beam.length, 1.5 * beam.gap, 0.0}}) {
        const double expected = voltageByDifferences(beam, electrode);
        EXPECT_NEAR(beamClosingVoltage(beam, electrode) / expected, 1.0, kOfDifferences)
            << static_cast<int>(type) << ", stress " << stress << ", from " << electrode.start
            << " over " << electrode.length;
      }
    }
  }
}

TEST(BeamElectrode, closesSoFarStretchedAndStressedBeamsToo) {
  for (const double gap_over_thickness : {1.5, 5.0, 10.0}) {
    for (const double stress : {0.0, 50e6, 300e6}) {
      Beam beam = beamOfType(BeamType::kDoublyClamped, stress);
      beam.length = 400 * kMicrometre;
      beam.thickness = 1 * kMicrometre;
      beam.gap = gap_over_thickness * beam.thickness;
      for (const BeamElectrode& electrode :
           {wholeBelow(beam), BeamElectrode{0.0, 0.125 * beam.length, beam.gap, 25e-9},
            BeamElectrode{0.45 * beam.length, 0.1 * beam.length, beam.gap, 25e-9}}) {
        EXPECT_NEAR(beamClosingVoltage(beam, electrode) / voltageByDifferences(beam, electrode),
                    1.0, kOfDifferences)
            << "gap " << gap_over_thickness << ", stress " << stress << ", from " << electrode.start
            << " over " << electrode.length;
      }
    }
  }
}

TEST(BeamField, holdsWhatABeamByFiniteDifferencesNeedsNoLonger) {
  for (const BeamType type : {BeamType::kCantilever, BeamType::kDoublyClamped}) {
    const Beam beam = beamOfType(type);
    const double unpulled = reactionUnder(0.0, beam, wholeBelow(beam));
    EXPECT_NEAR(unpulled / beamForce(beam), 1.0, kOfDifferences) << static_cast<int>(type);
    for (const BeamElectrode& electrode :
         {BeamElectrode{0.0, beam.length, beam.gap, 200e-9},
          BeamElectrode{0.1 * beam.length, 0.4 * beam.length, beam.gap, 50e-9},
          BeamElectrode{0.25 * beam.length, 0.5 * beam.length, 1.5 * beam.gap, 0.0}}) {
      for (const double share : {0.2, 0.5, 0.85, 1.2}) {
        const double voltage = share * beamClosingVoltage(beam, electrode);
        const double held = fieldHold(beam, electrode, voltage, 0.0).force;
        const double taken = unpulled - reactionUnder(voltage, beam, electrode);
        const std::string what = std::to_string(static_cast<int>(type)) + ", from " +
                                 std::to_string(electrode.start) + " under " +
                                 std::to_string(share) + " of the pull-in";
        if (std::isinf(held)) {
          EXPECT_GT(taken, beamForce(beam)) << what;
        } else {
          EXPECT_NEAR(taken / held, 1.0, kOfDifferences) << what;
        }
      }
    }
  }
}

TEST(BeamField, holdsForGoodWhatLiesOnTheSubstrateWithItsArm) {
  const Beam beam = beamOfType(BeamType::kDoublyClamped);
  const BeamElectrode electrode{0.1 * beam.length, 0.4 * beam.length, beam.gap, 50e-9};
  const double pull_in = beamClosingVoltage(beam, electrode);
  EXPECT_TRUE(std::isfinite(fieldHold(beam, electrode, 0.25 * pull_in, 5e-9).force));
  EXPECT_TRUE(std::isinf(fieldHold(beam, electrode, 5.0 * pull_in, 5e-9).force));
  EXPECT_TRUE(std::isinf(fieldHold(beam, electrode, 5.0 * pull_in, 5e-9).work));
}

/// (1/2) eps0 V^2 integral dx/d(x) [J/m] of a beam whose arms have the length s, flat beyond.
double coEnergy(const Beam& beam, const BeamElectrode& electrode, double arm, double contact_gap) {
  constexpr int kCells = 200000;
  double sum = 0.0;
  for (int i = 0; i < kCells; ++i) {
    const double x = electrode.start + (i + 0.5) * electrode.length / kCells;
    const double from_clamp =
        beam.type == BeamType::kDoublyClamped ? std::min(x, beam.length - x) : x;
    const double xi = std::min(from_clamp / arm, 1.0);
    const double phi = beam.type == BeamType::kDoublyClamped ? 3.0 * xi * xi - 2.0 * xi * xi * xi
                                                             : 0.5 * (3.0 * xi * xi - xi * xi * xi);
    sum += 1.0 / (electrode.gap + electrode.insulator_gap + contact_gap - beam.gap * phi);
  }
  return 0.5 * kVacuumPermittivity * sum * electrode.length / kCells;
}

TEST(BeamField, itsWorkIsTheCoEnergyThatPeelingCosts) {
  for (const BeamType type : {BeamType::kCantilever, BeamType::kDoublyClamped}) {
    const Beam beam = beamOfType(type);
    const bool is_double = type == BeamType::kDoublyClamped;
    const double arm = is_double ? 0.5 * beam.length : beam.length;
    for (const BeamElectrode& electrode :
         {BeamElectrode{0.0, beam.length, beam.gap, 100e-9},
          BeamElectrode{0.2 * beam.length, 0.3 * beam.length, 1.2 * beam.gap, 0.0}}) {
      const double step = 1e-4 * arm;
      const double lost =
          coEnergy(beam, electrode, arm - step, 5e-9) - coEnergy(beam, electrode, arm, 5e-9);
      EXPECT_NEAR(
          fieldHold(beam, electrode, 1e-3, 5e-9).work * 1e6 * step * (is_double ? 2.0 : 1.0) / lost,
          1.0, 0.01)
          << static_cast<int>(type) << ", from " << electrode.start;
    }
  }
}

TEST(BeamElectrode, agreesWithThePublishedNumberOfACantilever) {
  // eps0 w V^2 l^4/(2 E I g^3) = 1.68 at pull-in of a cantilever above a whole electrode (Zhang and
  // Zhao, Microsystem Technologies 12 (2006) 357)
  const Beam beam = beamOfType(BeamType::kCantilever);
  const double voltage = beamClosingVoltage(beam, wholeBelow(beam));
  const double rigidity = beam.modulus * beam.width * std::pow(beam.thickness, 3) / 12.0;
  EXPECT_NEAR(kVacuumPermittivity * beam.width * voltage * voltage * std::pow(beam.length, 4) /
                  (2.0 * rigidity * std::pow(beam.gap, 3)),
              1.68, 0.05);
}

TEST(BeamElectrode, isThatOfTheDeviceWhereItStatesABeamAlone) {
  DeviceOptions device;
  device.beam_type = BeamType::kCantilever;
  device.beam_length = 200 * kMicrometre;
  device.beam_thickness = device.beam_gap = 2 * kMicrometre;
  device.beam_modulus = 160e9;
  InterfaceOptions interface;
  EXPECT_TRUE(std::isnan(closingVoltage(device, interface)));
  device.electrode_length = device.beam_length;
  EXPECT_TRUE(std::isnan(closingVoltage(device, interface))) << "without a width";
  device.beam_width = 20 * kMicrometre;
  const double bare = closingVoltage(device, interface);
  EXPECT_EQ(bare, beamClosingVoltage(device.beam(), wholeBelow(device.beam())));
  interface.insulator_thickness = 100e-9;
  EXPECT_GT(closingVoltage(device, interface), bare);
  device.electrode_gap = 3 * kMicrometre;
  EXPECT_GT(closingVoltage(device, interface), 1.5 * bare);
  device.electrode_start = 50 * kMicrometre;
  EXPECT_EQ(device.validate().size(), 1U) << "it ends beyond the beam";
}

}  // namespace
}  // namespace mems_stiction
