#pragma once

/// @file
/// How do Gaussian numbers become numbers of a wanted skewness and kurtosis?
///
/// By Johnson's translations of a standard normal g (Johnson, Biometrika 36 (1949) 149):
///
///     bounded    1/(1 + exp(-(g - gamma)/delta))  kurtosis below that of the log-normal of the
///                                                 same skewness
///     log-normal exp(g/delta)                     on it
///     unbounded  sinh((g - gamma)/delta)          above it
///
/// shifted and scaled to mean 0 and variance 1, turned over for a negative skewness. Each pair
/// (skewness, kurtosis) with kurtosis > skewness^2 + 1 belongs to exactly one of them; (0, 3) is
/// the identity. gamma and delta by bisection: for each delta one gamma gives the skewness, and
/// along these pairs kurtosis falls from unbounded to the log-normal's, or rises from two spikes to
/// it.

namespace mems_stiction {

/// A function that gives normal numbers another skewness and kurtosis.
class JohnsonTranslation {
 public:
  /// @param skewness in [-4, 4]
  /// @param kurtosis in [skewness^2 + 1.2, 100]: nearer to skewness^2 + 1 heights would stand at
  /// two levels. Gaussian: 3.
  /// @throw OptionsError naming both and what is allowed.
  JohnsonTranslation(double skewness, double kurtosis);

  /// The translated number: mean 0 and variance 1 if g is standard normal. Rises with g.
  double operator()(double g) const;

  /// The correlation that two standard normals must have so that their translations have this one.
  /// @param correlation in [0, 1]
  double gaussianCorrelation(double correlation) const;

 private:
  enum class Family { kNormal, kLogNormal, kBounded, kUnbounded };

  double raw(double g) const;

  Family family_ = Family::kNormal;
  double sign_ = 1.0;
  double gamma_ = 0.0;
  double delta_ = 1.0;
  double mean_ = 0.0;
  double deviation_ = 1.0;
};

}  // namespace mems_stiction
