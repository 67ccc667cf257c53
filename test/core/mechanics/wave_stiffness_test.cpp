#include "mechanics/wave_stiffness.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

constexpr double kRoundOff = 1e-13;

Material film(double thickness, Backing backing, double youngs_modulus = 160e9,
              double poisson_ratio = 0.22) {
  Material material;
  material.youngs_modulus = youngs_modulus;
  material.poisson_ratio = poisson_ratio;
  material.thickness = thickness;
  material.backing = backing;
  return material;
}

Material rigid() {
  Material material;
  material.youngs_modulus = 1e40;
  return material;
}

double planeModulus(const Material& material) {
  return material.youngs_modulus / (1.0 - material.poisson_ratio * material.poisson_ratio);
}

double stiffnessOf(const Material& material, double q) {
  return WaveStiffness(material, rigid()).at(q);
}

void expectRelative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

/// Elasticity of one wave as four equations of first order in depth: u_x, u_z, s_xz, s_zz in plane
/// strain.
class Layers {
 public:
  explicit Layers(double q) : q_(q) {}

  /// Two solutions that a rigid base allows, from `thickness` below up to the surface.
  void onRigid() { solutions_ = {State{0.0, 0.0, 1.0, 0.0}, State{0.0, 0.0, 0.0, 1.0}}; }
  void onNothing() { solutions_ = {State{1.0, 0.0, 0.0, 0.0}, State{0.0, 1.0, 0.0, 0.0}}; }
  void climb(const Material& material, double thickness) {
    constexpr int kSteps = 4000;
    const double step = -thickness / kSteps;
    // u and s / (q E) are of one size
    const double mu = 0.5 * material.youngs_modulus / (1.0 + material.poisson_ratio);
    const double lambda = 2.0 * mu * material.poisson_ratio / (1.0 - 2.0 * material.poisson_ratio);
    for (int i = 0; i < kSteps; ++i) {
      for (State& state : solutions_) state = runge(state, step, lambda / kUnit, mu / kUnit);
      separate();
    }
  }
  /// Pressure over displacement where nothing rubs.
  double stiffness() const {
    const auto& [one, other] = solutions_;
    return -(other[2] * one[3] - one[2] * other[3]) / (other[2] * one[1] - one[2] * other[1]) *
           kUnit * q_;
  }

 private:
  using State = std::array<double, 4>;
  static constexpr double kUnit = 1e11;  // [Pa]

  State slope(const State& y, double lambda, double mu) const {
    const double dilation = (y[3] - lambda * y[0]) / (lambda + 2.0 * mu);
    return {q_ * (y[2] / mu + y[1]), q_ * dilation,
            q_ * ((lambda + 2.0 * mu) * y[0] + lambda * dilation), -q_ * y[2]};
  }
  static State along(const State& y, double step, const State& slope) {
    State next = y;
    for (std::size_t i = 0; i < 4; ++i) next[i] += step * slope[i];
    return next;
  }
  State runge(const State& y, double step, double lambda, double mu) const {
    const State k1 = slope(y, lambda, mu);
    const State k2 = slope(along(y, 0.5 * step, k1), lambda, mu);
    const State k3 = slope(along(y, 0.5 * step, k2), lambda, mu);
    const State k4 = slope(along(y, step, k3), lambda, mu);
    State next = y;
    for (std::size_t i = 0; i < 4; ++i)
      next[i] += step / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    return next;
  }
  /// Any two solutions do; these do not become one by rounding.
  void separate() {
    auto& [one, other] = solutions_;
    const auto product = [](const State& a, const State& b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    };
    one = along({}, 1.0 / std::sqrt(product(one, one)), one);
    other = along(other, -product(one, other), one);
    other = along({}, 1.0 / std::sqrt(product(other, other)), other);
  }

  double q_;
  std::array<State, 2> solutions_;
};

