#include "mems_stiction/verdict/margin_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "mems_stiction/base/constants.hpp"
#include "mems_stiction/mechanics/jkr.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"
#include "mems_stiction/mechanics/surface_forces.hpp"
#include "mems_stiction/verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

/// Standard deviations from the median to the 97.5 % quantile.
constexpr double kToQuantile = 1.959964;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Standard deviation of the logarithm of a lognormal number, by its relative one [-].
double logDeviation(double relative_deviation) {
  return std::sqrt(std::log1p(relative_deviation * relative_deviation));
}

/// Standard normal numbers that are the same everywhere: std::normal_distribution is not.
class NormalNumbers {
 public:
  explicit NormalNumbers(int seed) : engine_(static_cast<std::uint64_t>(seed)) {}

  double next() {  // Box and Muller, one of the pair
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * kPi * uniform());
  }

  /// Lognormal with median 1 and the given relative standard deviation.
  double factor(double relative_deviation) {
    const double normal = next();  // drawn even if unused: each constant keeps its own numbers
    return std::exp(normal * logDeviation(relative_deviation));
  }

 private:
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

  std::mt19937_64 engine_;
};

/// No other seed is below 0: the numbers of the other constants are the same with and without it.
int hamakerSeed(const UncertaintyOptions& uncertainty) { return -1 - uncertainty.seed; }

/// What a sample needs of the contacts, as arrays.
class ContactList {
 public:
  ContactList(const std::vector<Asperity>& asperities, const ContactPair& pair, bool is_elastic) {
    const double stiffness = 4.0 / 3.0 * pair.contact_modulus;
    for (const Asperity& asperity : asperities) {
      const double area = asperity.cap_radius * asperity.cap_radius;
      imposed_.push_back(stiffness * area * asperity.cap_radius / asperity.composite_radius);
      yield_.push_back(pair.hardness * kPi * area);
      plasticity_.push_back(is_elastic ? 0.0 : asperity.plasticity_index);
      radius_sum_ += asperity.composite_radius;
      square_sum_ += asperity.composite_radius * asperity.composite_radius;
    }
  }

  /// C for loads and plasticity indices times the given factors [N].
  double carriedLoad(double imposed_factor, double yield_factor, double plasticity_factor) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < imposed_.size(); ++i) {
      const double share = regimeFactor(plasticity_factor * plasticity_[i]);
      const double imposed = imposed_factor * imposed_[i];
      sum += share * imposed + (1.0 - share) * std::min(imposed, yield_factor * yield_[i]);
    }
    return sum;
  }

  double radiusSum() const { return radius_sum_; }
  /// Relative standard deviation of the sum of radii when contacts come at random.
  double samplingDeviation() const { return radius_sum_ > 0.0 ? std::sqrt(square_sum_) / radius_sum_ : 0.0; }

 private:
  std::vector<double> imposed_;
  std::vector<double> yield_;
  std::vector<double> plasticity_;
  double radius_sum_ = 0.0;
  double square_sum_ = 0.0;
};

/// How far the separation curve lies from the half-space: standard deviation of the logarithm of their ratio, by what
/// flattening costs over what adhesion gives and how brittle contacts are (doc/trust.md).
struct ModelError {
  double pull_off;
  double work;
};

ModelError modelError(const Prediction& prediction) {
  if (prediction.is_conforming) return {0.07, 0.06};
  if (mayGrowTogether(prediction)) return {0.10, 0.11};
  return {0.05, 0.04};
}

