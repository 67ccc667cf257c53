#include "mems_stiction/settings/option_visitor.hpp"

#include <algorithm>
#include <cmath>

#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {

namespace {

/// A size that no length, force, stress or ratio has: beyond it powers and products overflow.
/// Where an end of a range is not stated, it and Range::kSmallest are its end.
constexpr double kLargest = 1e30;

/// What to say beside a range of a value that only its size excludes.
std::string sizeText(double value) {
  const double size = std::abs(value);
  const bool is_sane =
      value == 0.0 || !std::isfinite(value) || (size >= Range::kSmallest && size <= kLargest);
  return is_sane ? ""
                 : ", " + numberText(Range::kSmallest) + " to " + numberText(kLargest) + " in size";
}

}  // namespace

bool Range::contains(double value) const {
  if (std::isnan(value)) return nan_means_none;
  if (std::isinf(value)) return false;
  // a value that only marks what is missing, of whatever kind the file has
  if (!nan_means_none) {
    if (!std::isfinite(lower) && value < -kLargest) return false;
    if (!std::isfinite(upper) && value > kLargest) return false;
    if (lower == 0.0 && value > 0.0 && value < Range::kSmallest) return false;
  }
  const bool above = lower_open ? value > lower : value >= lower;
  const bool below = upper_open ? value < upper : value <= upper;
  return above && below;
}

std::string Range::text() const {
  const bool has_lower = std::isfinite(lower);
  const bool has_upper = std::isfinite(upper);
  if (has_lower && has_upper) {
    return std::string("in ") + (lower_open ? "(" : "[") + numberText(lower) + ", " +
           numberText(upper) + (upper_open ? ")" : "]");
  }
  if (has_lower) return (lower_open ? "> " : ">= ") + numberText(lower);
  if (has_upper) return (upper_open ? "< " : "<= ") + numberText(upper);
  return nan_means_none ? "any finite number, or nan for none" : "any finite number";
}

void OptionValidator::number(const std::string& key, double& value, const std::string& unit,
                             const Range& range, const std::string& /*meaning*/) {
  if (range.contains(value)) return;
  violations_.push_back(key + ": " + numberText(value) + (unit.empty() ? "" : " " + unit) +
                        " is not allowed, must be " + range.text() +
                        (unit.empty() ? "" : " " + unit) + sizeText(value));
}

void OptionValidator::integer(const std::string& key, int& value, const Range& range,
                              const std::string& /*meaning*/) {
  if (range.contains(value)) return;
  violations_.push_back(key + ": " + std::to_string(value) +
                        " is not allowed, must be an integer " + range.text());
}

void OptionValidator::flag(const std::string& /*key*/, bool& /*value*/,
                           const std::string& /*meaning*/) {}

void OptionValidator::text(const std::string& /*key*/, std::string& /*value*/,
                           const std::string& /*meaning*/) {}

void OptionValidator::choice(const std::string& key, std::string& value,
                             const std::vector<std::string>& names,
                             const std::string& /*meaning*/) {
  if (std::find(names.begin(), names.end(), value) != names.end()) return;
  violations_.push_back(key + ": '" + shortened(value, kLongestQuotation) +
                        "' is not allowed, must be one of: " + listed(names));
}

std::string numberText(double value) {
  if (std::isnan(value)) return "nan";  // printf shows the sign, which means nothing
  std::string text;
  for (int digits = 1; digits <= 17; ++digits) {
    text = plainFormat("%.*g", digits, value);
    if (plainStrtod(text.c_str()) == value) break;
  }
  // "2000" rather than "2e+03": seven digits show every value that came out with an exponent below
  // 1e7.
  if (std::abs(value) >= 1.0 && std::abs(value) < 1e7 && text.find('e') != std::string::npos) {
    text = plainFormat("%.7g", value);
  }
  return text;
}

}  // namespace mems_stiction