TEST(WaveStiffness, isThatOfTwoHalfSpacesWhereBothAreThick) {
  const Material lower = film(0.0, Backing::kFree);
  const Material upper = film(0.0, Backing::kBonded, 70e9, 0.3);
  const WaveStiffness thick(lower, upper);
  EXPECT_TRUE(thick.isThick());
  const double modulus = ContactPair(lower, upper).contact_modulus;
  for (const double q : {1e-3, 1.0, 1e6, 1e12}) {
    EXPECT_EQ(thick.modulus(q), modulus);
    EXPECT_EQ(thick.at(q), 0.5 * modulus * q);
  }
}

TEST(WaveStiffness, forgetsTheOtherSideOfAThickBodyToTheBit) {
  const double t = 2e-6;
  for (const Backing backing : {Backing::kFree, Backing::kBonded}) {
    for (const double s : {30.0, 1e3, 1e6, 1e300}) {
      EXPECT_EQ(LayerCompliance(film(t, backing)).ratio(s / t), 1.0) << s;
    }
  }
}

TEST(WaveStiffness, isFilonsForAFreePlate) {
  const Material plate = film(3e-6, Backing::kFree);
  for (const double s : {0.1, 0.3, 0.999, 1.001, 2.0, 5.0, 12.0}) {
    const double q = s / plate.thickness;
    const double sinh = std::sinh(s);
    const double filon =
        0.5 * planeModulus(plate) * q * (sinh * sinh - s * s) / (sinh * std::cosh(s) + s);
    expectRelative(stiffnessOf(plate, q), filon, 1e-11);
  }
}

TEST(WaveStiffness, bendsAThinPlate) {
  const Material plate = film(3e-6, Backing::kFree);
  const double bending = planeModulus(plate) * std::pow(plate.thickness, 3) / 12.0;
  for (const double s : {1e-6, 1e-4, 1e-2, 0.04}) {
    const double q = s / plate.thickness;
    // the next term of the series: shear, 1 - s^2/5 + ...
    expectRelative(stiffnessOf(plate, q), bending * std::pow(q, 4), 1e-3);
    expectRelative(stiffnessOf(plate, q), bending * std::pow(q, 4), 0.5 * s * s + kRoundOff);
  }
}

TEST(WaveStiffness, isTheConfinedModulusOverTheThicknessOfAThinFilm) {
  for (const double nu : {-0.5, 0.0, 0.22, 0.4}) {
    const Material material = film(50e-9, Backing::kBonded, 3e9, nu);
    const double confined = 3e9 * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    for (const double s : {1e-6, 1e-4, 1e-3}) {
      expectRelative(stiffnessOf(material, s / material.thickness), confined / material.thickness,
                     10.0 * s * s + kRoundOff);
    }
  }
}

TEST(WaveStiffness, squeezesAFilmThatKeepsItsVolumeAside) {
  const Material material = film(50e-9, Backing::kBonded, 3e9, 0.5);
  for (const double s : {1e-6, 1e-4, 1e-2}) {
    const double q = s / material.thickness;
    expectRelative(stiffnessOf(material, q), 3e9 / (q * q * std::pow(material.thickness, 3)),
                   2.0 * s * s + kRoundOff);
  }
}

TEST(WaveStiffness, isCarboneAndMangialardisOnARigidSubstrate) {
  const double nu = 0.3;
  const Material material = film(50e-9, Backing::kBonded, 3e9, nu);
  for (const double s : {0.02, 0.5, 0.999, 1.001, 3.0, 12.0}) {
    const double q = s / material.thickness;
    const double g = 3.0 - 4.0 * nu;
    const double ratio =
        (g * std::cosh(2.0 * s) + 2.0 * s * s + 4.0 * nu * (2.0 * nu - 3.0) + 5.0) /
        (g * std::sinh(2.0 * s) - 2.0 * s);
    expectRelative(stiffnessOf(material, q), 0.5 * planeModulus(material) * q * ratio, 1e-11);
  }
}