/// Samples of a prediction by the separation curve: its exponents move it with the constants.
AdhesionSpread curveSpread(const Prediction& prediction, const UncertaintyOptions& uncertainty,
                           const ModelError& error) {
  AdhesionSpread spread;
  if (!prediction.listsContacts() || !(prediction.pull_off_force > 0.0)) return spread;
  double radius_sum = 0.0;
  double square_sum = 0.0;
  for (const Asperity& asperity : prediction.holdingContacts()) {
    radius_sum += asperity.composite_radius;
    square_sum += asperity.composite_radius * asperity.composite_radius;
  }
  const bool is_local = uncertainty.scan_sampling && !prediction.is_conforming && radius_sum > 0.0;
  const double sampling = is_local ? std::sqrt(square_sum) / radius_sum : 0.0;
  spread.place_deviation = logDeviation(sampling);
  NormalNumbers numbers(uncertainty.seed);
  NormalNumbers hamaker_numbers(hamakerSeed(uncertainty));
  for (int i = 0; i < uncertainty.samples; ++i) {
    const double work = numbers.factor(uncertainty.work_of_adhesion);
    numbers.factor(uncertainty.hardness);
    const double modulus = numbers.factor(uncertainty.youngs_modulus);
    const double pitch = numbers.factor(uncertainty.pitch);
    numbers.factor(uncertainty.cutoff_distance);
    const double hamaker = hamaker_numbers.factor(uncertainty.hamaker_constant);
    const double place = numbers.factor(sampling);
    const double model = numbers.next();
    const auto moved = [&](const Exponents& exponents) {
      return std::pow(work, exponents.adhesion) * std::pow(modulus, exponents.modulus) *
             std::pow(hamaker, exponents.hamaker);
    };
    // radii go with the square of the pitch, as the nominal area does
    spread.pull_off.push_back(place * moved(prediction.pull_off_exponents) * std::exp(error.pull_off * model));
    spread.apparent_work.push_back(place * moved(prediction.work_exponents) * std::exp(error.work * model) / pitch);
  }
  return spread;
}

/// Samples of a prediction whose contacts are known one by one.
AdhesionSpread contactSpread(const Prediction& prediction, const Options& options,
                             const UncertaintyOptions& uncertainty) {
  AdhesionSpread spread;
  if (!prediction.listsContacts()) return spread;
  const ContactPair pair(options.lower, options.upper);
  const ContactList contacts(prediction.asperities, pair, options.deformation == Deformation::kElastic);

  const double adhesion = kPi * options.interface.work_of_adhesion * contacts.radiusSum();
  const double applied = prediction.mechanical_load + prediction.electrostatic_force;
  // what else attracts around the contacts, such as condensed water
  const double other = prediction.pull_off_force - prediction.pull_off_force_jkr - prediction.van_der_waals_force;
  const double demand = applied + prediction.van_der_waals_force + other + 2.0 * adhesion;
  const double carried = contacts.carriedLoad(1.0, 1.0, 1.0);
  const double pull_off = 1.5 * adhesion + prediction.van_der_waals_force + other;
  const double open_area = prediction.nominal_area - prediction.contact_area;
  const double far = prediction.mean_gap > 0.0
                         ? std::min(prediction.van_der_waals_force,
                                    open_area * surface_forces::vanDerWaalsPressure(prediction.mean_gap,
                                                                                    options.interface.hamaker_constant))
                         : 0.0;
  const double near = prediction.van_der_waals_force - far;

  const double sampling = uncertainty.scan_sampling ? contacts.samplingDeviation() : 0.0;
  spread.place_deviation = pull_off > 0.0 ? logDeviation(sampling) * (pull_off - far) / pull_off : 0.0;

  NormalNumbers numbers(uncertainty.seed);
  NormalNumbers hamaker_numbers(hamakerSeed(uncertainty));
  const auto count = static_cast<std::size_t>(uncertainty.samples);
  spread.pull_off.reserve(count);
  spread.apparent_work.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double work = numbers.factor(uncertainty.work_of_adhesion);
    const double hardness = numbers.factor(uncertainty.hardness);
    const double modulus = numbers.factor(uncertainty.youngs_modulus);
    const double pitch = numbers.factor(uncertainty.pitch);
    const double cutoff = numbers.factor(uncertainty.cutoff_distance);
    const double hamaker = hamaker_numbers.factor(uncertainty.hamaker_constant);
    const double place = numbers.factor(sampling);

    const double area = pitch * pitch;
    const double near_now = area * (hamaker * near / (cutoff * cutoff) + other);
    const double demand_now = applied + near_now + area * hamaker * far + 2.0 * area * work * adhesion;
    const double carried_now = contacts.carriedLoad(modulus * pitch, hardness * area, modulus / hardness / pitch);
    const double growth = demand > 0.0 && carried > 0.0 ? demand_now / carried_now * (carried / demand) : 1.0;
    const double pull_off_now = place * growth * (1.5 * area * work * adhesion + near_now) + area * hamaker * far;
    spread.pull_off.push_back(pull_off > 0.0 ? pull_off_now / area / pull_off : 1.0);
    // JKR's energy at no load goes with Gamma^(5/3) R^(4/3) K^(-2/3)
    const double energy = std::pow(work, 5.0 / 3.0) * std::pow(area, 4.0 / 3.0) * std::pow(modulus, -2.0 / 3.0);
    spread.apparent_work.push_back(place * growth * energy / area);
  }
  return spread;
}

