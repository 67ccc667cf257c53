#pragma once

/// @file
/// With which traction do two flat surfaces a gap apart attract or repel each other: by their
/// atoms, by a voltage, and by water that condenses between them?
///
///     t(x) = (8 Gamma/(3 z0)) (x^3 - x^9),  x = z0/g
///             two half-spaces of atoms: zero at z0, largest 1.026 Gamma/z0 at 3^(1/6) z0
///     w(x) = (8 Gamma/3) (x^2/2 - x^8/8)               its integral from g on; Gamma at z0
///     z0   = sqrt(H/(16 pi Gamma))                     so that t falls off as H/(6 pi g^3)
///     p(d) = eps0 U^2/(2 (d + h/eps_r)^2)              field over a gap d and an insulator h   (3)
///     p    = gamma/r_K for d < d_K + 2 t_w, 0 beyond
///             water: r_K = gamma V_m/(R T ln(1/RH)), the Kelvin radius,
///             d_K = 2 r_K cos(theta), the Kelvin gap, and t_w, the film of water on each face
///
/// Under native films, or retarded, x^3 falls off otherwise: t is then -dw/dg of
/// layered_attraction.hpp less B/g^9, where z0 and B follow from t = 0 and w = Gamma at z0. The law
/// is kept as a 9-3 law and what differs from it (`tail`), so that bare bodies cost no more.
///
/// p of water falls and d_K grows with humidity, p d_K = 2 gamma cos(theta) does not change: the
/// energy that separation costs per area of filled gap, without films. A sphere on a flat gives 4
/// pi gamma R (cos(theta) + t_w/r_K). Assumptions: equilibrium with the vapour, one contact angle
/// on both surfaces, the gap varies slowly over d_K. Menisci take milliseconds to hours to form: a
/// fast contact feels less. Below some 10 % humidity d_K is a molecule or two and a continuum's
/// pressure an extrapolation; near saturation d_K diverges, so the humidity stays below 1. Sources:
/// Israelachvili, chapter 17; Fisher, Gamble and Middlehurst, Nature 290 (1981) 575, for how far
/// the Kelvin equation holds.
///
/// Attraction is positive. Whoever counts the gap from contact, d = g - z0, takes x = z0/(d + z0);
/// whoever counts it from the outermost atoms takes x = z0/g. Assumptions: the traction at a place
/// depends on the gap there alone (Derjaguin); smooth electrodes, no charge in the insulator.
/// Outside: t has no lower limit as g goes to 0, p diverges there without an insulator; callers say
/// where their bodies end. Sources: Israelachvili, Intermolecular and Surface Forces (3rd ed.,
/// 2011), chapter 13; Deladi et al. 2002, (3), the insulator's thickness there without eps_r.
///
///     const AdhesionLaw law(work_of_adhesion, AdhesionLaw::rangeOf(work_of_adhesion,
///         hamaker_constant));
///     const double pull = law.traction(law.range() / gap);

#include <algorithm>

#include "mechanics/layered_attraction.hpp"
#include "numeric/constants.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {

/// The 9-3 law, and what films and retardation change of it. Functions take one number or several
/// (Packet), so that a formula stands once. Those of x are the 9-3 law's alone: where hasTail(),
/// whoever wants the whole adds what the tail has at the gap z0/x.
class AdhesionLaw {
 public:
  /// - @p work_of_adhesion Gamma [J/m^2], >= 0; without it nothing attracts
  /// - @p range z0 [m], > 0
  AdhesionLaw(double work_of_adhesion, double range);
  /// Of bodies that attract each other like this far away. With another range than rangeOf() all of
  /// the attraction takes the factor with which Gamma is the whole work.
  AdhesionLaw(double work_of_adhesion, double range, const LayeredAttraction& attraction);

  /// z0 at which the Hamaker constant gives the work of adhesion [m]. Both > 0.
  static double rangeOf(double work_of_adhesion, double hamaker_constant);
  static double rangeOf(double work_of_adhesion, const LayeredAttraction& attraction);

  double range() const { return range_; }    ///< z0 [m]
  double stress() const { return stress_; }  ///< 8 Gamma/(3 z0), with a tail nearly so [Pa]
  /// Largest traction of the whole law: what no interface exceeds, 1.026 Gamma/z0, with a tail
  /// nearly so [Pa].
  double strength() const { return strength_; }
  /// The gap at which it acts, 3^(1/6) z0, with a tail nearly so [m].
  double strongestGap() const { return strongest_gap_; }
  /// What differs from the 9-3 law; 0 at z0, but for its energy.
  const LayeredAttraction& tail() const { return tail_; }
  bool hasTail() const { return has_tail_; }