TEST(WaveStiffness, isThatOfTheSubstrateForLongWaves) {
  Material material = film(50e-9, Backing::kBonded, 3e9, 0.3);
  material.substrate = {160e9, 0.22};
  const double of_substrate = 0.5 * 160e9 / (1.0 - 0.22 * 0.22) * 10.0;
  expectRelative(stiffnessOf(material, 10.0), of_substrate, 1e-4);
}

TEST(WaveStiffness, doesNotSeeABorderBetweenEqualBodies) {
  Material material = film(50e-9, Backing::kBonded, 3e9, 0.3);
  material.substrate = {3e9, 0.3};
  for (const double s : {1e-6, 1e-2, 0.999, 1.001, 4.0}) {
    expectRelative(LayerCompliance(material).ratio(s / material.thickness), 1.0, kRoundOff);
  }
}

TEST(WaveStiffness, comesNearTheFreePlateOnASoftSubstrateAndTheRigidOneOnAStiffOne) {
  Material material = film(50e-9, Backing::kBonded);
  for (const double s : {0.1, 0.999, 1.001, 4.0}) {
    const double q = s / material.thickness;
    material.substrate = {1e-8, 0.3};
    expectRelative(stiffnessOf(material, q), stiffnessOf(film(50e-9, Backing::kFree), q), 1e-10);
    material.substrate = {1e28, 0.3};
    expectRelative(stiffnessOf(material, q), stiffnessOf(film(50e-9, Backing::kBonded), q), 1e-10);
  }
}

TEST(WaveStiffness, solvesTheEquationsOfElasticity) {
  for (const double s : {0.3, 1.0, 2.5}) {
    const double q = 1e7;
    const double t = s / q;
    const Material plate = film(t, Backing::kFree, 90e9, 0.28);
    Layers free(q);
    free.onNothing();
    free.climb(plate, t);
    expectRelative(stiffnessOf(plate, q), free.stiffness(), 1e-8);
    for (const double of_substrate : {5e9, 60e9, 400e9}) {
      Material layer = film(t, Backing::kBonded, 90e9, 0.28);
      layer.substrate = {of_substrate, 0.35};
      Layers layers(q);
      layers.onRigid();
      layers.climb(film(0.0, Backing::kFree, of_substrate, 0.35), 14.0 / q);
      layers.climb(layer, t);
      expectRelative(stiffnessOf(layer, q), layers.stiffness(), 1e-7);
    }
  }
}

TEST(WaveStiffness, isSmoothFromTheThinnestToTheThickest) {
  Material material = film(1e-6, Backing::kFree);
  for (const auto& [backing, substrate] :
       {std::pair(Backing::kFree, 0.0), std::pair(Backing::kBonded, 0.0),
        std::pair(Backing::kBonded, 1e9), std::pair(Backing::kBonded, 900e9)}) {
    material.backing = backing;
    material.substrate.youngs_modulus = substrate;
    const LayerCompliance layer(material);
    double last_slope = 0.0;
    for (double s = 1e-6; s < 1e6; s *= 1.01) {
      const double slope =
          std::log(layer.ratio(1.01 * s / 1e-6) / layer.ratio(s / 1e-6)) / std::log(1.01);
      EXPECT_NEAR(slope, s > 1e-6 ? last_slope : slope, 0.03) << s;
      last_slope = slope;
    }
  }
}

TEST(WaveStiffness, addsTheCompliancesOfBothBodies) {
  const Material plate = film(2e-6, Backing::kFree);
  const Material coating = film(100e-9, Backing::kBonded, 3e9, 0.4);
  const WaveStiffness both(plate, coating);
  EXPECT_FALSE(both.isThick());
  for (const double q : {1e4, 1e6, 1e8}) {
    expectRelative(1.0 / both.at(q), 1.0 / stiffnessOf(plate, q) + 1.0 / stiffnessOf(coating, q),
                   kRoundOff);
  }
}

}  // namespace
}  // namespace mems_stiction
