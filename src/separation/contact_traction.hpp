#pragma once

/// @file
/// The law of adhesion as the separation curve counts it: from the plane of contact, d = 0.
///
///     t(d) and its integral w(d) from d on: the 9-3 law (mechanics/traction_law.hpp) at
///             x = z0/(d + z0);  w(0) = Gamma
///
/// Attraction is positive. Far away t is Hamaker's H/(6 pi (d + z0)^3), or that of bodies under
/// native films (mechanics/layered_attraction.hpp); t is largest, 1.026
/// Gamma/z0, at d = 0.2 z0, and 0 in contact. Surfaces that are pressed together by p come closer
/// than the plane of contact by s with p = (8 Gamma/(3 z0)) [ (z0/(z0 - s))^9 - (z0/(z0 - s))^3 ]:
/// a layer in series with the bodies, stiffer than they are but for contacts smaller than some E
/// z0^2/Gamma.
///
/// half_space/traction_law.hpp is the same law, counted from the centres of the outermost atoms.
///
///     const ContactTraction law(interface);
///     const double pull = law.traction(gap - approach);

#include <cmath>

#include "mechanics/traction_law.hpp"
#include "mems_stiction/loads/interface.hpp"
#include "mems_stiction/mechanics/material.hpp"
#include "numeric/packet.hpp"
#include "numeric/packet_functions.hpp"

namespace mems_stiction {

/// t(d), its integral and what it carries in compression.
class ContactTraction {
 public:
  /// Without work of adhesion nothing attracts, and the layer is rigid. Without a Hamaker constant
  /// z0 is interface/equilibrium_distance.
  explicit ContactTraction(const InterfaceOptions& interface, const Material& lower = Material(),
                           const Material& upper = Material());

  double workOfAdhesion() const { return work_of_adhesion_; }  ///< Gamma [J/m^2]
  double range() const { return law_.range(); }                ///< z0 [m], > 0
  double stress() const { return law_.stress(); }              ///< 8 Gamma/(3 z0) [Pa]
  bool attracts() const { return stress() > 0.0; }
  /// Largest traction: what no interface exceeds, 1.026 Gamma/z0 [Pa].
  double strength() const { return law_.strength(); }
  /// The gap at which it acts, 0.2 z0 [m].
  double strongestGap() const;
  /// How much faster than the cube of the gap the traction falls at most, as a ratio of both powers
  /// [-].
  double steepness() const { return law_.hasTail() ? law_.tail().steepness() : 1.0; }

  /// t of one gap [Pa] or of several; @param gap d [m], >= 0
  template <typename Real>
  MEMS_STICTION_INLINE Real traction(const Real& gap) const {
    const Real near = law_.traction(ratio(gap));
    return law_.hasTail() ? near + law_.tail().at(gap + range()).traction : near;
  }
  /// dt/dd [Pa/m]
  double slope(double gap) const {
    const double near = law_.slope(ratio(gap));
    return law_.hasTail() ? near + law_.tail().at(gap + range()).slope : near;
  }
  /// d^2t/dd^2 [Pa/m^2]
  double curvature(double gap) const {
    const double near = law_.curvature(ratio(gap));
    return law_.hasTail() ? near + law_.tail().at(gap + range()).curvature : near;
  }
  /// w [J/m^2] of one gap [m] or of several
  template <typename Real>
  MEMS_STICTION_INLINE Real energy(const Real& gap) const {
    const Real near = law_.energy(ratio(gap));
    return law_.hasTail() ? near + law_.tail().at(gap + range()).energy : near;
  }
  /// t [Pa] and w [J/m^2] in the mean over gaps that vary little about their mean.
  /// - @p variance [m^2]
  double meanTraction(double gap, double variance) const {
    const double x = ratio(gap);
    const double near = law_.traction(x) + 0.5 * law_.curvature(x) * variance;
    if (!law_.hasTail()) return near;
    const auto tail = law_.tail().at(gap + range());
    return near + (tail.traction + 0.5 * tail.curvature * variance);
  }
  double meanEnergy(double gap, double variance) const {
    const double x = ratio(gap);
    const double near = law_.energy(x) - 0.5 * law_.slope(x) * variance;
    if (!law_.hasTail()) return near;
    const auto tail = law_.tail().at(gap + range());
    return near + (tail.energy - 0.5 * tail.slope * variance);
  }

  /// By how much surfaces pressed by this come closer than the plane of contact, s [m]; 0 without
  /// attraction.
  /// - @p pressure [Pa], >= 0
  double closingUnder(double pressure) const;
  /// What the bodies and the layer carry together, when the bodies alone would carry
  /// `elastic_pressure` [Pa] at this depth of overlap [m], > 0: the layer takes a part s of the
  /// depth, and both carry the same. Nothing where the bodies pull. Of one patch or of several.
  template <typename Real>
  Real pressureInSeries(const Real& elastic_pressure, const Real& depth) const;

 private:
  /// The balance of layer and bodies is found to this share of the depth.
  static constexpr double kBalance = 1e-6;
  static constexpr int kMostNewtonSteps = 20;

  /// Under a pressure p alone x^9 is below 1 + mostOfShare() p/stress: the attraction grows no
  /// faster than x^3, with a tail than x^6, and x^n <= 1 + (n/9) (x^9 - 1).
  double mostOfShare() const { return law_.hasTail() ? 3.0 : 1.5; }

  /// x
  template <typename Real>
  MEMS_STICTION_INLINE Real ratio(const Real& gap) const {
    return range() / (gap + range());
  }

  double work_of_adhesion_;
  AdhesionLaw law_;
};

template <typename Real>
MEMS_STICTION_INLINE Real ContactTraction::pressureInSeries(const Real& elastic_pressure,
                                                            const Real& depth) const {
  const Real pressure = greater(elastic_pressure, Real(0.0));
  if (!attracts()) return pressure;
  // f(s) = layer(s) - pressure (1 - s/depth) rises from s = 0, where it is negative, ever more
  // steeply: Newton's steps from the right come down to its zero without passing it. The layer
  // alone would give way by more.
  const double range = law_.range();
  const Real tolerance = kBalance * select(depth < range, depth, Real(range));
  const Real stiffness = pressure / depth;
  const Real beyond = range * (1.0 - power(1.0 + mostOfShare() * pressure / stress(), -1.0 / 9.0));
  Real s = select(beyond < depth, beyond, depth);
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const Real x = range / (range - s);
    Real traction = law_.traction(x);
    Real slope = law_.slope(x);
    if (law_.hasTail()) {
      const auto tail = law_.tail().at(range - s);
      traction += tail.traction;
      slope += tail.slope;
    }
    const Real lacking = traction + (pressure - stiffness * s);
    Real next = s + lacking / (slope + stiffness);
    next = greater(next, Real(0.0));
    next = select(next < depth, next, depth);
    const Real moved = select(next > s, next - s, s - next);
    s = next;
    if (!isAnywhere(moved > tolerance)) break;
  }
  return pressure - stiffness * s;
}

}  // namespace mems_stiction
