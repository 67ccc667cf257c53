#include "verdict/part_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "errors/short_number.hpp"
#include "numeric/constants.hpp"
#include "numeric/mean.hpp"
#include "numeric/words.hpp"
#include "verdict/finding.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

/// Standard deviations from the median to the 97.5 % quantile.
/// Of the area under the density to both sides.
constexpr double kInside = 0.95;

/// What lies outside the model's range so far that a scan cannot say "no", however many there are.
constexpr std::uint32_t kNoStatementFlags =
    kBondedFlag | kNoEquilibriumFlag | kOnePixelFlag | kBorderFlag | kUnresolvedFlag;
/// Of a scan that says nothing: its adhesion may be higher than any other's.
constexpr std::uint32_t kUnboundedFlags = kBondedFlag | kNoEquilibriumFlag;

bool isKnown(const JudgedRatio& ratio) {
  return std::isfinite(ratio.value) && std::isfinite(ratio.lower) && std::isfinite(ratio.upper) &&
         ratio.value != 0.0;
}

/// Whether nothing but the number of its contacts keeps the scan from a statement.
bool lacksOnlyContacts(const ScanStatement& scan) {
  return scan.sticks == Sticks::kUnknown && (isKnown(scan.margin) || isKnown(scan.peel_number)) &&
         (scan.regime_flags & kNoStatementFlags) == 0 &&
         scan.contacts < kFewestContactsForStatement;
}

bool counts(const ScanStatement& scan) {
  return scan.sticks != Sticks::kUnknown || lacksOnlyContacts(scan);
}

/// A scan that does not show what holds: it serves as a wide one, and is no objection to the
/// others.
bool isUnresolved(const ScanStatement& scan) { return (scan.regime_flags & kUnresolvedFlag) != 0; }

double squared(double value) { return value * value; }

/// Share of Student's distribution within -t ... t: with tan(theta) = t/sqrt(freedom) its density
/// is that of a power of the cosine, which is summed by Simpson's rule.
double studentShare(double t, double freedom) {
  constexpr int kIntervals = 200;
  const double angle = std::atan(t / std::sqrt(freedom));
  double sum = 0.0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double weight = i == 0 || i == kIntervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * std::pow(std::cos(angle * i / kIntervals), freedom - 1.0);
  }
  const double whole = 0.5 * std::sqrt(kPi) *
                       std::exp(std::lgamma(0.5 * freedom) - std::lgamma(0.5 * freedom + 0.5));
  return sum * angle / (3.0 * kIntervals) / whole;
}

double studentDensity(double t, double freedom) {
  const double factor = std::exp(std::lgamma(0.5 * freedom + 0.5) - std::lgamma(0.5 * freedom));
  return factor / std::sqrt(freedom * kPi) *
         std::pow(1.0 + t * t / freedom, -0.5 * (freedom + 1.0));
}

/// One side of the intervals, in standard deviations of the logarithm.
struct Side {
  double common = 0.0;  ///< mean of c_i [-]

  /// @param reaches u_i [-] @param places p_i [-]
  Side(const std::vector<double>& reaches, const std::vector<double>& places) {
    std::vector<double> parts;
    for (std::size_t i = 0; i < reaches.size(); ++i) {
      parts.push_back(std::sqrt(std::max(0.0, squared(reaches[i]) - squared(places[i]))));
    }
    common = meanOf(parts);
  }

  /// Half of the interval of the mean's logarithm [-].
  double reach(double place_variance, double excess, double count) const {
    const double variance = squared(common) + (place_variance + excess) / count;
    if (excess == 0.0) return kNormal95 * std::sqrt(variance);
    const double freedom = (count - 1.0) * squared(variance / (excess / count));
    return studentQuantile(freedom) * std::sqrt(variance);
  }
};

/// Sorted out for one of the two ratios.
struct Sample {
  std::vector<double> logarithms;  ///< ln |M_i|
  std::vector<double> places;      ///< p_i [-]
  std::vector<double> away;        ///< u_i towards larger |M| [-]
  std::vector<double> near;        ///< u_i towards smaller |M| [-]

