#include "verification/row.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mems_stiction {
namespace verification {

double Convergence::order() const {
  double x_mean = 0.0, y_mean = 0.0, xx = 0.0, xy = 0.0;
  std::vector<double> x, y;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i] < kRoundOff) continue;  // has arrived
    x.push_back(std::log(resolutions[i]));
    y.push_back(-std::log(errors[i]));
  }
  if (x.size() < 2) return std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < x.size(); ++i) {
    x_mean += x[i] / static_cast<double>(x.size());
    y_mean += y[i] / static_cast<double>(x.size());
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - x_mean) * (x[i] - x_mean);
    xy += (x[i] - x_mean) * (y[i] - y_mean);
  }
  return xy / xx;
}

double Row::error() const {
  return reference == 0.0 ? std::abs(computed) : std::abs(computed / reference - 1.0);
}

bool Row::isWithin() const {
  if (!(error() <= tolerance)) return false;
  return !convergence || convergence->order() >= convergence->least_order;
}

Row published(const std::string& quantity, const std::string& unit, const std::string& source,
              double computed, const std::string& printed) {
  const std::size_t exponent_at = std::min(printed.find('e'), printed.size());
  const std::string mantissa = printed.substr(0, exponent_at);
  const std::size_t point = mantissa.find('.');
  const auto decimals =
      point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
  const int exponent =
      exponent_at < printed.size() ? std::stoi(printed.substr(exponent_at + 1)) : 0;
  const auto digits = std::count_if(
      mantissa.begin() + static_cast<std::ptrdiff_t>(mantissa.find_first_of("123456789")),
      mantissa.end(), [](char c) { return c != '.'; });
  Row row{quantity, unit, source, computed, std::stod(printed), 0.0, {}, {}};
  const double half_unit = 0.5 * std::pow(10.0, exponent - decimals);
  row.tolerance =
      half_unit / std::abs(row.reference) + 4.0 * std::numeric_limits<double>::epsilon();
  row.reason = std::to_string(digits) + (digits == 1 ? " published digit" : " published digits");
  return row;
}

Row exact(const std::string& quantity, const std::string& unit, const std::string& source,
          double computed, double reference) {
  return {quantity, unit, source, computed, reference, kRoundOff, kRoundOffReason, {}};
}

Row near(const std::string& quantity, const std::string& unit, const std::string& source,
         double computed, double reference, double tolerance, const std::string& reason) {
  return {quantity, unit, source, computed, reference, tolerance, reason, {}};
}

Row limit(const std::string& quantity, const std::string& unit, const std::string& source,
          double reference, double tolerance, const std::string& reason, const Order& order) {
  Row row = near(quantity, unit, source, 0.0, reference, tolerance, reason);
  row.convergence = Convergence{{}, {}, {}, order.least, order.reason};
  return row;
}

Row always(const std::string& quantity, const std::string& source, int violations,
           const std::string& reason) {
  return {quantity, "", source, static_cast<double>(violations), 0.0, 0.0, reason, {}};
}

}  // namespace verification
}  // namespace mems_stiction
