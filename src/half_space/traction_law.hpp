#pragma once

/// @file
/// With which traction do two surfaces a gap apart attract or repel each other, and what does that
/// cost per area?
///
///     t(g) = 9-3 law at x = z0/g             attraction and repulsion (mechanics/traction_law.hpp)
///          + its tail                        of bodies under films, or retarded (the same)
///          + eps0 U^2/(2 (g + t/eps_r)^2)    field over an insulator (the same)
///          + p where z0 < g < z0 + d_K + 2 t_w    condensed water and its films (the same)
///     t >= -Ha                                                  beyond, the softer body flows
///
/// Attraction is positive; the energy is minus the work that separation to infinity takes.
/// Assumptions: the traction at a place depends on the gap there alone (Derjaguin); smooth
/// electrodes without charge in the insulator; water in equilibrium with the vapour, its front
/// smeared over a quarter of z0 as a sharp one has no derivative. Gaps narrower than where t = -Ha
/// (or, without a hardness, than 0.45 z0, hundreds of GPa for any solid) take the traction on as a
/// straight line, so that it is finite for every gap. Electric field and water change the gap of
/// zero traction by less than z0/100; g counts from the centres of the outermost atoms, so the
/// insulator's thickness includes z0. Source: Persson and Scaraggi, J. Chem. Phys. 141 (2014)
/// 124701 for rough surfaces under such a law.
///
///     TractionLawOptions options;
///     const TractionLaw law(options);
///     const double pull = law.at(gap).traction;

#include <limits>
#include <string>
#include <vector>

#include "mechanics/traction_law.hpp"
#include "mems_stiction/loads/capillary.hpp"
#include "numeric/packet_functions.hpp"

namespace mems_stiction {

/// What acts across the gap.
struct TractionLawOptions {
  double work_of_adhesion = 0.05;    ///< Gamma of the flat interface [J/m^2], > 0
  double hamaker_constant = 65e-21;  ///< H [J], > 0 where range is 0
  CoatedBody lower;                  ///< under a film that attracts by H
  CoatedBody upper;
  double retardation_length = 0.0;  ///< lambda [m], >= 0; 0 = not retarded
  double range = 0.0;               ///< z0 [m]; 0 derives it from Gamma and H
  bool attracts = true;             ///< false: no attraction, the surfaces repel closer than z0
  double hardness = std::numeric_limits<double>::infinity();  ///< Ha of the softer body [Pa], > 0;
                                                              ///< infinity: elastic
  double voltage = 0.0;                                       ///< whose field acts [V]
  double insulator_thickness = 0.0;              ///< t [m], > 0 when the voltage is not 0
  double insulator_relative_permittivity = 3.9;  ///< eps_r [-], >= 1
  CapillaryOptions water;                        ///< relative_humidity 0: none

  /// One line per violated constraint, empty when all is well.
  std::vector<std::string> validate() const;
  /// Attraction and repulsion of the atoms; fit for use.
  AdhesionLaw adhesion() const;
};

/// t(g), its derivative and its energy.
class TractionLaw {
 public:
  /// Of one gap.
  struct Point {
    double traction;  ///< t [Pa], positive attracts
    double slope;     ///< dt/dg [Pa/m]
    double energy;    ///< integral of t from infinity to g [J/m^2]
  };

  /// @param options fit for use: validate() is empty
  explicit TractionLaw(const TractionLawOptions& options);

  /// The same law, but that it repels with more than `pressure`, > 0, on a straight line: where
  /// nothing is pressed so hard both are one. A law that flows, or whose own line begins before,
  /// stays as it is.
  TractionLaw steepUpTo(double pressure) const;

  Point at(double gap) const;
  /// The same of `count` gaps [m]; infinite ones have no traction.
  void atRow(int count, const double* gaps, double* traction, double* slope, double* energy) const;

  /// Slope of the line from a gap with its traction to where the surfaces repel each other with
  /// -other_traction, by the 9-3 law alone; of one gap or several (Packet) [Pa/m].
  template <typename Real>
  MEMS_STICTION_INLINE Real secant(const Real& gap, const Real& traction,
                                   const Real& other_traction) const {
    const Real gap_there = gapUnder(greater(Real(0.0 - other_traction), Real(0.0)));
    const auto is_law = gap_there > closest_gap_;
    if (flows_) {
      const Real there = select(is_law, other_traction, Real(closest_traction_));
      return (there - traction) / (select(is_law, gap_there, Real(closest_gap_)) - gap);
    }
    // narrower, the law goes on as a line
    const Real excess = greater(Real(closest_traction_ - other_traction), Real(0.0));
    return (other_traction - traction) /
           (select(is_law, gap_there, Real(closest_gap_ - excess / slope_of_line_)) - gap);
  }

  double range() const { return law_.range(); }    ///< z0 [m]
  double stress() const { return law_.stress(); }  ///< 8 Gamma/(3 z0), nearly, with a tail [Pa]
  bool attracts() const { return attracts_ || field_.isOn() || water_.isOn(); }  ///< at some gap
  bool flows() const { return flows_; }               ///< whether a hardness limits the repulsion
  double closestGap() const { return closest_gap_; }  ///< where t = -Ha; narrower gaps flow [m]
  double contactGap() const {
    return contact_gap_;
  }  ///< narrower gaps repel [m]; z0 but for field and water
  /// The gap at which the surfaces repel each other with a pressure, >= 0, by the 9-3 law alone; no
  /// less than the narrowest [m].
  template <typename Real>
  MEMS_STICTION_INLINE Real gapUnder(const Real& pressure) const {
    // x = z0/g solves x^9 - x^3 = p; Halley's method from a tenth beside it
    const Real share = pressure / stress();
    Real x = squareRoot(squareRoot(squareRoot(1.0 + share)));
    for (int i = 0; i < kGapIterations; ++i) {
      const Real square = x * x;
      const Real cube = square * x;
      const Real sixth = cube * cube;
      const Real left = (sixth - 1.0) * cube - share;
      const Real slope = (9.0 * sixth - 3.0) * square;
      const Real bend = (72.0 * sixth - 6.0) * x;
      x = x - 2.0 * left * slope / (2.0 * slope * slope - left * bend);
    }
    return greater(Real(range() / x), Real(narrowestGap()));
  }
  /// The narrowest gap for which the law is more than a line [m].
  double narrowestGap() const;
  /// The widest gap at which something has an edge: beyond it there are tails only [m].
  double reach() const;

 private:
  /// To 1e-9 of any pressure up to that at the narrowest gap.
  static constexpr int kGapIterations = 3;

  /// The 9-3 law, no closer than the closest gap; returns the smallest gap, or the closest if that
  /// is smaller.
  double nineThree(int count, const double* gaps, double* traction, double* slope,
                   double* energy) const;
  /// Where t falls to -pressure, between a narrow gap that repels more and z0 [m].
  double gapOfPressure(double pressure, double narrow) const;
  void addTail(int count, const double* gaps, double* traction, double* slope,
               double* energy) const;
  void addField(int count, const double* gaps, double* traction, double* slope,
                double* energy) const;

  AdhesionLaw law_;
  bool attracts_;
  bool flows_ = false;
  double closest_gap_;
  double contact_gap_;
  double closest_traction_ = 0.0;  ///< t there [Pa]
  double slope_of_line_ = 0.0;     ///< of t for narrower gaps [Pa/m]
  FieldLaw field_;
  WaterLaw water_;
};

}  // namespace mems_stiction