  void add(const JudgedRatio& ratio, double place_deviation) {
    const double size = std::abs(ratio.value);
    const double least = std::min(std::abs(ratio.lower), std::abs(ratio.upper));
    const double most = std::max(std::abs(ratio.lower), std::abs(ratio.upper));
    near.push_back(std::max(0.0, std::log(size / least)) / kNormal95);
    away.push_back(std::max(0.0, std::log(most / size)) / kNormal95);
    const double stated = std::isnan(place_deviation) ? 0.0 : place_deviation;
    places.push_back(std::min({stated, near.back(), away.back()}));
    logarithms.push_back(std::log(size));
  }
};

/// Of a scan.
const JudgedRatio& marginOf(const ScanStatement& scan) { return scan.margin; }
const JudgedRatio& peelNumberOf(const ScanStatement& scan) { return scan.peel_number; }
using RatioOf = std::function<const JudgedRatio&(const ScanStatement&)>;

/// Those of the scans whose word rests on the ratio.
/// - @p other what governs the others
std::vector<const ScanStatement*> governed(const std::vector<const ScanStatement*>& scans,
                                           const RatioOf& ratio_of, const char* other) {
  std::vector<const ScanStatement*> found;
  for (const ScanStatement* scan : scans) {
    if (scan->governed_by != other && isKnown(ratio_of(*scan))) found.push_back(scan);
  }
  return found;
}

/// Of one device all peel numbers have one sign: those of beams that buckle are below 0.
PooledRatio pooled(const std::vector<const ScanStatement*>& scans, const RatioOf& ratio_of) {
  PooledRatio result;
  Sample sample;
  JudgedRatio last;
  for (const ScanStatement* scan : scans) {
    const JudgedRatio& ratio = ratio_of(*scan);
    if (!isKnown(ratio)) continue;
    last = ratio;
    sample.add(ratio, scan->place_deviation);
    if (std::isnan(result.worst) || ratio.value < result.worst) {
      result.worst = ratio.value;
      result.worst_scan = scan->scan_name;
    }
  }
  if (sample.places.empty()) return result;
  const auto count = static_cast<double>(sample.places.size());
  double place_variance = 0.0;
  for (const double place : sample.places) place_variance += squared(place) / count;
  result.place_spread = std::sqrt(place_variance);
  if (sample.places.size() == 1) {
    static_cast<JudgedRatio&>(result) = last;
    return result;
  }
  const double mean = meanOf(sample.logarithms);
  double variance = 0.0;
  for (const double logarithm : sample.logarithms)
    variance += squared(logarithm - mean) / (count - 1.0);
  const double excess = std::max(0.0, variance - place_variance);
  const double near = Side(sample.near, sample.places).reach(place_variance, excess, count);
  const double away = Side(sample.away, sample.places).reach(place_variance, excess, count);
  const double sign = last.value > 0.0 ? 1.0 : -1.0;
  result.value = sign * std::exp(mean);
  result.lower = sign * std::exp(sign > 0.0 ? mean - near : mean + away);
  result.upper = sign * std::exp(sign > 0.0 ? mean + away : mean - near);
  result.spread = std::sqrt(variance);
  return result;
}

/// Geometric mean of the margins with the prefactors of the JKR-DMT transition; NaN if a scan has
/// none.
double pooledTransition(const std::vector<const ScanStatement*>& scans) {
  std::vector<double> logarithms;
  for (const ScanStatement* scan : scans) {
    if (isKnown(scan->margin)) logarithms.push_back(std::log(scan->margin_transition));
  }
  return logarithms.empty() ? Verdict::kNotStated : std::exp(meanOf(logarithms));
}

/// Over scans that count. States which ratio decides.
/// - @p pulled those of them that the margin governs
/// - @p peeled those that the peel number governs
Finding findingOf(const std::vector<const ScanStatement*>& pulled,
                  const std::vector<const ScanStatement*>& peeled, PooledVerdict& part) {
  Finding finding{Sticks::kNo, "nothing holds the contact: no adhesion"};
  const bool has_margin = !pulled.empty();
  const auto isGoverned = [](const ScanStatement* scan) { return !scan->governed_by.empty(); };
  const bool is_governed = std::any_of(pulled.begin(), pulled.end(), isGoverned) ||
                           std::any_of(peeled.begin(), peeled.end(), isGoverned);
  const auto worst = [&](const std::string& name, const PooledRatio& ratio) {
    return "; " + countText(part.counted_scans, "scan") + ", the lowest " + name + " " +
           shortNumber(ratio.worst) + " of " + ratio.worst_scan;
  };
  if (has_margin) {
    const double lowest = std::min(part.margin.lower, pooledTransition(pulled));
    if (is_governed) part.governed_by = kGovernedByForce;
    finding = judgedRatio("margin", part.margin.value, lowest, part.margin.upper, false, false);
    finding.reason += worst("margin", part.margin);
  }
  if (!peeled.empty()) {
    const PooledRatio& peel = part.peel_number;
    Finding of_beam = judgedRatio("peel number", peel.value, peel.lower, peel.upper, false, false);
    of_beam.reason += worst("peel number", peel);
    if (!has_margin || gravity(of_beam.sticks) > gravity(finding.sticks)) {
      finding = std::move(of_beam);
      if (is_governed) part.governed_by = kGovernedByPeeling;
    }
  }
  return finding;
}