/// Moves sorted samples away from their median by a factor whose 2.5 % and 97.5 % quantiles are those of the range, in
/// quadrature in the logarithm: quantile by quantile, so that no end comes nearer.
void widen(std::vector<double>& samples, const FactorRange& range, NormalNumbers& numbers) {
  if (samples.empty()) return;
  std::vector<double> normals(samples.size());
  for (double& normal : normals) normal = numbers.next();
  std::sort(normals.begin(), normals.end());
  const double below = -std::log(range.lowest) / kToQuantile;
  const double above = std::log(range.highest) / kToQuantile;
  const double median = quantile(samples, 0.5);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double distance = std::log(samples[i] / median);
    if (samples[i] < median || (samples[i] == median && 2 * i < samples.size())) {
      samples[i] = median * std::exp(-std::hypot(distance, below * std::min(normals[i], 0.0)));
    } else {
      samples[i] = median * std::exp(std::hypot(distance, above * std::max(normals[i], 0.0)));
    }
  }
}

/// What the formulation's samples leave out.
void takeEvidence(const Evidence& evidence, NormalNumbers& numbers, AdhesionSpread& spread) {
  if (evidence.half_space != nullptr) {
    const double reach = kToQuantile * halfSpaceError(*evidence.half_space);
    const FactorRange range{std::exp(-reach), std::exp(reach)};
    widen(spread.pull_off, range, numbers);
    widen(spread.apparent_work, range, numbers);
  }
  if (evidence.cleaning) {
    widen(spread.pull_off, evidence.cleaning->pull_off, numbers);
    widen(spread.apparent_work, evidence.cleaning->apparent_work, numbers);
  }
}

}  // namespace

double apparentWorkOfAdhesion(const Prediction& prediction, const Options& options) {
  if (prediction.followsCurve()) return prediction.apparent_work_of_adhesion;
  if (!prediction.listsContacts()) return kUnknown;
  const double work = options.interface.work_of_adhesion;
  const double modulus = ContactPair(options.lower, options.upper).contact_modulus;
  double energy = 0.0;
  for (const Asperity& asperity : prediction.asperities) {
    const double radius = asperity.composite_radius;
    const double contact = jkr::equilibriumContactRadius(0.0, work, radius, modulus);
    energy -= jkr::energy(contact, work, radius, modulus);
  }
  return energy / prediction.nominal_area;
}

AdhesionSpread adhesionSpread(const Prediction& prediction, const Options& options,
                              const UncertaintyOptions& uncertainty, const Evidence& evidence) {
  const ModelError error = evidence.half_space != nullptr ? ModelError{0.0, 0.0} : modelError(prediction);
  AdhesionSpread spread = prediction.followsCurve() ? curveSpread(prediction, uncertainty, error)
                                                    : contactSpread(prediction, options, uncertainty);
  NormalNumbers numbers(uncertainty.seed);
  std::sort(spread.pull_off.begin(), spread.pull_off.end());
  std::sort(spread.apparent_work.begin(), spread.apparent_work.end());
  takeEvidence(evidence, numbers, spread);
  return spread;
}

ForceInterval pullOffInterval(const Prediction& prediction, const Options& options,
                              const UncertaintyOptions& uncertainty) {
  const AdhesionSpread spread = adhesionSpread(prediction, options, uncertainty);
  return {prediction.pull_off_force * quantile(spread.pull_off, kLowerShare),
          prediction.pull_off_force * quantile(spread.pull_off, kUpperShare)};
}

double quantile(const std::vector<double>& sorted_samples, double share) {
  if (sorted_samples.empty()) return kUnknown;
  const double place = share * static_cast<double>(sorted_samples.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), sorted_samples.size() - 1);
  const std::size_t above = std::min(below + 1, sorted_samples.size() - 1);
  return sorted_samples[below] + (place - static_cast<double>(below)) * (sorted_samples[above] - sorted_samples[below]);
}

}  // namespace mems_stiction
