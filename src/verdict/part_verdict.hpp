#pragma once

/// @file
/// Does this part stick, by several scans of it? From the verdicts of its scans to one, with its
/// interval.
///
/// A scan is one place of the part. Its margin M_i (or peel number) has a 95 % interval, from which
///
///     u_i = ln(upper_i/M_i)/1.96
///             standard uncertainty of ln M_i [-]; the same with M_i/lower_i to the other side
///     p_i                         what of it is of the place alone, by the number of contacts
///                                 (Poisson; u_i at most)
///     c_i = sqrt(u_i^2 - p_i^2)   what is common to all places: constants, model, pitch, cleaning
///
/// Of the k scans that make a statement:
///
///     ln M  = mean of ln M_i            the geometric mean: a scan of half and one of twice cancel
///     s^2   = sum (ln M_i - ln M)^2/(k - 1)      what the scans show
///     p^2   = mean of p_i^2                      what the number of their contacts explains
///     tau^2 = max(0, s^2 - p^2)              what the part differs from place to place beside that
///     u^2  = (mean of c_i)^2 + (p^2 + tau^2)/k
///             only what is of the place falls with the number of scans
///     nu   = (k - 1) u^4/(tau^2/k)^2    degrees of freedom: tau alone is known from the scans only
///     M exp(-t u) ... M exp(t u)                 t the 97.5 % quantile of Student's distribution
///
/// Two scans that agree leave t = 1.96, two that contradict each other let it grow up to 12.7. What
/// is common does not shrink: its c_i are wholly correlated, and so averaged as they are. One scan
/// gives its own verdict, unchanged.
///
/// The word is that of one scan (verdict.hpp), for this interval, with these exceptions:
///
/// - One scan that by itself says "yes" makes a "no" marginal.
/// - A scan that does not show what holds (missing_scan.hpp) serves as a wide one, and is no
///   objection to others.
/// - Other scans that cannot count make a "no" unknown: one that bonds or has no equilibrium, or
///   more than half of all.
/// - A scan that may not say "no" for its few contacts alone counts, since contacts of several
///   scans add up; together they must be three.
/// - A scan without adhesion (an infinite margin) counts, and is left out of the mean.
/// - Of a beam that is pulled in one scan and peeled in another the worse of both ratios decides,
///   each of the scans that it governs. A ratio that governs none is stated beside, of all scans.
///
/// A device whose own force has been found from all scans of the part together (device_force.hpp)
/// is judged by that: the ratios, the word and the reason are those of its verdict, in which the
/// scans' scatter is already. What the scans say one by one is left where it stands beside: spread
/// and worst. A scan that bonds or has no equilibrium still makes a "no" unknown.
///
/// Assumptions: every scan is another place of one part, predicted with the same settings and
/// judged for the same device. A place that is scanned again is counted again, and then the
/// interval is too narrow in its part of the place. The mean stands for a device whose contacts are
/// many such places. The pull-off force of that is the arithmetic mean of the forces, which is
/// exp(s^2/2) times the geometric one: 2 % for a spread of 0.2, 13 % for one of 0.5. A device that
/// rests on a single place is judged by the worst scan, which is stated.
///
/// Simulated parts with c = p = 0.3 have the truth within the interval in 95 +- 1 of 100 cases,
/// from two scans on, as long as tau is not above p. A tau of 1 (places that differ by a factor of
/// e) is seen by few scans: 87 of 100 with two, 92 with three, 94 with five.
///
/// Sources: random effects with the between-scan variance by the method of moments, unweighted
/// (Cochran 1954; Hedges and Olkin 1985; DerSimonian and Laird, Controlled Clinical Trials 7 (1986)
/// 177, weight the same moments); fully correlated inputs and effective degrees of freedom: JCGM
/// 100:2008 (GUM), equations 16 and G.2b.
///
///     std::vector<ScanStatement> scans;
///     scans.push_back(statementOf("place 1", prediction, verdict));
///     const PooledVerdict part = pooledVerdictOf(scans);

#include <cstdint>
#include <string>
#include <vector>

#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/verdict/verdict.hpp"

namespace mems_stiction {

/// A margin or peel number of one scan with its 95 % interval [-]; NaN: not stated.
struct JudgedRatio {
  double value = Verdict::kNotStated;
  double lower = Verdict::kNotStated;
  double upper = Verdict::kNotStated;
};

/// What one scan says of its part.
struct ScanStatement {
  std::string scan_name;
  Sticks sticks = Sticks::kUnknown;
  std::string reason;  ///< of the scan's verdict
  Judge judge = Judge::kPrediction;
  JudgedRatio margin;
  JudgedRatio peel_number;
  std::string governed_by;  ///< which of both decides: Verdict::governed_by
  double margin_transition =
      Verdict::kNotStated;  ///< with the prefactors of the JKR-DMT transition [-]
  double place_deviation =
      Verdict::kNotStated;  ///< p_i before it is bounded [-]; NaN: nothing is known, as 0
  int contacts = 0;
  std::uint32_t regime_flags = 0;  ///< bits of RegimeFlag
};

ScanStatement statementOf(const std::string& scan_name, const Prediction& prediction,
                          const Verdict& verdict);

/// Another verdict on the same scan takes the place of the one before; name and contacts stay.
void judgeAgain(ScanStatement& statement, const Verdict& verdict);

/// The margins, or the peel numbers, of the scans that count; NaN where none is stated.
struct PooledRatio : JudgedRatio {
  double spread = Verdict::kNotStated;        ///< s, between scans [-]; NaN of fewer than two
  double place_spread = Verdict::kNotStated;  ///< p, what the number of contacts explains of it [-]
  double worst = Verdict::kNotStated;         ///< lowest of one scan [-]
  std::string worst_scan;                     ///< its name
};

/// What all scans of a part say together.
struct PooledVerdict {
  Sticks sticks = Sticks::kUnknown;
  std::string reason;       ///< one sentence for people
  std::string verdict_by;   ///< prediction, half_space, or "prediction and half_space"; empty if no
                            ///< scan counts
  int scan_count = 0;       ///< all
  int counted_scans = 0;    ///< of them make a statement: the figures are theirs
  PooledRatio margin;       ///< of the scans that it governs; where it governs none, of all
  PooledRatio peel_number;  ///< the same
  std::string governed_by;  ///< which of both decides: Verdict::governed_by
  std::uint32_t regime_flags = 0;     ///< of any of its scans
  std::vector<std::string> warnings;  ///< about the scans, in words
  /// Where the device's own force judges [N].
  double restoring_force = Verdict::kNotStated;
  double device_pull_off_force = Verdict::kNotStated;
  double device_pull_off_force_lower = Verdict::kNotStated;  ///< 2.5 % quantile
  double device_pull_off_force_upper = Verdict::kNotStated;  ///< 97.5 % quantile
};

PooledVerdict pooledVerdictOf(const std::vector<ScanStatement>& scans);
/// - @p of_device the verdict by the device's own force, found from all these scans together
PooledVerdict pooledVerdictOf(const std::vector<ScanStatement>& scans, const Verdict& of_device);

/// 97.5 % quantile of Student's distribution: 12.706 for one degree of freedom, 1.95996 for
/// infinitely many.
/// - @p freedom degrees of freedom, >= 1, of any size
double studentQuantile(double freedom);

}  // namespace mems_stiction
