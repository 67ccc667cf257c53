#pragma once

/// @file
/// From which standard normal numbers do the heights of a surface come, and how does their
/// distribution go on beyond the highest one that was measured?
///
///     z = T(g)                           T rises: the translation of a Gaussian field
///     T' = b exp(c (g - g0))             above g0: c > 0 a longer, c < 0 a shorter tail
///     T' = b (g/g0)^(c (g0 + 1))         another form of the longer one: heights hardly tell which
///
/// Below g0, T is the distribution of the heights themselves; g0 is the normal number that some 800
/// independent places exceed. a = T(g0), b and c are the likeliest by how many of these places lie
/// between levels; c has a prior about 0, so that few places say "as a Gaussian surface".

#include <vector>

namespace mems_stiction {

/// How a distribution goes on, where its tail is a longer one.
enum class TailForm { kExponential, kPower };

/// T, by a table.
class HeightMarginal {
 public:
  /// A Gaussian one.
  HeightMarginal(double mean, double deviation);
  /// - @p heights [m], any number above 100 of them
  /// - @p independent so many of them are independent of each other
  HeightMarginal(std::vector<double> heights, double independent,
                 TailForm form = TailForm::kExponential);

  double heightOf(double g) const;
  double numberOf(double height) const;
  double tailShape() const { return tail_shape_; }  ///< c [-]
  /// The same mixed with a Gaussian one of this mean and deviation: share of this one in [0, 1].
  HeightMarginal mixed(double share, double mean, double deviation) const;

  /// The table, both rising.
  const std::vector<double>& numbers() const { return numbers_; }
  const std::vector<double>& heights() const { return heights_; }

 private:
  std::vector<double> numbers_;
  std::vector<double> heights_;
  double tail_shape_ = 0.0;
};

/// Standard normal distribution and its inverse.
double normalShare(double g);
double normalNumber(double share);

}  // namespace mems_stiction
