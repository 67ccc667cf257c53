#pragma once

/// @file
/// Heights of any distribution from standard normal numbers, by a table: what a translation process
/// needs at every pixel.
///
///     const HeightTranslation skewed([&](double g) { return 3e-9 * johnson(g); });

#include <cstddef>
#include <functional>
#include <vector>

namespace mems_stiction {

/// A height [m] that rises with a normal number.
class HeightTranslation {
 public:
  /// - @p heights [m] at equal steps from `lowest` to `highest`, not falling; straight between them
  /// and beyond the ends
  /// @throw OptionsError naming what is not allowed.
  HeightTranslation(double lowest, double highest, const std::vector<double>& heights);
  /// The same with 4097 heights of a function, from -8 to 8: one number of 10^15 lies beyond.
  explicit HeightTranslation(const std::function<double(double)>& height);

  double operator()(double g) const {
    const double place = (g - lowest_) * steps_;
    const double segment = place < 0.0 ? 0.0 : place < last_ ? place : last_;
    const Segment& line = segments_[static_cast<std::size_t>(segment)];
    return line.height +
           line.rise * (place - static_cast<double>(static_cast<std::size_t>(segment)));
  }

 private:
  struct Segment {
    double height;
    double rise;
  };

  double lowest_;
  double steps_;  ///< per unit of g
  double last_;   ///< number of the last segment
  std::vector<Segment> segments_;
};

}  // namespace mems_stiction
