#include "verdict/margin_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>

#include "numeric/constants.hpp"
#include "verdict/part_verdict.hpp"

namespace mems_stiction {
namespace {

/// Standard deviations from the median to the 97.5 % quantile.

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Standard normal numbers that are the same everywhere: std::normal_distribution is not.
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : engine_(seed) {}

  double next() {  // Box and Muller, one of the pair
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * kPi * uniform());
  }

  /// Lognormal with median 1 and the given relative standard deviation.
  double factor(double relative_deviation) {
    const double normal = next();  // drawn even if unused: each constant keeps its own numbers
    return std::exp(normal * lognormalDeviation(relative_deviation));
  }

 private:
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

  std::mt19937_64 engine_;
};

/// Constants that came later have seeds of their own, which no other run has: the numbers of the
/// others are the same with and without them.
std::uint64_t hamakerSeed(const UncertaintyOptions& uncertainty) {
  return static_cast<std::uint64_t>(-1 - uncertainty.seed);
}
std::uint64_t contactPotentialSeed(const UncertaintyOptions& uncertainty) {
  constexpr std::uint64_t kBeyondSeeds = 1ULL << 32U;
  return kBeyondSeeds + static_cast<std::uint64_t>(uncertainty.seed);
}

std::unique_ptr<ContactResponse> responseOf(const Prediction& prediction, const Options& options) {
  if (prediction.model.respond == nullptr) return nullptr;
  return prediction.model.respond(
      {options, prediction.asperities, prediction.mechanical_load, prediction.electrostatic_force,
       prediction.van_der_waals_force, prediction.pull_off_force, prediction.pull_off_force_jkr,
       prediction.nominal_area, prediction.contact_area, prediction.mean_gap});
}

/// Radii go with the square of the pitch, as the nominal area does.
FigureFactors byExponents(const Prediction& prediction, const ConstantFactors& factors,
                          const FigureFactors& error) {
  const auto moved = [&](const Exponents& exponents) {
    return std::pow(factors.adhesion, exponents.adhesion) *
           std::pow(factors.modulus, exponents.modulus) *
           std::pow(factors.hamaker, exponents.hamaker) *
           std::pow(factors.contact_potential, exponents.contact_potential);
  };
  return {factors.place * moved(prediction.pull_off_exponents) * error.pull_off,
          factors.place * moved(prediction.work_exponents) * error.work / factors.pitch};
}

/// Relative standard deviation of the sum of radii when contacts come at random.
double samplingDeviation(const std::vector<Asperity>& contacts) {
  double radius_sum = 0.0;
  double square_sum = 0.0;
  for (const Asperity& asperity : contacts) {
    radius_sum += asperity.composite_radius;
    square_sum += asperity.composite_radius * asperity.composite_radius;
  }
  return radius_sum > 0.0 ? std::sqrt(square_sum) / radius_sum : 0.0;
}

/// Standard normal number below which the share lies. @param share in (0, 1)
double normalQuantile(double share) {
  if (share > 0.5) return -normalQuantile(1.0 - share);
  double normal =
      0.0;  // from above: the share is convex there, so Newton's steps stay above the root
  for (int i = 0; i < 100; ++i) {
    const double density = std::exp(-0.5 * normal * normal) / std::sqrt(2.0 * kPi);
    const double step = (0.5 * std::erfc(-normal / std::sqrt(2.0)) - share) / density;
    normal -= step;
    if (std::abs(step) < 1e-12) break;
  }
  return normal;
}

/// Samples of a prediction, in the order in which they are drawn.
AdhesionSpread samplesOf(const Prediction& prediction, const Options& options,
                         const UncertaintyOptions& uncertainty, const ModelError& error) {
  AdhesionSpread spread;
  const bool are_known = prediction.model.respond == nullptr ? prediction.listsHoldingContacts()
                                                             : prediction.listsContacts();
  if (!are_known) return spread;
  const std::unique_ptr<ContactResponse> response = responseOf(prediction, options);
  if (!response && !(prediction.pull_off_force > 0.0)) return spread;
  const bool is_local = uncertainty.scan_sampling && !prediction.is_conforming;
  const double sampling = is_local ? samplingDeviation(prediction.holdingContacts()) : 0.0;
  const double place_deviation = lognormalDeviation(sampling);
  spread.place_deviation = response ? response->placeDeviation(place_deviation) : place_deviation;

  NormalNumbers numbers(static_cast<std::uint64_t>(uncertainty.seed));
  NormalNumbers hamaker_numbers(hamakerSeed(uncertainty));
  NormalNumbers potential_numbers(contactPotentialSeed(uncertainty));
  const auto count = static_cast<std::size_t>(uncertainty.samples);
  spread.pull_off.reserve(count);
  spread.apparent_work.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    ConstantFactors factors;
    factors.adhesion = numbers.factor(uncertainty.work_of_adhesion);
    factors.hardness = numbers.factor(uncertainty.hardness);
    factors.modulus = numbers.factor(uncertainty.youngs_modulus);
    factors.pitch = numbers.factor(uncertainty.pitch);
    factors.cutoff = numbers.factor(uncertainty.cutoff_distance);
    factors.hamaker = hamaker_numbers.factor(uncertainty.hamaker_constant);
    factors.contact_potential = potential_numbers.factor(uncertainty.contact_potential);
    factors.place = numbers.factor(sampling);
    FigureFactors moved;
    if (response) {
      moved = response->under(factors);
    } else {
      const double model = numbers.next();
      moved = byExponents(prediction, factors,
                          {std::exp(error.pull_off * model), std::exp(error.work * model)});
    }
    spread.pull_off.push_back(moved.pull_off);
    spread.apparent_work.push_back(moved.work);
  }
  return spread;
}

