#include "errors/short_number.hpp"

#include <cmath>

#include "errors/plain_format.hpp"

namespace mems_stiction {

std::string shortNumber(double value, int digits) {
  if (std::isnan(value)) return "nan";  // printf shows its sign
  std::string text = plainFormat("%.*g", digits, value);
  if (text.find("e+") == std::string::npos || !(std::abs(value) < 1e6)) return text;
  return plainFormat("%.0f", plainStrtod(text.c_str()));  // 7250, not 7.25e+03
}

int knownDigits(double value, double lower, double upper) {
  constexpr double kSure = 0.05;
  return std::abs(upper - lower) > 2.0 * kSure * std::abs(value) ? 2 : 3;
}

std::string withInterval(double value, double lower, double upper, const std::string& unit) {
  const int digits = knownDigits(value, lower, upper);
  const std::string end = unit.empty() ? "" : " " + unit;
  std::string text = shortNumber(value, digits) + end;
  if (!std::isfinite(value) || std::isnan(lower) || std::isnan(upper)) return text;
  return text + ", 95 % within " + shortNumber(lower, digits) + " to " +
         shortNumber(upper, digits) + end;
}

}  // namespace mems_stiction
