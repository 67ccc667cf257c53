#pragma once

/// One line of the verification table: what the code says, what it must say, how far apart they may
/// be and why.
///
/// References never come from the code under test: they are published numbers, or closed forms and
/// quadratures written down beside the row in other words than the library's.

#include <optional>
#include <string>
#include <vector>

namespace mems_stiction {
namespace verification {

/// How a row comes closer as its grid gets finer.
struct Convergence {
  std::string resolution;           ///< what is counted, "pixels per contact radius"
  std::vector<double> resolutions;  ///< ascending, at least three
  std::vector<double>
      errors;  ///< relative error of each, root mean square over the grid's phases where it has any
  double least_order = 0.0;  ///< the row is out below it
  std::string reason;        ///< why this order

  /// p of error ~ resolution^-p, by least squares in logarithms. Infinite when every error is
  /// round-off.
  double order() const;
};

struct Row {
  std::string quantity;
  std::string unit;
  std::string source;  ///< of the reference
  double computed = 0.0;
  double reference = 0.0;
  double tolerance = 0.0;  ///< relative; absolute where the reference is 0
  std::string reason;      ///< of the tolerance
  std::optional<Convergence> convergence;

  /// |computed/reference - 1|; |computed| where the reference is 0.
  double error() const;
  /// False for a NaN too.
  bool isWithin() const;
};

/// Rows under one heading.
struct Section {
  std::string title;
  std::vector<Row> rows;
};

/// Closed form against closed form: some operations of round-off.
inline constexpr double kRoundOff = 1e-12;
inline constexpr const char* kRoundOffReason = "round-off";

/// A row whose reference is a number as printed, "-0.436790e-9": the tolerance is half a unit of
/// its last digit.
Row published(const std::string& quantity, const std::string& unit, const std::string& source,
              double computed, const std::string& printed);

/// A row whose reference is another way to the same number, equal but for round-off.
Row exact(const std::string& quantity, const std::string& unit, const std::string& source,
          double computed, double reference);

/// A row with a tolerance of its own.
Row near(const std::string& quantity, const std::string& unit, const std::string& source,
         double computed, double reference, double tolerance, const std::string& reason);

/// How fast a row must come closer.
struct Order {
  double least;
  std::string reason;
};

/// A row whose value is that of a grid: what finer and finer ones lead to; grid_convergence.hpp
/// computes it.
Row limit(const std::string& quantity, const std::string& unit, const std::string& source,
          double reference, double tolerance, const std::string& reason, const Order& order);

/// A row of a statement that holds for every case: computed counts the cases in which it does not,
/// so it is 0.
Row always(const std::string& quantity, const std::string& source, int violations,
           const std::string& reason);

}  // namespace verification
}  // namespace mems_stiction