/// A scan whose adhesion may be higher than any other's; empty if there is none.
std::string whatIsUnbounded(const std::vector<ScanStatement>& scans) {
  for (const ScanStatement& scan : scans) {
    if (counts(scan) || isUnresolved(scan) || (scan.regime_flags & kUnboundedFlags) == 0) continue;
    return scan.scan_name +
           " makes no statement, and may hold more than the others: " + scan.reason;
  }
  return "";
}

/// Why the scans allow no plain "no", and the word that they allow.
Finding objectionTo(const std::vector<ScanStatement>& scans, const PooledVerdict& part) {
  int contacts = 0;
  bool is_without_adhesion = true;
  for (const ScanStatement& scan : scans) {
    if (!counts(scan)) continue;
    if (scan.sticks == Sticks::kYes)
      return {Sticks::kMarginal, scan.scan_name + " by itself sticks"};
    contacts += scan.contacts;
    if (isKnown(scan.margin) || isKnown(scan.peel_number)) is_without_adhesion = false;
  }
  const std::string unbounded = whatIsUnbounded(scans);
  if (!unbounded.empty()) return {Sticks::kUnknown, unbounded};
  const auto asked =
      static_cast<int>(std::count_if(scans.begin(), scans.end(), [](const ScanStatement& scan) {
        return counts(scan) || !isUnresolved(scan);
      }));
  if (2 * part.counted_scans < asked) {
    return {Sticks::kUnknown, "only " + std::to_string(part.counted_scans) + " of " +
                                  countText(asked, "scan") + " make a statement"};
  }
  if (contacts < kFewestContactsForStatement && !is_without_adhesion) {
    return {Sticks::kUnknown,
            "the answer rests on " + countText(contacts, "contact") + ": scan more places"};
  }
  return {Sticks::kNo, ""};
}

int judgedBy(Judge judge, const std::vector<const ScanStatement*>& scans) {
  return static_cast<int>(std::count_if(
      scans.begin(), scans.end(), [&](const ScanStatement* scan) { return scan->judge == judge; }));
}

std::string judgesOf(const std::vector<const ScanStatement*>& scans) {
  std::string text;
  for (const Judge judge : {Judge::kPrediction, Judge::kHalfSpace}) {
    if (judgedBy(judge, scans) > 0)
      text += (text.empty() ? "" : " and ") + std::string(judgeText(judge));
  }
  return text;
}

std::vector<std::string> warningsOf(const std::vector<ScanStatement>& scans,
                                    const std::vector<const ScanStatement*>& counted,
                                    const PooledVerdict& part) {
  std::vector<std::string> warnings;
  const int silent = part.scan_count - part.counted_scans;
  if (silent > 0) {
    const auto last =
        std::find_if(scans.rbegin(), scans.rend(), [](const auto& scan) { return !counts(scan); });
    warnings.push_back(std::to_string(silent) + " of " + countText(part.scan_count, "scan") +
                       (silent == 1 ? " does" : " do") + " not count; of " + last->scan_name +
                       ": " + last->reason);
  }
  const int by_half_space = judgedBy(Judge::kHalfSpace, counted);
  const int by_prediction = judgedBy(Judge::kPrediction, counted);
  if (by_half_space > 0 && by_prediction > 0) {
    warnings.push_back("the half-space has judged " + std::to_string(by_half_space) + " of the " +
                       std::to_string(part.counted_scans) +
                       " scans that count, the prediction the others");
  }
  return warnings;
}

}  // namespace

ScanStatement statementOf(const std::string& scan_name, const Prediction& prediction,
                          const Verdict& verdict) {
  ScanStatement statement;
  statement.scan_name = scan_name;
  statement.contacts = prediction.pull_off_contact_count;
  judgeAgain(statement, verdict);
  return statement;
}

