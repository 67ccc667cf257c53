#pragma once

/// @file
/// What bodies of finite thickness yield to a wave more than if they were thick, C = 1/K - 2/(E q) [m/Pa], from a table; 0 where a
/// substrate makes them stiffer.

#include <vector>

#include "mechanics/wave_stiffness.hpp"

namespace mems_stiction {

/// Of two bodies.
class ExtraCompliance {
 public:
  ExtraCompliance() = default;
  /// - @p longest, @p shortest waves that will be asked for [rad/m]
  ExtraCompliance(const WaveStiffness& stiffness, double longest, double shortest);

  /// C [m/Pa]; 0 for q = 0: that is no wave.
  double at(double wave_number) const;
  /// K over (E/2) q [-]: 1 where waves do not reach through the bodies.
  double stiffnessRatio(double wave_number) const {
    return 1.0 / (1.0 + 0.5 * contact_modulus_ * wave_number * at(wave_number));
  }
  double contactModulus() const { return contact_modulus_; }  ///< E of thick bodies [Pa]
  /// 1/q of the wave at which l q K/((E/2) q) is 1 [m]: the cohesive length of bodies that bend, no longer than that of thick ones.
  double cohesiveLength(double of_thick_bodies) const;

 private:
  double contact_modulus_ = 0.0;
  double first_ = 0.0;  ///< ln q
  double step_ = 1.0;
  std::vector<double> values_;
};

}  // namespace mems_stiction