  /// t [Pa]
  template <typename Real>
  MEMS_STICTION_INLINE Real traction(const Real& x) const {
    const Real cube = x * x * x;
    return stress_ * (cube - cube * cube * cube);
  }
  /// dt/dg [Pa/m]
  template <typename Real>
  MEMS_STICTION_INLINE Real slope(const Real& x) const {
    const Real square = x * x;
    const Real cube = square * x;
    return stress_ / range_ * (9.0 * (cube * cube) - 3.0) * (square * square);
  }
  /// d^2t/dg^2 [Pa/m^2]
  template <typename Real>
  MEMS_STICTION_INLINE Real curvature(const Real& x) const {
    const Real fifth = x * x * x * x * x;
    return stress_ / (range_ * range_) * (12.0 * fifth - 90.0 * fifth * fifth * x);
  }
  /// w [J/m^2]
  template <typename Real>
  MEMS_STICTION_INLINE Real energy(const Real& x) const {
    const Real square = x * x;
    const Real cube = square * x;
    return stress_ * range_ * (0.5 - 0.125 * (cube * cube)) * square;
  }

 private:
  double range_;
  double stress_;
  double strength_;
  double strongest_gap_;
  bool has_tail_ = false;
  LayeredAttraction tail_;
};

/// The field of a voltage between the surfaces.
class FieldLaw {
 public:
  /// - @p voltage U [V]; without it nothing attracts
  /// - @p insulator_thickness h [m], >= 0
  /// - @p insulator_relative_permittivity eps_r [-], >= 1
  FieldLaw(double voltage, double insulator_thickness, double insulator_relative_permittivity);

  bool isOn() const { return voltage_ != 0.0; }
  /// eps0 U^2/2 times an area: over squaredDistance() it is the force on that area [N m^2].
  double factor(double area = 1.0) const {
    return 0.5 * kVacuumPermittivity * area * voltage_ * voltage_;
  }
  /// (d + h/eps_r)^2 [m^2]
  template <typename Real>
  MEMS_STICTION_INLINE Real squaredDistance(const Real& gap) const {
    const Real distance = gap + insulator_;
    return distance * distance;
  }

  /// Of the gap, U/(d + h/eps_r) [V/m]
  double field(double gap) const { return voltage_ / (gap + insulator_); }
  /// p [Pa]
  double pressure(double gap) const {
    const double inverse = inverseDistance(gap);
    return factor() * inverse * inverse;
  }
  /// dp/dd [Pa/m]
  double slope(double gap) const { return -2.0 * pressure(gap) * inverseDistance(gap); }
  /// What separation to infinity costs [J/m^2]
  double energy(double gap) const { return factor() * inverseDistance(gap); }

 private:
  double inverseDistance(double gap) const { return 1.0 / (gap + insulator_); }

  double voltage_;
  double insulator_;  ///< h/eps_r [m]: the vacuum that the insulator is worth
};

/// Water that condenses between the surfaces.
class WaterLaw {
 public:
  /// With a front that is smeared, as whoever needs a derivative wants it.
  struct Smeared {
    double pressure;  ///< [Pa]
    double slope;     ///< its derivative by the gap [Pa/m]
    double energy;    ///< what separation to infinity costs [J/m^2]
  };

  WaterLaw() = default;  ///< there is none
  /// - @p relative_humidity RH [-], in [0, 1); 0: no water
  /// - @p surface_tension gamma of the liquid [N/m], > 0
  /// - @p contact_angle theta on both surfaces [rad], in [0, pi/2]
  /// - @p temperature T [K], > 0
  /// - @p molar_volume V_m of the liquid [m^3/mol], > 0
  /// - @p film t_w on each face [m], >= 0
  WaterLaw(double relative_humidity, double surface_tension, double contact_angle,
           double temperature, double molar_volume, double film = 0.0);

  bool isOn() const { return gap_limit_ > 0.0; }
  double kelvinRadius() const { return kelvin_radius_; }  ///< r_K [m]; 0 without water
  double gapLimit() const { return gap_limit_; }          ///< d_K + 2 t_w [m]; 0 without water
  double pressure() const { return pressure_; }           ///< p [Pa]; 0 without water
  /// At a gap, counted from contact: p where water fills it [Pa].
  double pressure(double gap) const { return gap > 0.0 && gap < gap_limit_ ? pressure_ : 0.0; }
  /// What separation from there to infinity costs [J/m^2].
  double energy(double gap) const {
    return pressure_ * std::max(0.0, gap_limit_ - std::max(gap, 0.0));
  }

  /// At a gap that is counted from the outermost atoms: water fills it from `contact` to `contact`
  /// + gapLimit(), both ends smeared over `front` [m].
  Smeared smeared(double gap, double contact, double front) const {
    const Step inner = smoothStep((contact - gap) / front);
    const Step filled = smoothStep((contact + gap_limit_ - gap) / front);
    return {pressure_ * (filled.value - inner.value),
            -(pressure_ / front * (filled.slope - inner.slope)),
            pressure_ * front * (filled.integral - inner.integral)};
  }

 private:
  /// From 0 to 1 over [-1/2, 1/2], with its derivative and its integral from -infinity.
  struct Step {
    double value;
    double slope;
    double integral;
  };
  static Step smoothStep(double x) {
    if (x <= -0.5) return {0.0, 0.0, 0.0};
    if (x >= 0.5) return {1.0, 0.0, x};
    const double s = x + 0.5;
    return {s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s), s * s * s * (1.0 - 0.5 * s)};
  }

  double kelvin_radius_ = 0.0;
  double gap_limit_ = 0.0;
  double pressure_ = 0.0;
};

}  // namespace mems_stiction
