#pragma once

/// @file
/// How far may the predicted pull-off force be off, given how well the constants are known?
///
/// Each sample draws one factor per uncertain constant, lognormal with median 1. The figures move
/// with them as the solver says (ContactResponse), or with the prediction's exponents, force and
/// work each with their own; the model's own error (ModelStatement) is a further factor then. Where
/// a half-space judges, its error takes the place of that (evidence.hpp). The choice of cleaning is
/// a further factor: normal in the logarithm, whose 2.5 % and 97.5 % quantiles are the lowest and
/// the highest of the cleanings. Both add in quadrature there, quantile by quantile. A device's own
/// force brings its samples with it (DeviceForce), so its margin has the interval of that force.
///
/// With scan_sampling, a further factor has the variance sum R_i^2/(sum R_i)^2: a scan is one
/// sample of the surface, and another place would have other contacts (Poisson). A device's force
/// has this in its own samples.
///
/// Cost: one pass over the contacts per sample, some 0.2 ms for 1000 contacts and 200 samples. Same
/// seed, same samples.

#include <limits>
#include <vector>

#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/verdict/evidence.hpp"
#include "mems_stiction/verdict/uncertainty_options.hpp"

namespace mems_stiction {

/// Shares below the ends of a 95 % interval [-].
constexpr double kLowerShare = 0.025;
constexpr double kUpperShare = 0.975;

/// Samples in ascending order; empty when the prediction lists neither the contacts that hold nor,
/// where its formulation responds by them, all of them (Prediction::listsContacts()).
struct AdhesionSpread {
  std::vector<double> pull_off;  ///< pull-off force over the prediction's [-]
  std::vector<double>
      apparent_work;  ///< apparent work of adhesion over apparentWorkOfAdhesion() [-]
  /// What of it is of the place alone: standard deviation of the logarithm of the pull-off force
  /// from place to place, by the number of contacts [-]; 0 without scan_sampling, and of conforming
  /// surfaces. The rest is the same at every place.
  double place_deviation = 0.0;

  bool isKnown() const { return !pull_off.empty(); }
};

/// Energy per nominal area that separating the surfaces costs when no load presses [J/m^2]: what
/// beams of this rough surface would measure. NaN if it is a sum over contacts that are not listed.
double apparentWorkOfAdhesion(const Prediction& prediction, const Options& options);

/// - @p prediction of the formulation, also where a half-space judges: contacts and exponents are
/// its own
/// - @p options those of the prediction
/// - @p evidence a half-space in it judges, whatever whyNotJudging() says
AdhesionSpread adhesionSpread(const Prediction& prediction, const Options& options,
                              const UncertaintyOptions& uncertainty, const Evidence& evidence = {});

/// A figure under the choices of a range is widened by it: sorted samples move away from their
/// median by a factor whose 2.5 % and 97.5 % quantiles are those of the range, in quadrature in the
/// logarithm, quantile by quantile.
/// - @p samples ascending, > 0
void widen(std::vector<double>& samples, const FactorRange& range);

/// The range of a factor that is as often above 1 as below. @param reach of ln factor to either
/// side, 95 % [-]
FactorRange factorsWithin(double reach);

/// 95 % of a force lie between these; NaN: not known.
struct ForceInterval {
  double lower = std::numeric_limits<double>::quiet_NaN();  ///< 2.5 % quantile [N]
  double upper = std::numeric_limits<double>::quiet_NaN();  ///< 97.5 % quantile [N]
};

/// Of the pull-off force of the scan. It needs no device; a device's margin lies within the inverse
/// of it.
ForceInterval pullOffInterval(const Prediction& prediction, const Options& options,
                              const UncertaintyOptions& uncertainty);

/// Standard deviation of the logarithm of a lognormal number, by its relative one [-].
double lognormalDeviation(double relative_deviation);

/// Value below which the given share of the sorted samples lies, linear between samples; NaN if
/// there are none.
double quantile(const std::vector<double>& sorted_samples, double share);

}  // namespace mems_stiction