void judgeAgain(ScanStatement& statement, const Verdict& verdict) {
  statement.sticks = verdict.sticks;
  statement.reason = verdict.reason;
  statement.judge = verdict.judge;
  statement.margin = {verdict.margin, verdict.margin_lower, verdict.margin_upper};
  statement.peel_number = {verdict.peel_number, verdict.peel_number_lower,
                           verdict.peel_number_upper};
  statement.governed_by = verdict.governed_by;
  statement.margin_transition = verdict.margin_transition;
  statement.place_deviation = verdict.place_deviation;
  statement.regime_flags = verdict.regime_flags;
}

PooledVerdict pooledVerdictOf(const std::vector<ScanStatement>& scans) {
  PooledVerdict part;
  std::vector<const ScanStatement*> counted;
  for (const ScanStatement& scan : scans) {
    part.regime_flags |= scan.regime_flags;
    if (counts(scan)) counted.push_back(&scan);
  }
  part.scan_count = static_cast<int>(scans.size());
  part.counted_scans = static_cast<int>(counted.size());
  part.verdict_by = judgesOf(counted);
  part.warnings = warningsOf(scans, counted, part);
  const std::vector<const ScanStatement*> pulled = governed(counted, marginOf, kGovernedByPeeling);
  const std::vector<const ScanStatement*> peeled =
      governed(counted, peelNumberOf, kGovernedByForce);
  part.margin = pooled(pulled.empty() ? counted : pulled, marginOf);
  part.peel_number = pooled(peeled.empty() ? counted : peeled, peelNumberOf);
  if (scans.size() == 1) {
    part.governed_by = scans.front().governed_by;
    part.sticks = scans.front().sticks;
    part.reason = scans.front().reason;
    return part;
  }
  if (counted.empty()) {
    part.reason =
        scans.empty() ? "no scan yet" : "no scan makes a statement; " + scans.back().reason;
    return part;
  }
  Finding finding = findingOf(pulled, peeled, part);
  if (finding.sticks == Sticks::kNo) {
    const Finding objection = objectionTo(scans, part);
    if (objection.sticks != Sticks::kNo)
      finding = {objection.sticks, finding.reason + "; but " + objection.reason};
  }
  part.sticks = finding.sticks;
  part.reason = finding.reason;
  return part;
}

PooledVerdict pooledVerdictOf(const std::vector<ScanStatement>& scans, const Verdict& of_device) {
  PooledVerdict part = pooledVerdictOf(scans);
  ScanStatement judged;
  judgeAgain(judged, of_device);
  static_cast<JudgedRatio&>(part.margin) = judged.margin;
  static_cast<JudgedRatio&>(part.peel_number) = judged.peel_number;
  part.governed_by = judged.governed_by;
  part.sticks = of_device.sticks;
  part.reason = of_device.reason;
  if (part.scan_count > 1) part.reason += "; " + countText(part.scan_count, "scan") + " together";
  part.verdict_by = judgeText(of_device.judge);
  part.counted_scans = part.scan_count;
  part.regime_flags |= of_device.regime_flags;
  part.restoring_force = of_device.restoring_force;
  part.device_pull_off_force = of_device.device_pull_off_force;
  part.device_pull_off_force_lower = of_device.device_pull_off_force_lower;
  part.device_pull_off_force_upper = of_device.device_pull_off_force_upper;
  part.warnings.clear();
  const std::string unbounded = whatIsUnbounded(scans);
  if (part.sticks == Sticks::kNo && !unbounded.empty()) {
    part.sticks = Sticks::kUnknown;
    part.reason += "; but " + unbounded;
  }
  return part;
}

double studentQuantile(double freedom) {
  constexpr double kLarge =
      1e5;  // from here on one term of the expansion in 1/freedom is left, within 1e-9
  if (!(freedom < kLarge))
    return kNormal95 + (kNormal95 * kNormal95 + 1.0) * kNormal95 / (4.0 * freedom);
  double quantile =
      kNormal95;  // from below: the share is concave, so that Newton's steps stay below the root
  for (int i = 0; i < 50; ++i) {
    const double step =
        (kInside - studentShare(quantile, freedom)) / (2.0 * studentDensity(quantile, freedom));
    quantile += step;
    if (std::abs(step) < 1e-10 * quantile) break;
  }
  return quantile;
}

}  // namespace mems_stiction
