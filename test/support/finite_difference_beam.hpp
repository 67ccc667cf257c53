#pragma once

/// @file
/// A beam by finite differences: an independent solution for what closed forms say of beams.

#include <cmath>
#include <functional>
#include <optional>

#include <Eigen/Dense>

#include "mems_stiction/verdict/beam_adhesion.hpp"

namespace mems_stiction {

/// E I w'''' - N w'' + k w = q on n cells of the beam; w at the nodes 1 ... n, of which node 0 is
/// clamped. The far end is free, or clamped when the beam is doubly clamped.
class FiniteDifferenceBeam {
 public:
  FiniteDifferenceBeam(const Beam& beam, int cells)
      : beam_(beam), cells_(cells), step_(beam.length / cells) {}

  double place(int node) const { return node * step_; }
  int nodes() const { return cells_; }
  double step() const { return step_; }

  /// Matrix of the operator under the axial force N [N] and a foundation [N/m^2] per node, times
  /// step^4/(E I).
  Eigen::MatrixXd matrix(double axial_force, double foundation) const {
    const int n = cells_;
    const bool is_clamped = beam_.type == BeamType::kDoublyClamped;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
    const double pull = axial_force * step_ * step_ / rigidity();
    const double bed = foundation * std::pow(step_, 4) / rigidity();
    const auto add = [&](int row, int node, double value) {
      if (node == 0) return;                // clamped: w = 0
      if (node == -1) node = 1;             // no slope there: w(-1) = w(1)
      if (is_clamped && node == n) return;  // w = 0
      if (is_clamped && node == n + 1) node = n - 1;
      if (node <= n) {
        a(row - 1, node - 1) += value;
      } else if (node == n + 1) {  // free end: w'' = 0
        a(row - 1, n - 1) += 2.0 * value;
        a(row - 1, n - 2) -= value;
      } else {  // and w''' = 0: w(n+2) = w(n-2) - 2 w(n-1) + 2 w(n+1)
        a(row - 1, n - 3) += value;
        a(row - 1, n - 2) -= 2.0 * value;
        a(row - 1, n - 1) += 4.0 * value;
        a(row - 1, n - 2) -= 2.0 * value;
      }
    };
    for (int row = 1; row <= n; ++row) {
      if (is_clamped && row == n) {
        a(row - 1, row - 1) = 1.0;
        continue;
      }
      const double stencil[] = {1.0, -4.0, 6.0, -4.0, 1.0};
      for (int i = -2; i <= 2; ++i) add(row, row + i, stencil[i + 2]);
      add(row, row - 1, -pull);
      add(row, row, 2.0 * pull + bed);
      add(row, row + 1, -pull);
    }
    return a;
  }

  /// Deflections [m] under q [N/m] of each node.
  Eigen::VectorXd solve(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& load) const {
    return matrix.partialPivLu().solve(load * (std::pow(step_, 4) / rigidity()));
  }

  double rigidity() const {
    return beam_.modulus * beam_.width * std::pow(beam_.thickness, 3) / 12.0;
  }

  /// N of a doubly clamped beam that is bent so [N]: residual stress and stretching.
  double axialForce(const Eigen::VectorXd& deflection) const {
    if (beam_.type != BeamType::kDoublyClamped) return 0.0;
    double squares = 0.0;
    double before = 0.0;
    for (const double value : deflection) {
      squares += (value - before) * (value - before) / step_;
      before = value;
    }
    const double section = beam_.width * beam_.thickness;
    return section * (beam_.residual_stress + beam_.modulus * squares / (2.0 * beam_.length));
  }

 private:
  Beam beam_;
  int cells_;
  double step_;
};

}  // namespace mems_stiction
