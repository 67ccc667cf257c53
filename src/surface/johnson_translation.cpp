#include "surface/johnson_translation.hpp"

#include <array>
#include <cmath>

#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {
namespace {

constexpr double kMaxShift =
    60.0;  ///< gamma/delta: beyond it both families are log-normal to 1e-26
constexpr double kMinDelta = 0.05;  ///< below it the bounded family stands at two levels
constexpr int kBisections = 48;

struct Shape {
  double skewness = 0.0;
  double kurtosis = 3.0;
};

/// The standard normal in equal steps: the trapezoidal rule converges exponentially for smooth
/// functions.
struct Quadrature {
  static constexpr int kPoints = 1201;
  std::array<double, kPoints> g{};
  std::array<double, kPoints> weight{};

  Quadrature() {
    constexpr double kLast = 9.0;
    double sum = 0.0;
    for (std::size_t index = 0; index < kPoints; ++index) {
      g[index] = kLast * (2.0 * static_cast<double>(index) / (kPoints - 1) - 1.0);
      weight[index] = std::exp(-0.5 * g[index] * g[index]);
      sum += weight[index];
    }
    for (double& share : weight) share /= sum;
  }
};

const Quadrature& quadrature() {
  static const Quadrature points;
  return points;
}

/// Mean of value(g) over the standard normal.
template <typename Value>
double normalMean(Value value) {
  const Quadrature& points = quadrature();
  double sum = 0.0;
  for (std::size_t index = 0; index < Quadrature::kPoints; ++index)
    sum += points.weight[index] * value(points.g[index]);
  return sum;
}

/// value(x) rises or falls on [low, high]; the x where it meets `target`.
template <typename Value>
double bisect(double low, double high, double target, Value value) {
  const bool rising = value(high) > value(low);
  for (int round = 0; round < kBisections; ++round) {
    const double middle = 0.5 * (low + high);
    if ((value(middle) < target) == rising) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return 0.5 * (low + high);
}

Shape logNormalShape(double delta) {
  const double w = std::exp(1.0 / (delta * delta));
  return {std::sqrt(w - 1.0) * (w + 2.0), ((w + 2.0) * w + 3.0) * w * w - 3.0};
}

double logistic(double value) { return 1.0 / (1.0 + std::exp(-value)); }

Shape boundedShape(double delta, double shift) {
  const Quadrature& points = quadrature();
  std::array<double, Quadrature::kPoints> values;
  double mean = 0.0;
  for (std::size_t index = 0; index < values.size(); ++index) {
    values[index] = logistic(points.g[index] / delta - shift);
    mean += points.weight[index] * values[index];
  }
  double second = 0.0;
  double third = 0.0;
  double fourth = 0.0;
  for (std::size_t index = 0; index < values.size(); ++index) {
    const double deviation = values[index] / mean - 1.0;
    const double square = points.weight[index] * deviation * deviation;
    second += square;
    third += square * deviation;
    fourth += square * deviation * deviation;
  }
  return {third / std::pow(second, 1.5), fourth / (second * second)};
}

/// Closed form (Johnson 1949), for sinh(g/delta + shift).
Shape unboundedShape(double delta, double shift) {
  const double w = std::exp(1.0 / (delta * delta));
  const double less = w - 1.0;
  const double second = 0.5 * less * (w * std::cosh(2.0 * shift) + 1.0);
  const double third = 0.25 * std::sqrt(w) * less * less *
                       (w * (w + 2.0) * std::sinh(3.0 * shift) + 3.0 * std::sinh(shift));
  const double fourth = 0.125 * less * less *
                        (w * w * (((w + 2.0) * w + 3.0) * w * w - 3.0) * std::cosh(4.0 * shift) +
                         4.0 * w * w * (w + 2.0) * std::cosh(2.0 * shift) + 3.0 * (2.0 * w + 1.0));
  return {third / std::pow(second, 1.5), fourth / (second * second)};
}

}  // namespace

JohnsonTranslation::JohnsonTranslation(double skewness, double kurtosis) {
  if (!Range::within(-4.0, 4.0).contains(skewness) ||
      !Range::within(skewness * skewness + 1.2, 100.0).contains(kurtosis)) {
    throw OptionsError(
        {"skewness: " + numberText(skewness) + " with kurtosis " + numberText(kurtosis) +
         " is not allowed; skewness must be in [-4, 4], kurtosis in [skewness^2 + 1.2, 100]"});
  }
  sign_ = skewness < 0.0 ? -1.0 : 1.0;
  const double wanted = std::fabs(skewness);
  constexpr double kGaussian =
      1e-6;  // a delta of 1000 and more is the identity to three digits of the moments' change
  if (wanted < kGaussian && std::fabs(kurtosis - 3.0) < kGaussian) return;

  // The log-normal of this skewness is where both families end.
  double end = 1e4;
  if (wanted >= kGaussian)
    end = bisect(0.3, 1e7, wanted, [](double delta) { return logNormalShape(delta).skewness; });
  const double border = wanted >= kGaussian ? logNormalShape(end).kurtosis : 3.0;
  const double tolerance = 1e-4 * (border - 1.0);
  if (wanted >= kGaussian && std::fabs(kurtosis - border) < tolerance) {
    family_ = Family::kLogNormal;
    delta_ = end;
  } else {
    const bool bounded = kurtosis < border;
    family_ = bounded ? Family::kBounded : Family::kUnbounded;
    const auto shape = [bounded](double delta, double shift) {
      return bounded ? boundedShape(delta, shift) : unboundedShape(delta, shift);
    };
    const auto shiftOf = [&](double delta) {
      if (wanted < kGaussian) return 0.0;
      return bisect(0.0, kMaxShift, wanted,
                    [&](double shift) { return shape(delta, shift).skewness; });
    };
    delta_ = bisect(bounded ? kMinDelta : 0.4, end, kurtosis,
                    [&](double delta) { return shape(delta, shiftOf(delta)).kurtosis; });
    gamma_ = (bounded ? 1.0 : -1.0) * shiftOf(delta_) * delta_;
  }
  mean_ = normalMean([this](double g) { return raw(g); });
  deviation_ =
      std::sqrt(normalMean([this](double g) { return (raw(g) - mean_) * (raw(g) - mean_); }));
}

double JohnsonTranslation::raw(double g) const {
  switch (family_) {
    case Family::kNormal:
      break;
    case Family::kLogNormal:
      return std::exp(g / delta_);
    case Family::kBounded:
      return logistic((g - gamma_) / delta_);
    case Family::kUnbounded:
      return std::sinh((g - gamma_) / delta_);
  }
  return g;
}

double JohnsonTranslation::operator()(double g) const {
  return sign_ * (raw(sign_ * g) - mean_) / deviation_;
}

double JohnsonTranslation::gaussianCorrelation(double correlation) const {
  if (family_ == Family::kNormal) return correlation;
  // Mehler: the correlation of the translations is the sum of c_n^2 r^n, c_n the coefficients in
  // Hermite polynomials of norm 1: he_(n+1) = (g he_n - sqrt(n) he_(n-1))/sqrt(n + 1).
  constexpr int kTerms = 30;
  std::array<double, kTerms> coefficients{};
  const Quadrature& points = quadrature();
  for (std::size_t index = 0; index < Quadrature::kPoints; ++index) {
    const double g = points.g[index];
    const double value = points.weight[index] * (*this)(g);
    double before = 0.0;
    double current = 1.0;
    for (int n = 0; n < kTerms; ++n) {
      coefficients[static_cast<std::size_t>(n)] += current * value;
      const double next =
          (g * current - std::sqrt(static_cast<double>(n)) * before) / std::sqrt(n + 1.0);
      before = current;
      current = next;
    }
  }
  std::array<double, kTerms> squares{};
  double sum = 0.0;
  for (std::size_t term = 1; term < kTerms; ++term) {
    squares[term] = coefficients[term] * coefficients[term];
    sum += squares[term];
  }
  return bisect(0.0, 1.0, correlation * sum, [&](double r) {
    double value = 0.0;
    for (std::size_t term = kTerms - 1; term >= 1; --term) value = (value + squares[term]) * r;
    return value;
  });
}

}  // namespace mems_stiction