/// What the samples leave out.
void takeEvidence(const Evidence& evidence, AdhesionSpread& spread) {
  if (evidence.half_space != nullptr) {
    const FactorRange range = factorsWithin(kNormal95 * halfSpaceError(*evidence.half_space));
    widen(spread.pull_off, range);
    widen(spread.apparent_work, range);
  }
  if (evidence.cleaning) {
    widen(spread.pull_off, evidence.cleaning->pull_off);
    widen(spread.apparent_work, evidence.cleaning->apparent_work);
  }
}

}  // namespace

void UncertaintyOptions::describe(OptionVisitor& visitor) {
  const Range relative = Range::within(0.0, 1.0);
  visitor.number("uncertainty/work_of_adhesion", work_of_adhesion, "", relative,
                 "relative standard uncertainty of the work of adhesion");
  visitor.number("uncertainty/hardness", hardness, "", relative,
                 "relative standard uncertainty of the hardness");
  visitor.number("uncertainty/youngs_modulus", youngs_modulus, "", relative,
                 "relative standard uncertainty of Young's modulus");
  visitor.number("uncertainty/pitch", pitch, "", relative,
                 "relative standard uncertainty of the scan's pitch");
  visitor.number("uncertainty/cutoff_distance", cutoff_distance, "", relative,
                 "relative standard uncertainty of the cut-off distance");
  visitor.number("uncertainty/hamaker_constant", hamaker_constant, "", relative,
                 "relative standard uncertainty of the Hamaker constant");
  visitor.number("uncertainty/contact_potential", contact_potential, "", relative,
                 "relative standard uncertainty of the contact potential");
  visitor.flag("uncertainty/scan_sampling", scan_sampling,
               "count that another place of the surface would have other contacts");
  visitor.integer("uncertainty/samples", samples, Range::within(20, 100000),
                  "samples of the uncertain constants");
  visitor.integer("uncertainty/seed", seed, Range::nonNegative(),
                  "the same seed gives the same samples");
}

double apparentWorkOfAdhesion(const Prediction& prediction, const Options& options) {
  if (prediction.model.respond == nullptr) return prediction.apparent_work_of_adhesion;
  return prediction.listsContacts() ? responseOf(prediction, options)->partingWork() : kUnknown;
}

AdhesionSpread adhesionSpread(const Prediction& prediction, const Options& options,
                              const UncertaintyOptions& uncertainty, const Evidence& evidence) {
  AdhesionSpread spread;
  if (evidence.device) {
    const DeviceEvidence& device = *evidence.device;
    const bool is_answered =
        evidence.half_space != nullptr && !device.force_factors_without_doubt.empty();
    spread.pull_off = is_answered ? device.force_factors_without_doubt : device.force_factors;
    spread.apparent_work = is_answered ? device.work_factors_without_doubt : device.work_factors;
  } else {
    const ModelError error = evidence.half_space != nullptr ? ModelError() : prediction.model.error;
    spread = samplesOf(prediction, options, uncertainty, error);
    std::sort(spread.pull_off.begin(), spread.pull_off.end());
    std::sort(spread.apparent_work.begin(), spread.apparent_work.end());
  }
  takeEvidence(evidence, spread);
  return spread;
}

void widen(std::vector<double>& samples, const FactorRange& range) {
  if (samples.empty()) return;
  const double below = -std::log(range.lowest) / kNormal95;
  const double above = std::log(range.highest) / kNormal95;
  const double median = quantile(samples, 0.5);
  const auto count = static_cast<double>(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    // By the shares of quantile(), so that the ends are those of the range; the first and the last
    // are finite.
    const double share = static_cast<double>(i) / std::max(count - 1.0, 1.0);
    const double normal = normalQuantile(std::clamp(share, 0.5 / count, 1.0 - 0.5 / count));
    const double distance = std::log(samples[i] / median);
    const double moved =
        normal < 0.0 ? -std::hypot(distance, below * normal) : std::hypot(distance, above * normal);
    samples[i] = median * std::exp(moved);
  }
}

FactorRange factorsWithin(double reach) { return {std::exp(-reach), std::exp(reach)}; }

ForceInterval pullOffInterval(const Prediction& prediction, const Options& options,
                              const UncertaintyOptions& uncertainty) {
  const AdhesionSpread spread = adhesionSpread(prediction, options, uncertainty);
  return {prediction.pull_off_force * quantile(spread.pull_off, kLowerShare),
          prediction.pull_off_force * quantile(spread.pull_off, kUpperShare)};
}

double lognormalDeviation(double relative_deviation) {
  return std::sqrt(std::log1p(relative_deviation * relative_deviation));
}

double quantile(const std::vector<double>& sorted_samples, double share) {
  if (sorted_samples.empty()) return kUnknown;
  const double place = share * static_cast<double>(sorted_samples.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), sorted_samples.size() - 1);
  const std::size_t above = std::min(below + 1, sorted_samples.size() - 1);
  return sorted_samples[below] +
         (place - static_cast<double>(below)) * (sorted_samples[above] - sorted_samples[below]);
}

}  // namespace mems_stiction
