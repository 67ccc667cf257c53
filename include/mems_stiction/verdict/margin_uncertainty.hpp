#pragma once

/// @file
/// How far may the predicted pull-off force be off, given how well the constants are known?
///
/// Each sample draws one factor per uncertain constant, lognormal with median 1: w for the work of adhesion, h for the
/// hardness, e for the modulus, x for the pitch, c for the cut-off, a for the Hamaker constant. Nothing is searched
/// again.
///
/// A prediction by the separation curve moves with its exponents, force and work each with their own, and has the
/// model's own error (doc/trust.md). Where a half-space judges, its error takes the place of that (evidence.hpp).
///
/// A prediction by paper or printed moves the contacts that were found:
///
///     R_i -> x^2 R_i     P1_i -> e x P1_i     yield load Y_i = Ha pi rc_i^2 -> h x^2 Y_i
///     phi_i -> (e/h) phi_i/x, and with it the elastic share chi_i
///     carried load  C = sum [chi_i P1_i + (1 - chi_i) min(P1_i, Y_i)]
///     demand        B = F_m + F_e + F_w + F_c + 2 pi Gamma sum R_i
///     growth        n = (B'/C')/(B/C), with F_w' and F_c' in B' for n = 1
///     F_w -> x^2 a (n c^-2 near + far),  far = H A/(6 pi (mean gap)^3), which the cut-off does not touch
///     F_c -> x^2 n F_c
///     pull-off per nominal area -> [n (3/2) pi (w Gamma) sum x^2 R_i + F_w' + F_c']/(x^2 A0)
///
/// The growth says that a surface that must carry more, or carries less per contact, brings proportionally more
/// contacts of the same kind into play (Archard; Greenwood and Williamson's exponential summits). F_w ~ c^-2 is the
/// edge of a contact, a gap that grows evenly from 0. Condensed water goes with the contacts that it surrounds.
///
/// This is a first-order model. Left out: the feedback of new contacts on the demand (it makes sticky surfaces near
/// bonding more sensitive than said here), the change of the shares of large and small contacts, and steps of the
/// contact count when there are few. Tests search again with each constant changed:
///
/// - From 30 elastic contacts on Gaussian surfaces, the powers of the pull-off force agree within 0.3.
/// - Where contacts flow, the search moves by several times more, with powers of 4 of pitch and cut-off: they resist
///   less than the load that they carry (asperity_response.hpp).
/// - With a few contacts the search goes in steps, and this is the smooth mean at best. A single contact that carries
///   more than it must does not react at all: this is then wider than what the search would say.
///
/// The choice of cleaning is a further factor: normal in the logarithm, whose 2.5 % and 97.5 % quantiles are the lowest
/// and the highest of the cleanings. It adds in quadrature there, quantile by quantile.
///
/// With scan_sampling, a further factor has the variance sum R_i^2/(sum R_i)^2: a scan is one sample of the surface,
/// and another place would have other contacts (Poisson).
///
/// Cost: one pass over the contacts per sample, some 0.2 ms for 1000 contacts and 200 samples. Same seed, same samples.

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

/// Samples in ascending order; empty when the prediction does not list its contacts (Prediction::listsContacts()).
struct AdhesionSpread {
  std::vector<double> pull_off;       ///< pull-off force over the prediction's [-]
  std::vector<double> apparent_work;  ///< apparent work of adhesion over apparentWorkOfAdhesion() [-]
  /// What of it is of the place alone: standard deviation of the logarithm of the pull-off force from place to place,
  /// by the number of contacts [-]; 0 without scan_sampling, and of conforming surfaces. The rest is the same at every
  /// place.
  double place_deviation = 0.0;

  bool isKnown() const { return !pull_off.empty(); }
};

/// Energy per nominal area that separating the contacts costs when no load presses: the sum of JKR's energies over the
/// contacts [J/m^2]. This is what beams of this rough surface would measure, without the van der Waals attraction
/// across the open gap (which adds at most F_w (mean gap)/2 per nominal area). NaN without a list of contacts.
double apparentWorkOfAdhesion(const Prediction& prediction, const Options& options);

/// - @p prediction of the formulation, also where a half-space judges: contacts and exponents are its own
/// - @p options those of the prediction
/// - @p evidence a half-space in it judges, whatever whyNotJudging() says
AdhesionSpread adhesionSpread(const Prediction& prediction, const Options& options,
                              const UncertaintyOptions& uncertainty, const Evidence& evidence = {});

/// 95 % of a force lie between these; NaN: not known.
struct ForceInterval {
  double lower = std::numeric_limits<double>::quiet_NaN();  ///< 2.5 % quantile [N]
  double upper = std::numeric_limits<double>::quiet_NaN();  ///< 97.5 % quantile [N]
};

/// Of the pull-off force of the scan. It needs no device; a device's margin lies within the inverse of it.
ForceInterval pullOffInterval(const Prediction& prediction, const Options& options,
                              const UncertaintyOptions& uncertainty);

/// Value below which the given share of the sorted samples lies, linear between samples; NaN if there are none.
double quantile(const std::vector<double>& sorted_samples, double share);

}  // namespace mems_stiction
