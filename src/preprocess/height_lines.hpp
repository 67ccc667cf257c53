#pragma once

/// @file
/// One line of heights at a time: sums over it, and what is taken off it. NaN is an invalid pixel;
/// it is left out of every sum and stays NaN. Sums run in fixed packets, so that they have the same
/// bits on every machine.

#include <cmath>
#include <cstddef>

namespace mems_stiction {

/// Writes a line as double precision, every height that is not finite as NaN.
void widenLine(const float* source, std::size_t size, double* line);
void widenLine(const double* source, std::size_t size, double* line);

/// Sums over valid pixels: their number, places p, heights h above an origin.
struct LineSums {
  double count = 0.0;
  double p = 0.0;
  double pp = 0.0;
  double h = 0.0;
  double ph = 0.0;
};

/// - @p places one of each pixel, in the unit of the caller
/// - @p origin subtracted from each height [m]
LineSums sumsOf(const double* line, const double* places, std::size_t size, double origin);

/// What comes off a line: origin first, so that small differences keep their digits, then a + b p +
/// c p^2 [m].
struct LineCurve {
  double origin = 0.0;
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;
};

/// What a step did to pixels that are valid before and after it.
struct ChangeSums {
  double rms() const { return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0; }

  double squares = 0.0;   ///< of the changes of height [m^2]
  long long count = 0;    ///< of the pixels
  long long changed = 0;  ///< whose height is another
};

void subtractCurve(const LineCurve& curve, const double* places, std::size_t size, double* line,
                   ChangeSums& changes);
/// The line less the curve, written elsewhere.
void flattenLine(const LineCurve& curve, const double* places, const double* line, std::size_t size,
                 double* flat);
/// From one line to another, pixel by pixel; pixels that are valid in one alone count as changed.
void addChanges(const double* before, const double* after, std::size_t size, ChangeSums& changes);

/// The line less a height, or less another line.
void subtractTo(const double* line, double height, std::size_t size, double* difference);
void subtractTo(const double* line, const double* other, std::size_t size, double* difference);

/// Each value becomes its distance from another.
void makeDistances(double from, double* values, std::size_t size);
/// How many values are above a limit, and how many are NaN.
struct LimitCount {
  long long above = 0;
  long long invalid = 0;
};
LimitCount countAbove(double limit, const double* values, std::size_t size);

/// |height less curve| of each pixel.
void distancesFrom(const LineCurve& curve, const double* places, const double* line,
                   std::size_t size, double* distances);

}  // namespace mems_stiction
