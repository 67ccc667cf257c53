#include "support/axisymmetric_contact.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace mems_stiction {
namespace axisymmetric {
namespace {

constexpr double kPi = 3.141592653589793;
/// Widest ring near the contact: the traction of a rigid paraboloid varies over a few of them.
constexpr double kWidestRing = 0.04;
/// Rings become wider by this from where the bodies hardly deform, as far as where 3e-7 of the
/// force is beyond.
constexpr double kGrowth = 1.06;
constexpr double kFarthest = 60.0;
/// Largest |residual| of an equilibrium, and steps of Newton's method.
constexpr double kTolerance = 1e-9;
constexpr int kMostNewtonSteps = 60;
/// First and last step of the height, turned where the force falls; the first times Tabor's
/// parameter above 1.
constexpr double kFirstStep = 0.25;
constexpr double kLastStep = 0.003;
/// Tabor parameters over which the pressed state is followed.
constexpr double kFirstTabor = 0.5;
constexpr double kTaborRatio = 1.2;

/// Displacement at r under unit pressure on a disc, unit modulus: Johnson, Contact Mechanics
/// (1985), (3.29).
double underDisc(double r, double radius) {
  if (radius == 0.0) return 0.0;
  if (r < radius) return 4.0 * radius / kPi * std::comp_ellint_2(r / radius);
  const double k = radius / r;
  return 4.0 * r / kPi * (std::comp_ellint_2(k) - (1.0 - k * k) * std::comp_ellint_1(k));
}

/// Radii in sqrt(R z0), gaps and heights in z0, tractions in 8 Gamma/(3 z0): then Tabor's parameter
/// alone is left.
class Rings {
 public:
  Rings(double tabor, double rings_per_cohesive_length) {
    const double contact = std::cbrt(9.0 * kPi / 8.0) * std::sqrt(tabor);  // JKR's at pull-off
    const double width = std::min(kWidestRing, std::pow(tabor, -1.5) / rings_per_cohesive_length);
    std::vector<double> edges{0.0};
    while (edges.back() < std::max(3.0, 1.6 * contact + 1.0)) edges.push_back(edges.back() + width);
    while (edges.back() < kFarthest)
      edges.push_back(edges.back() + std::max(width, (kGrowth - 1.0) * edges.back()));
    const auto count = static_cast<Eigen::Index>(edges.size()) - 1;
    relief_.resize(count);
    area_.resize(count);
    compliance_.resize(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const double inner = edges[static_cast<std::size_t>(i)];
      const double outer = edges[static_cast<std::size_t>(i) + 1];
      const double squared = 0.5 * (inner * inner + outer * outer);  // halves the ring's area
      relief_[i] = 0.5 * squared;
      area_[i] = kPi * (outer * outer - inner * inner);
    }
    for (Eigen::Index i = 0; i < count; ++i) {
      const double r = std::sqrt(2.0 * relief_[i]);
      for (Eigen::Index j = 0; j < count; ++j) {
        compliance_(i, j) = underDisc(r, edges[static_cast<std::size_t>(j) + 1]) -
                            underDisc(r, edges[static_cast<std::size_t>(j)]);
      }
    }
  }

  const Eigen::ArrayXd& relief() const { return relief_; }

  /// Brings the gaps into equilibrium at a height; false if there is none nearby.
  bool solve(double tabor, double height, Eigen::ArrayXd& gaps) const {
    const double softness = 8.0 / 3.0 * std::pow(tabor, 1.5);
    for (int step = 0; step < kMostNewtonSteps; ++step) {
      const Eigen::ArrayXd out =
          gaps - height - relief_ + softness * (compliance_ * traction(gaps).matrix()).array();
      if (!out.isFinite().all()) return false;
      if (out.abs().maxCoeff() < kTolerance) return true;
      const Eigen::ArrayXd slope = 9.0 * gaps.pow(-10) - 3.0 * gaps.pow(-4);
      Eigen::MatrixXd jacobian = softness * compliance_ * slope.matrix().asDiagonal();
      jacobian.diagonal().array() += 1.0;
      const Eigen::ArrayXd change = -jacobian.partialPivLu().solve(out.matrix()).array();
      // no gap falls by more than a third, none moves by more than half of z0
      const double longest =
          std::max((-change / gaps).maxCoeff() / 0.3, change.abs().maxCoeff() / 0.5);
      gaps += change / std::max(1.0, longest);
    }
    return false;
  }

  /// Attraction over pi Gamma R.
  double force(const Eigen::ArrayXd& gaps) const {
    return 8.0 / 3.0 / kPi * (traction(gaps) * area_).sum();
  }

 private:
  static Eigen::ArrayXd traction(const Eigen::ArrayXd& gaps) { return gaps.pow(-3) - gaps.pow(-9); }

  Eigen::ArrayXd relief_;
  Eigen::ArrayXd area_;
  Eigen::MatrixXd compliance_;
};

}  // namespace

double pullOff(double tabor, double rings_per_cohesive_length) {
  const Rings rings(tabor, rings_per_cohesive_length);
  double at = std::min(tabor, kFirstTabor);
  double height = -at;
  Eigen::ArrayXd gaps = (height + rings.relief()).max(0.9);
  while (true) {
    if (!rings.solve(at, height, gaps)) return std::nan("");
    if (at == tabor) break;
    at = std::min(tabor, kTaborRatio * at);
    height = -at;
  }
  double largest = rings.force(gaps);
  double step = kFirstStep * std::max(1.0, tabor);
  while (std::abs(step) > kLastStep) {
    Eigen::ArrayXd next = gaps;
    if (rings.solve(tabor, height + step, next) && rings.force(next) > largest) {
      height += step;
      gaps = next;
      largest = rings.force(gaps);
    } else {
      step *= -0.5;
    }
  }
  return largest;
}

}  // namespace axisymmetric
}  // namespace mems_stiction
